"""The installed plugin, moved to another place, is loaded and casts shadows, and its classes are wrapped.

usage: TestInstall.py folder of ParaView's programs, cmake, build folder
"""

import glob
import os
import shutil
import subprocess
import sys

programs, cmake, build = sys.argv[1:]
output = os.environ["VTKSVO_OUTPUT"]
staged, prefix = os.path.join(output, "staged"), os.path.join(output, "prefix")
for folder in staged, prefix:
    shutil.rmtree(folder, ignore_errors=True)
subprocess.run([cmake, "--install", build, "--prefix", staged], check=True, stdout=subprocess.DEVNULL)
os.rename(staged, prefix)  # nothing may remember where it was


def installed(pattern):
    found = glob.glob(os.path.join(prefix, pattern), recursive=True)
    assert len(found) == 1, f"{pattern}: {found}"
    return found[0]


environment = dict(os.environ)
built = os.path.join(build, "python")
wrappers = os.path.dirname(os.path.dirname(installed("**/vtksvo/__init__.py")))
environment["PYTHONPATH"] = environment["PYTHONPATH"].replace(built, wrappers)
assert built not in environment["PYTHONPATH"]
environment["VTKSVO_PLUGIN"] = installed("**/SparseVoxelOctree.so")
here = os.path.dirname(os.path.abspath(__file__))


def run(program, *arguments):
    result = subprocess.run([os.path.join(programs, program), *arguments], env=environment,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=240)
    print(result.stdout)
    assert result.returncode == 0 and "ERR|" not in result.stdout, program
    return result.stdout


run("pvbatch", os.path.join(here, "TestShadows.py"))
said = run("pvpython", "-c", "import vtksvo; print(vtksvo.__file__, vtksvo.vtkSVORenderPass().GetClassName())")
assert os.path.join(wrappers, "vtksvo") in said and "vtkSVORenderPass" in said
