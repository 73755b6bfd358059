#!/bin/bash
# Builds build/sanitize under AddressSanitizer and UndefinedBehaviorSanitizer, with assert() alive, and
# runs the C++ tests there. Usage: run-sanitizers.sh [--no-install] [ctest arguments, e.g. -R TestBuild]
# Only libraries that are not ours are excused from leak reports: sanitizers.supp names them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

check_only=()
if [ "${1:-}" = --no-install ]; then
  check_only=(--no-install)
  shift
fi
CMake/install-packages.sh "${check_only[@]}" build test

cmake -S . -B build/sanitize -G Ninja \
  -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g" \
  -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
  -DVTKSVO_SANITIZE=ON -DVTKSVO_PYTHON=OFF -DVTKSVO_EXAMPLES=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
cmake --build build/sanitize -j "${VTKSVO_JOBS:-2}"

export ASAN_OPTIONS="detect_leaks=1:detect_stack_use_after_return=1:strict_init_order=1"
export LSAN_OPTIONS="suppressions=$PWD/Testing/sanitizers.supp:print_suppressions=0"
export UBSAN_OPTIONS="print_stacktrace=1"
xvfb-run -a -s "-noreset -screen 0 1920x1200x24" \
  ctest --test-dir build/sanitize --output-on-failure --timeout 3600 -LE "long|benchmark" "$@"
