#!/bin/bash
# Builds build/tsan under ThreadSanitizer and runs the C++ tests there.
# Usage: run-thread-sanitizer.sh [--no-install] [ctest arguments, e.g. -R TestTracer]
# VTK's own libraries are not instrumented. Their threads are seen to start and to end if they are
# plain ones, so VTK is told to use those and not TBB's, whose hand-overs cannot be seen. Excused by
# name are only libraries that are not ours: thread-sanitizer.supp.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

check_only=()
if [ "${1:-}" = --no-install ]; then
  check_only=(--no-install)
  shift
fi
CMake/install-packages.sh "${check_only[@]}" build test

cmake -S . -B build/tsan -G Ninja \
  -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
  -DVTKSVO_SANITIZE=thread -DVTKSVO_PYTHON=OFF -DVTKSVO_EXAMPLES=OFF
cmake --build build/tsan -j "${VTKSVO_JOBS:-2}"

export TSAN_OPTIONS="suppressions=$PWD/Testing/thread-sanitizer.supp:history_size=4:second_deadlock_stack=1"
export VTK_SMP_BACKEND_IN_USE=STDThread VTK_SMP_MAX_THREADS=4
# Without randomised addresses: ThreadSanitizer keeps its shadow where they might land.
xvfb-run -a -s "-noreset -screen 0 1920x1200x24" setarch "$(uname -m)" -R \
  ctest --test-dir build/tsan --output-on-failure --timeout 3600 -LE "long|benchmark" "$@"
