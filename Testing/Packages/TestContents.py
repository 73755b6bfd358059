"""What cpack makes of a build tree: the packages that are expected, each with what Debian asks for, and
nothing in them that points back to where they were built. Where lintian is installed it finds no error.

usage: TestContents.py cpack, build folder, source folder, name of a package...
"""

import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

cpack, build, source, *names = sys.argv[1:]
packages = os.path.join(build, "packages")
shutil.rmtree(packages, ignore_errors=True)
said = subprocess.run([cpack], cwd=build, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
print(said.stdout)
assert said.returncode == 0 and "arning" not in said.stdout


def run(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


places = {False: r"usr/(include/vtkSVO|lib/[^/]+-linux-[^/]+|lib/python3/dist-packages/vtksvo|share/doc)/",
          True: r"usr/(lib/[^/]+-linux-[^/]+/paraview-[0-9.]+/plugins/SparseVoxelOctree/|share/doc/|bin/paraview.conf$)"}
found = {run("dpkg-deb", "-f", file, "Package").strip(): file for file in glob.glob(f"{packages}/*.deb")}
assert sorted(found) == sorted(names), sorted(found)

for name, file in found.items():
    depends = run("dpkg-deb", "-f", file, "Depends").strip()
    print(f"{os.path.basename(file)}, {os.path.getsize(file) // 1024} KiB\n  needs {depends}")
    # dpkg-shlibdeps was there and found the libraries' packages; a package of headers has none.
    assert name.endswith("-dev") or "libstdc++6" in depends, depends
    with tempfile.TemporaryDirectory() as root:
        run("dpkg-deb", "-x", file, root)
        assert os.path.exists(f"{root}/usr/share/doc/{name}/copyright")
        for folder, _, files in os.walk(root):
            for path in (os.path.join(folder, one) for one in files):
                if os.path.islink(path):
                    continue
                inside = os.path.relpath(path, root)
                # Where Debian wants it; a build tree configured long ago may have other destinations.
                assert re.match(places[name.startswith("paraview")], inside), f"{inside}: not its place"
                with open(path, "rb") as opened:
                    content = opened.read()
                if content.startswith(b"\x7fELF"):
                    paths = re.findall(r"\((?:RPATH|RUNPATH)\).*\[(.*)\]", run("readelf", "-dW", path))
                    for entry in ":".join(paths).split(":"):
                        assert not entry or entry.startswith("$ORIGIN"), f"{inside} looks in {entry}"
                else:
                    # The sources that a library names in its messages are no matter; paths in text are.
                    for where in (build, source):
                        assert where.encode() not in content, f"{inside} names {where}"

if shutil.which("lintian"):
    said = subprocess.run(["lintian", "--fail-on", "error", "--tag-display-limit", "0", *found.values()],
                          stdout=subprocess.PIPE, text=True)
    print(said.stdout)
    assert said.returncode == 0, "lintian found errors"
else:
    print("Debian's rules for packages were not checked: lintian is not installed.")
