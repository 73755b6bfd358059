#!/bin/bash
# Measures what frames, rays and builders cost beside their peers, draws the plots and fills in the
# tables of Documentation/Performance.md. Builds what it needs. Safe to run again. About 25 minutes
# on two idle cores, 10 more with --against.
# Usage: run-performance.sh [--against COMMIT] [--as NAME] [--frames N] [--quick] [--no-install]
#   --against COMMIT  builds that commit beside the tree as well, and draws its frames in turn with
#                     ours, so that a gain or a loss is a ratio: 3a32caf (0.2) or later, older ones
#                     lack what the programs call. The page's bars are those of its own run
#   --as NAME         these are figures of another machine than the page's: kept beside its own as
#                     Documentation/Performance/NAME.json, and shown in the table of machines alone
#   --frames N        timed for each figure, 9 unless said otherwise
#   --quick           few frames of few experiments (5 minutes), to look at a change: fills a copy
#                     of the page in build/performance and prints it
#   --no-install      never installs: names what is missing and stops
# The exit code is 0 if everything could be measured, whether bars are met or not.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

quick=no
against=
name=performance
frames=9
check_only=()
while [ $# -gt 0 ]; do
  case "$1" in
    --quick) quick=yes ;;
    --no-install) check_only=(--no-install) ;;
    --as)
      name=${2:-}
      [[ "$name" =~ ^[A-Za-z0-9-]+$ ]] || { echo "run-performance.sh: --as takes a name" >&2; exit 2; }
      shift
      ;;
    --frames)
      frames=${2:-}
      [[ "$frames" =~ ^[1-9][0-9]*$ ]] || { echo "run-performance.sh: --frames takes a number" >&2; exit 2; }
      shift
      ;;
    --against)
      against=$(git rev-parse --short --verify "${2:-}^{commit}") || exit 2
      shift
      ;;
    *)
      sed -n '2,15s/^# //p' "${BASH_SOURCE[0]}"
      exit 2
      ;;
  esac
  shift
done
fail() { echo "run-performance.sh: $1" >&2; exit 1; }
step() { printf '\n== %s (%s)\n' "$1" "$(date +%T)"; }

CMake/install-packages.sh "${check_only[@]}" build test demo accuracy
CMake/install-packages.sh "${check_only[@]}" performance ||
  echo "These peers are left out."

step "Build"
programs=(BenchmarkFrames BenchmarkTrace BenchmarkBuild)
configuration=(-G Ninja -DCMAKE_BUILD_TYPE=Release -DVTKSVO_TESTING=ON
  -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
  -DPython3_EXECUTABLE=/usr/bin/python3)
jobs=${VTKSVO_JOBS:-2}
cmake -S . -B build/vtk "${configuration[@]}" >/dev/null
cmake --build build/vtk -j "$jobs" --target "${programs[@]}"

# An older commit with the benchmark of today: its own has other experiments, or none.
before=build/performance-$against
if [ -n "$against" ]; then
  [ -d "$before" ] || git worktree add --detach "$before" "$against"
  rm -rf "$before/Examples" "$before/Testing/Benchmarks"
  cp -rp Examples "$before"
  cp -rp Testing/Benchmarks "$before/Testing"
  cat >"$before/Testing/CMakeLists.txt" <<'END'
add_library(svoBenchmarkMesh STATIC Benchmarks/svoBenchmarkMesh.cxx)
target_link_libraries(svoBenchmarkMesh PUBLIC SVO::SVOOctree VTK::CommonDataModel PRIVATE PaperMeshes SVO::SVOCore)
add_subdirectory(Benchmarks/Results)
add_subdirectory(Benchmarks/Performance)
END
  cmake -S "$before" -B "$before/build" "${configuration[@]}" -DVTKSVO_PYTHON=OFF >/dev/null
  cmake --build "$before/build" -j "$jobs" --target BenchmarkFrames
fi

