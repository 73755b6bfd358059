#!/bin/bash
# Builds build/fuzz with clang, AddressSanitizer and UndefinedBehaviorSanitizer, and lets libFuzzer
# damage octree files and OpenVDB grids. Usage: run-fuzzer.sh [--no-install] [seconds for each, default 60]
# New inputs go to build/fuzz/corpus; a finding is a file build/fuzz/crash-... or timeout-..., to be
# put into Testing/Fuzz/Corpus once it is mended. The exit code is 0 if there was none.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

check_only=()
if [ "${1:-}" = --no-install ]; then
  check_only=(--no-install)
  shift
fi
seconds="${1:-60}"
CMake/install-packages.sh "${check_only[@]}" build fuzz

cmake -S . -B build/fuzz -G Ninja \
  -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
  -DVTKSVO_FUZZ=ON -DVTKSVO_PYTHON=OFF -DVTKSVO_EXAMPLES=OFF
cmake --build build/fuzz -j "${VTKSVO_JOBS:-2}" --target FuzzOctree FuzzVDB

mkdir -p build/fuzz/corpus build/fuzz/corpus-vdb
export ASAN_OPTIONS="detect_leaks=1:detect_stack_use_after_return=1"
export LSAN_OPTIONS="suppressions=$PWD/Testing/sanitizers.supp:print_suppressions=0"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1:suppressions=$PWD/Testing/undefined.supp"
fuzz() {
  "build/fuzz/bin/$1" -timeout=10 -rss_limit_mb=2048 -max_total_time="$seconds" \
    -artifact_prefix=build/fuzz/ "${@:2}"
}
fuzz FuzzOctree build/fuzz/corpus Testing/Fuzz/Corpus
fuzz FuzzVDB build/fuzz/corpus-vdb Testing/Fuzz/CorpusVDB
