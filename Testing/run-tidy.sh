#!/bin/bash
# Has clang-tidy look at the libraries while build/tidy compiles them. What is asked: .clang-tidy.
# Usage: run-tidy.sh [--no-install]       The exit code is 0 only if there is nothing to say.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

CMake/install-packages.sh "$@" build tidy

# With headers that are not compiled ahead: clang does not read those of another compiler. Several sources in one, and kernels for
# one instruction set: that is a tenth of the time.
cmake -S . -B build/tidy -G Ninja \
  -DCMAKE_BUILD_TYPE=Debug -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_UNITY_BUILD=ON \
  -DCMAKE_CXX_FLAGS=-DHWY_COMPILE_ONLY_STATIC \
  -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_CLANG_TIDY="clang-tidy;--quiet" \
  -DVTKSVO_TESTING=OFF -DVTKSVO_PYTHON=OFF -DVTKSVO_EXAMPLES=OFF
cmake --build build/tidy -j "${VTKSVO_JOBS:-2}" -- -k 0
