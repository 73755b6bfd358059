#!/bin/bash
# Installs what is missing, builds PaperScenes in build/vtk and renders the paper's experiments on real meshes: a
# table of figures on the terminal; pictures, movie frames, a movie and figures.json in build/demo.
# Usage: run-demo.sh [--quick] [--stand-in] [--no-install] [--output DIR]
#   --quick       few and small frames, to see that everything works; its figures mean little
#   --stand-in    generated meshes in place of those from Debian's packages
#   --no-install  never installs: names what is missing and stops
#   --output DIR  in place of build/demo
# Safe to run again; the frames of the run before are replaced. VTKSVO_CMAKE_ARGUMENTS in the
# environment goes to CMake: -D options of one's own.
set -euo pipefail
called_from="$PWD"
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage() {
  sed -n '4,8s/^# //p' Examples/run-demo.sh
}
output="$PWD/build/demo"
frames=(--frames 10 --movie-frames 450)
stand_in=no
check_only=()
while [ $# -gt 0 ]; do
  case "$1" in
    --quick) frames=(--frames 1 --movie-frames 12 --size 640x360) ;;
    --stand-in) stand_in=yes ;;
    --no-install) check_only=(--no-install) ;;
    --output)
      if [ -z "${2:-}" ]; then
        echo "run-demo.sh: --output needs a folder" >&2
        exit 2
      fi
      case "$2" in
        /*) output="$2" ;;
        *) output="$called_from/$2" ;;
      esac
      shift
      ;;
    -h | --help)
      usage
      exit 0
      ;;
    *)
      echo "run-demo.sh: unknown argument '$1'" >&2
      usage >&2
      exit 2
      ;;
  esac
  shift
done
step() { printf '\n== %s (%s)\n' "$1" "$(date +%T)"; }
fail() {
  echo "run-demo.sh: $1" >&2
  exit 1
}

step "Packages"
CMake/install-packages.sh "${check_only[@]}" build demo
echo "All packages are there."

step "Build: build/vtk"
cmake -S . -B build/vtk -G Ninja \
  -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
  -DPython3_EXECUTABLE=/usr/bin/python3 \
  -DVTKSVO_PARAVIEW=OFF -DVTKSVO_SANITIZE=OFF \
  -DVTKSVO_TESTING=OFF -DVTKSVO_EXAMPLES=ON -DVTKSVO_PYTHON=ON \
  ${VTKSVO_CMAKE_ARGUMENTS:-}
cmake --build build/vtk -j "${VTKSVO_JOBS:-$(nproc)}" --target PaperScenes

mkdir -p "$output" || fail "cannot make the folder $output"
rm -f "$output"/frames/frame-?????.png "$output"/paper*.png
rm -f "$output/paper.mp4" "$output/figures.json" "$output/table.txt"

step "Meshes"
meshes=(--stand-in)
if [ "$stand_in" = no ]; then
  Examples/unpack-meshes.sh build/meshes ChineseDragon-10kv.off
  walker=$(dpkg -L assimp-testmodels | grep '/sydney\.md2$') ||
    fail "the package assimp-testmodels holds no sydney.md2"
  meshes=(--a build/meshes/ChineseDragon-10kv.off --b "$walker")
  echo "A: build/meshes/ChineseDragon-10kv.off"
  echo "B: $walker"
else
  echo "Generated stand-ins"
fi

step "Experiments"
# The user's own display where there is one, so that a GPU can show what it does; else a virtual one.
display=()
if [ -z "${DISPLAY:-}" ]; then
  display=(xvfb-run -a -s "-noreset -screen 0 1920x1200x24")
fi
"${display[@]}" build/vtk/bin/PaperScenes "${meshes[@]}" "${frames[@]}" --output "$output" |
  tee "$output/table.txt"

step "Movie"
# 4:2:0 H.264 with its index in front is what browsers and today's players open.
ffmpeg -y -loglevel error -nostdin -framerate 25 -i "$output/frames/frame-%05d.png" \
  -c:v libx264 -preset medium -crf 18 -pix_fmt yuv420p -movflags +faststart "$output/paper.mp4"

step "Done"
echo "Movie:     $output/paper.mp4"
echo "Frames:    $output/frames/frame-*.png ($(ls "$output/frames" | wc -l))"
echo "Figures:   $output/figures.json, $output/table.txt"
echo "Pictures (those named vtkShadowMapPass are VTK's own rasteriser, for comparison):"
ls "$output"/paper*.png | sed 's/^/  /'
echo "The rest of build/vtk, Python's modules among it: cmake --build build/vtk"
plugin=$(find build/paraview/lib -name SparseVoxelOctree.so 2>/dev/null || true)
echo "ParaView plugin: ${plugin:+$PWD/}${plugin:-Testing/run-tests.sh builds it}"
