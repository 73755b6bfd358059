"""Shaders as the language is written: what a driver takes need not be GLSL, and the next one says so.

Usage: TestShaders.py validator folder

The folder has what Mesa has been given by tests that ran before with MESA_SHADER_CAPTURE_PATH=folder: our
own shaders, and VTK's with ours in them. The validator is Khronos' glslangValidator. Ends with 77, skipped,
if there is nothing: other drivers hand out no shaders."""
import pathlib
import re
import subprocess
import sys
import tempfile

validator, folder = sys.argv[1], pathlib.Path(sys.argv[2])
shaders = set()
for captured in sorted(folder.glob("*.shader_test")):
    parts = re.split(r"^\[(vertex|fragment|geometry|compute) shader\]$|^\[.*\]$", captured.read_text(errors="replace"),
                     flags=re.MULTILINE)
    shaders.update((stage, text.strip() + "\n") for stage, text in zip(parts[1::2], parts[2::2]) if stage)
if not shaders:
    print("no shaders were captured: is the driver Mesa's?")
    sys.exit(77)
refused = 0
with tempfile.TemporaryDirectory() as scratch:
    for stage, text in sorted(shaders):
        path = pathlib.Path(scratch) / ("shader." + stage[:4])
        path.write_text(text)
        answer = subprocess.run([validator, path], capture_output=True, text=True, check=False)
        if answer.returncode != 0:
            refused += 1
            lines = text.splitlines()
            for line in answer.stdout.splitlines():
                print(line)
                place = re.match(r"ERROR: \d+:(\d+):", line)
                if place:
                    print("    " + lines[int(place[1]) - 1])
print(f"{len(shaders)} shaders, {refused} of them refused")
ours = sum("svo" in text for _, text in shaders)
if ours < 20:
    print(f"only {ours} of them are ours, or VTK's with ours in them")
sys.exit(refused > 0 or ours < 20)
