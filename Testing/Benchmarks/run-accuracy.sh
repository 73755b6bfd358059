#!/bin/bash
# Measures speed against accuracy on real meshes, draws the plots and fills in the tables of
# Documentation/Accuracy.md. Builds what it needs. Safe to run again.
# Usage: run-accuracy.sh [--check] [--no-install]
#   --check       only measures and holds the figures to the bars; writes to build/accuracy alone
#   --no-install  never installs: names what is missing and stops
# The exit code is 0 only if every bar is met, or missed as the text says.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

check=no
check_only=()
for argument in "$@"; do
  case "$argument" in
    --check) check=yes ;;
    --no-install) check_only=(--no-install) ;;
    *)
      sed -n '2,7s/^# //p' "${BASH_SOURCE[0]}"
      exit 2
      ;;
  esac
done
fail() { echo "run-accuracy.sh: $1" >&2; exit 1; }

CMake/install-packages.sh "${check_only[@]}" build test demo accuracy

# Within a test the program is there already, and building would start a build inside a build.
if [ "$check" = no ]; then
  cmake -S . -B build/vtk -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
    -DPython3_EXECUTABLE=/usr/bin/python3 -DVTKSVO_TESTING=ON
  cmake --build build/vtk -j "${VTKSVO_JOBS:-2}" --target BenchmarkAccuracy
fi
program=${VTKSVO_ACCURACY_PROGRAM:-build/vtk/bin/BenchmarkAccuracy}
[ -x "$program" ] || fail "$program is not built"

out=build/accuracy
mkdir -p "$out/pictures" "$out/meshes"
names=(ChineseDragon-10kv armadillo bunny00 refined_elephant)
Examples/unpack-meshes.sh "$out/meshes" "${names[@]/%/.off}"
walker=$(dpkg -L assimp-testmodels | grep '/sydney\.md2$') ||
  fail "the package assimp-testmodels holds no sydney.md2"

display=()
if [ -z "${DISPLAY:-}" ]; then
  display=(xvfb-run -a -s "-noreset -screen 0 1920x1200x24")
fi
result=0
"${display[@]}" "$program" --output "$out" --images "$out/pictures" \
  --paper "$out/meshes/ChineseDragon-10kv.off" "$walker" \
  "dragon=$out/meshes/ChineseDragon-10kv.off:y" "armadillo=$out/meshes/armadillo.off:y" \
  "bunny=$out/meshes/bunny00.off:y" "elephant=$out/meshes/refined_elephant.off:y" || result=$?
[ "$result" -le 1 ] || exit "$result"

if [ "$check" = no ]; then
  export PYTHONPATH=Testing/Benchmarks
  mkdir -p Documentation/Accuracy
  cp "$out/accuracy.json" "$out/accuracy.csv" Documentation/Accuracy/
  /usr/bin/python3 Testing/Benchmarks/Accuracy/plots.py \
    "$out/accuracy.json" "$out/pictures" Documentation/Images
  /usr/bin/python3 Testing/Benchmarks/Accuracy/tables.py \
    "$out/accuracy.json" Documentation/Accuracy.md
fi
exit "$result"
