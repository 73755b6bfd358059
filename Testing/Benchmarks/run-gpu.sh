#!/bin/bash
# Measures frames with the OpenGL backend beside the CPU's, VTK's rasteriser and vtkShadowMapPass, in the
# windows of the display that DISPLAY names: on a GPU where that has one. Without a display windows are
# EGL's, which takes VTK 9.4 or later. Builds what it needs; ten minutes. Prints a table; whoever sends it
# says which GPU, driver and processor it is of, as it does.
# Usage: run-gpu.sh [--frames N] [--size WxH] [--no-install]
#   --frames N    timed for each figure, 9 unless said otherwise
#   --size WxH    of the window, 1920x1080 unless said otherwise
#   --no-install  never installs: names what is missing and stops
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

frames=9
size=1920x1080
check_only=()
while [ $# -gt 0 ]; do
  case "$1" in
    --no-install) check_only=(--no-install) ;;
    --frames) frames=${2:-}; shift ;;
    --size) size=${2:-}; shift ;;
    *) sed -n '2,10s/^# //p' "${BASH_SOURCE[0]}"; exit 2 ;;
  esac
  shift
done

CMake/install-packages.sh "${check_only[@]}" build test demo
cmake -S . -B build/vtk -G Ninja -DCMAKE_BUILD_TYPE=Release -DVTKSVO_TESTING=ON -DPython3_EXECUTABLE=/usr/bin/python3 \
  -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache >/dev/null
vtk=$(sed -n 's/^set(PACKAGE_VERSION "\(.*\)")/\1/p' "$(sed -n 's/^VTK_DIR:PATH=//p' build/vtk/CMakeCache.txt)/vtk-config-version.cmake")
if [ -z "${DISPLAY:-}" ] && [ "$(printf '%s\n' 9.4 "$vtk" | sort -V | head -1)" != 9.4 ]; then
  echo "run-gpu.sh: DISPLAY names no display, which VTK $vtk needs; VTK 9.4 and later also open windows by EGL" >&2
  exit 1
fi
cmake --build build/vtk -j "${VTKSVO_JOBS:-2}" --target BenchmarkFrames
lscpu | sed -n 's/^Model name: */Processor: /p'
build/vtk/bin/BenchmarkFrames --experiments openGL --size "$size" --frames "$frames" --output build/gpu.json
/usr/bin/python3 Testing/Benchmarks/Performance/gpuTable.py build/gpu.json
