#!/bin/bash
# Installs what is missing, builds build/vtk and build/paraview, runs the tests of both, and has clang-tidy look at the libraries.
# Safe to run again.
# Usage: run-tests.sh [--long] [--no-install]
#   --long        also the tests labelled "long" (real meshes, many rays and random scenes), the sanitizers,
#                 and all of this on each fresh Debian that is supported: hours, see run-on.sh.
#                 VTKSVO_SCRIPTS in the environment: a folder of scripts that VTK's pictures are
#                 compared on, with the pass and without
#   --no-install  never installs: names what is missing and stops
# VTKSVO_CMAKE_ARGUMENTS in the environment goes to CMake: -D options of one's own. VTKSVO_JOBS: how many files are compiled, and
# tests run, at a time; else one for each processor.
# The exit code is 0 only if everything was built and every test passed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

long=no
check_only=()
groups=(build test paraview)
# The code is kept for the checks of Debian 12's clang-tidy.
tidies=$(. /etc/os-release && [ "${VERSION_ID:-}" = 12 ] && echo yes || echo no)
[ "$tidies" = no ] || groups+=(tidy)
for argument in "$@"; do
  case "$argument" in
    --long) long=yes; groups+=(demo accuracy fresh) ;;
    --no-install) check_only=(--no-install) ;;
    *)
      sed -n '4,12s/^# //p' "${BASH_SOURCE[0]}"
      exit 2
      ;;
  esac
done
export VTKSVO_JOBS=${VTKSVO_JOBS:-$(nproc)}
step() { printf '\n== %s (%s)\n' "$1" "$(date +%T)"; }

step "Packages"
CMake/install-packages.sh "${check_only[@]}" "${groups[@]}"
paraview=$(CMake/unpack-paraview.sh "${check_only[@]}")

step "Build: build/vtk"
cmake -S . -B build/vtk -G Ninja \
  -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
  -DPython3_EXECUTABLE=/usr/bin/python3 \
  -DVTKSVO_PARAVIEW=OFF -DVTKSVO_SANITIZE=OFF \
  -DVTKSVO_TESTING=ON -DVTKSVO_EXAMPLES=ON -DVTKSVO_PYTHON=ON \
  ${VTKSVO_CMAKE_ARGUMENTS:-}
cmake --build build/vtk -j "$VTKSVO_JOBS"

# Several sources in one, which takes two thirds of the time; the other tree says whether each includes what it uses.
step "Build: build/paraview"
cmake -S . -B build/paraview -G Ninja \
  -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
  -DPython3_EXECUTABLE=/usr/bin/python3 \
  -DParaView_DIR="$(echo "$paraview"/usr/lib/*/cmake/paraview-*)" \
  -DVTKSVO_PARAVIEW=ON -DVTKSVO_SANITIZE=OFF -DVTKSVO_TESTING=ON -DVTKSVO_PYTHON=ON \
  -DCMAKE_UNITY_BUILD=ON \
  ${VTKSVO_CMAKE_ARGUMENTS:-}
cmake --build build/paraview -j "$VTKSVO_JOBS"

# One virtual display for the whole suite; -noreset, because the server resets whenever its last
# window closes and windows opened meanwhile die.
step "Tests"
selection=(-LE long)
[ "$long" = no ] || selection=()
result=0
xvfb-run -a -s "-noreset -screen 0 1920x1200x24" bash -c '
  result=0
  for tree in build/vtk build/paraview; do
    ctest --test-dir "$tree" -j "$VTKSVO_JOBS" --output-on-failure --timeout 300 "$@" || result=$?
  done
  exit $result' tests "${selection[@]}" || result=$?

step "clang-tidy"
if [ "$tidies" = yes ]; then
  Testing/run-tidy.sh "${check_only[@]}" || result=$?
else
  echo "The code is kept for the checks of Debian 12's version; what another one says: Testing/run-tidy.sh"
fi

if [ "$long" = yes ]; then
  [ -n "${VTKSVO_SCRIPTS:-}" ] ||
    echo "VTKSVO_SCRIPTS names no folder of scripts: they were not compared with the pass and without."
  step "Sanitizers"
  Testing/run-sanitizers.sh "${check_only[@]}" || result=$?
  step "Thread sanitizer"
  Testing/run-thread-sanitizer.sh "${check_only[@]}" || result=$?
  for release in bookworm trixie sid; do
    step "Fresh $release"
    Testing/run-on.sh "${check_only[@]}" "$release" || result=$?
  done
fi

echo
if [ "$result" -eq 0 ]; then
  echo "All tests passed. Python: PYTHONPATH=$PWD/build/vtk/python /usr/bin/python3 -c 'import vtksvo'"
else
  echo "Some tests failed, or clang-tidy has something to say (above). Details of tests: Testing/Temporary/LastTest.log in build/vtk and build/paraview"
fi
echo "ParaView plugin: $(find "$PWD/build/paraview/lib" -name SparseVoxelOctree.so)"
exit "$result"