step "Meshes"
out=build/performance
mkdir -p "$out"
rm -f "$out"/*.json "$out"/*.txt
names=(ChineseDragon-10kv armadillo bunny00 refined_elephant)
Examples/unpack-meshes.sh build/meshes "${names[@]/%/.off}"
walker=$(dpkg -L assimp-testmodels | grep '/sydney\.md2$') ||
  fail "the package assimp-testmodels holds no sydney.md2"
meshes=("${names[@]/#/build/meshes/}")
meshes=("${meshes[@]/%/.off}")

display=()
if [ -z "${DISPLAY:-}" ]; then
  display=(xvfb-run -a -s "-noreset -screen 0 1920x1200x24")
fi
# draw TREE OUTPUT ARGUMENT...
draw() {
  "${display[@]}" "$1/bin/BenchmarkFrames" --a build/meshes/ChineseDragon-10kv.off --b "$walker" \
    --output "$out/$2.json" "${@:3}" >>"$out/log.txt" 2>&1 ||
    fail "$2 could not be measured; see $out/log.txt"
  echo "$2 ($(date +%T))"
}
# trace OUTPUT ARGUMENT...
trace() {
  build/vtk/bin/BenchmarkTrace --json "$out/$1.json" "${@:2}" >>"$out/log.txt" 2>&1 ||
    fail "$1 could not be measured; see $out/log.txt"
  echo "$1 ($(date +%T))"
}
sets=()
for set in AVX-512 AVX2 SSE4 scalar; do
  if build/vtk/bin/BenchmarkTrace --isa "$set" --levels 2 --size 8x8 --repeat 1 >/dev/null; then
    sets+=("$set")
  fi
done

if [ -n "$against" ]; then
  step "Frames, in turn with $against"
  rounds=3
  [ "$quick" = no ] || rounds=2
  for ((round = 1; round <= rounds; ++round)); do
    for tree in before now; do
      bin=build/vtk
      [ "$tree" = now ] || bin="$before/build"
      # Short runs that alternate.
      draw "$bin" "$tree-$round" --ours --frames 3 --scenes paper1a,paper4 \
        --experiments scenes,instructionSets
    done
  done
fi

step "Frames"
if [ "$quick" = yes ]; then
  draw build/vtk frames --frames 3 --seconds 10 --scenes paper4 \
    --experiments scenes,instructionSets,shadows
else
  draw build/vtk frames --frames "$frames" --seconds 20 --experiments \
    scenes,instructionSets,refined,shadows,lights,lightKit,sizes,levels,objects,triangles,cores
fi
counts=(1)
while [ $((2 * counts[-1])) -le "$(nproc)" ]; do
  counts+=($((2 * counts[-1])))
done
for round in 1 2; do
  for threads in "${counts[@]}"; do
    VTK_SMP_MAX_THREADS=$threads LP_NUM_THREADS=$threads \
      draw build/vtk "threads-$threads-$round" --frames 3 --experiments threads
  done
  [ "$quick" = no ] || break
done

step "Rays"
if [ "$quick" = yes ]; then
  trace rays-armadillo --levels 10 --repeat 3 --instances 10 build/meshes/armadillo.off
else
  for round in 1 2; do
    for set in "${sets[@]}"; do
      trace "rays-$set-$round" --isa "$set" --levels 10 --repeat 3 --instances 10 "${meshes[@]}"
    done
  done
  trace rays-levels --levels 6,7,8,9,11,12 --repeat 3 build/meshes/armadillo.off
  trace rays-crowd --levels 8 --repeat 3 --instances 100 build/meshes/armadillo.off
  trace rays-triangles --levels 10 --repeat 3 --ball 1e4 --ball 1e5 --ball 1e6 --ball 1e7
  step "Builders"
  build/vtk/bin/BenchmarkBuild --levels 8,10 --repeat 3 --json "$out/build.json" "${meshes[@]}"
fi

# The plugin's tests know how to run ParaView's programs.
if [ "$quick" = no ] && [ -d build/paraview ]; then
  step "ParaView"
  cmake --build build/paraview -j "$jobs" >/dev/null
  for round in 1 2 3; do
    "${display[@]}" ctest --test-dir build/paraview -R '^ParaView-measure$' -V |
      tee -a "$out/paraview.txt" | grep 'orbit, '
  done
fi

step "Page"
export PYTHONPATH=Testing/Benchmarks PYTHONDONTWRITEBYTECODE=1
page=Documentation/Performance.md
images=Documentation/Images
figures=Documentation/Performance
if [ "$quick" = yes ]; then
  cp "$page" "$out/Performance.md"
  page=$out/Performance.md
  images=$out
  figures=$out/figures
fi
mkdir -p "$figures"
/usr/bin/python3 Testing/Benchmarks/Performance/collect.py "$out" "$figures/$name.json" \
  "commit=$(git describe --always --dirty)" "against=$against" "frames=$frames"
[ "$name" != performance ] ||
  /usr/bin/python3 Testing/Benchmarks/Performance/plots.py "$figures/$name.json" "$images"
/usr/bin/python3 Testing/Benchmarks/Performance/tables.py "$figures/$name.json" "$page"
grep '^|' "$page"
