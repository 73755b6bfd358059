"""make-release.sh in a clone with tags of its own: what it refuses, and the source archive.

usage: TestRelease.py source folder. Without git, or outside of a clone, there is nothing to try: 77.
"""

import glob
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile

source = sys.argv[1]
if not shutil.which("git") or not os.path.exists(os.path.join(source, ".git")):
    print("Skipped: this is no git clone.")
    sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    clone = os.path.join(folder, "clone")

    def git(*arguments):
        subprocess.run(["git", "-c", "user.name=a test", "-c", "user.email=test@localhost", *arguments], cwd=clone,
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def release(*arguments):
        said = subprocess.run(["Testing/make-release.sh", "--only-source", *arguments], cwd=clone, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        print(said.stdout)
        return said.returncode, said.stdout

    def refused(*words):
        code, text = release()
        assert code != 0 and all(word in text for word in words), (words, text)
        assert not glob.glob(f"{clone}/build/release/*/*")

    subprocess.run(["git", "clone", "-q", source, clone], check=True)
    # The script as it lies in the source folder, committed or not.
    for name in ("CMakeLists.txt", "CHANGELOG.md", "Testing/make-release.sh"):
        shutil.copy(os.path.join(source, name), os.path.join(clone, name))
    with open(f"{clone}/CMakeLists.txt") as file:
        version = re.search(r"VERSION (\d+\.\d+\.\d+)", file.read()).group(1)
    with open(f"{clone}/CHANGELOG.md") as file:
        text = file.read()
    section = re.sub(r"\.0$", "", version)
    undated = re.sub(rf"^## {section}\b.*$", f"## {section}", text, flags=re.M)
    assert undated != text or f"## {section}\n" in text, "CHANGELOG.md has no section of this version"

    def commit(changelog):
        with open(f"{clone}/CHANGELOG.md", "w") as file:
            file.write(changelog)
        git("add", "-A")
        git("commit", "-q", "--allow-empty", "-m", "Release")

    commit(undated)
    for tag in subprocess.run(["git", "tag"], cwd=clone, stdout=subprocess.PIPE, text=True).stdout.split():
        git("tag", "-d", tag)
    refused("not the tag", f"v{version}")
    git("tag", "v99.0")
    refused("v99.0", f"v{version}")
    git("tag", f"v{version}")
    refused("CHANGELOG.md", f"## {section} (")
    commit(undated.replace(f"## {section}\n", f"## {section} (2030-01-31)\n"))
    refused("not the tag")
    git("tag", "-f", f"v{version}")
    with open(f"{clone}/stray", "w"):
        pass
    refused("not clean", "stray")
    os.remove(f"{clone}/stray")

    code, text = release()
    assert code == 0, text
    made = f"{clone}/build/release/v{version}"
    archive = f"vtksvo-{version}.tar.gz"
    assert sorted(os.listdir(made)) == ["SHA256SUMS", archive], os.listdir(made)
    subprocess.run(["sha256sum", "-c", "SHA256SUMS"], cwd=made, check=True)
    with tarfile.open(f"{made}/{archive}") as opened:
        names = set(opened.getnames())
    for name in ("CMakeLists.txt", "LICENSE", "CHANGELOG.md", "Testing/run-tests.sh"):
        assert f"vtksvo-{version}/{name}" in names, name
    code, text = release()
    assert code != 0 and "already" in text
    code, text = release("--output", f"{folder}/again")
    assert code == 0, text
    with open(f"{made}/SHA256SUMS") as one, open(f"{folder}/again/SHA256SUMS") as other:
        assert one.read() == other.read(), "the same tag gave another archive"
