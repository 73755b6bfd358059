#!/bin/bash
# Installs the Debian packages that a part of the project needs, and says what each is for.
# Usage: install-packages.sh [--list] [--no-install] group...
# Groups: build test paraview demo fuzz accuracy performance fresh tidy user
# Packages that are there already are left alone; with none missing nothing runs and nothing is
# asked. --no-install only checks: it names what is missing and ends with 1. --list prints names.
set -euo pipefail

packages_build="
cmake|configures the build
ninja-build|runs the build
g++|the C++17 compiler
ccache|makes the next build from scratch quick
libvtk9-dev|VTK: headers, libraries, Python wrapping
python3-vtk9|VTK's own Python package, which vtksvo stands beside
libglm-dev|vectors and matrices of the engine
libhwy-dev|Highway: SIMD, the instruction set chosen at run time
libopenvdb-dev|reads and writes OpenVDB's files; without it the build leaves that out
libtbb-dev|OpenVDB's threads"
# Debian 12 has no PyVista, and Debian 13 no Mayavi.
plotting=python3-pyvista
# ParaView's window is made with Qt 5 in Debian 12 and with Qt 6 since.
svg_icons=qt6-svg-plugins
if grep -qs '^VERSION_ID="12"' /etc/os-release; then
  plotting=mayavi2
  svg_icons=libqt5svg5
fi
packages_test="
libgtest-dev|unit tests
xvfb|a display for machines without one
xauth|access to that display
libgl1-mesa-dri|software OpenGL
glslang-tools|reads shaders as the language is written, not as one driver takes it
libembree-dev|the ray tracer that the benchmark compares with
libopenvdb-tools|vdb_print, which has to open the OpenVDB files that we write
python3-openvdb|so has OpenVDB's Python module
python3-vedo|draws its meshes with the pass, as the documentation's recipes say
$plotting|so does this
dpkg-dev|finds out what our own packages depend on
file|tells it which of their files are programs
lintian|finds what Debian would not have in them"
packages_paraview="
paraview|ParaView and what it depends on
paraview-dev|its headers and CMake package
python3-numpy|the plugin's tests judge their pictures with it
assimp-testmodels|the figure that walks in the tests
openmpi-bin|tests on several processes
$svg_icons|icons in ParaView's window"
packages_demo="
xvfb|a display for machines without one
xauth|access to that display
libgl1-mesa-dri|software OpenGL
libassimp-dev|reads the meshes of objects A and B
libcgal-demo|object A: ChineseDragon-10kv.off
assimp-testmodels|object B: sydney.md2
ffmpeg|turns the frames into a movie"
packages_fuzz="
clang|libFuzzer, which hunts for octree files that do harm
libclang-rt-dev|its runtime and that of the sanitizers"
packages_accuracy="
libembree-dev|the exact reference that accuracy is measured against
libcgal-demo|the meshes that it is measured on
assimp-testmodels|the walking figure of the paper's scenes
python3-matplotlib|draws the plots of Documentation/Accuracy.md and Performance.md"
packages_performance="
libboost-dev|Boost.Polygon unites shadow outlines, to compare with
libnanovdb-dev|another march through voxels to compare with
libopenvdb-dev|another builder of voxels to compare with
libtbb-dev|OpenVDB's threads"
packages_fresh="
mmdebstrap|makes the root file system of a fresh Debian
debian-archive-keyring|its releases' keys
git|takes HEAD there"
packages_tidy="
clang-tidy|looks at the code for mistakes that compilers do not warn of"
packages_user="
uidmap|lets a user be root in a root file system"

list=no
install=yes
wanted=""
for argument in "$@"; do
  case "$argument" in
    --list) list=yes ;;
    --no-install) install=no ;;
    build) wanted+="$packages_build" ;;
    test) wanted+="$packages_test" ;;
    demo) wanted+="$packages_demo" ;;
    fuzz) wanted+="$packages_fuzz" ;;
    accuracy) wanted+="$packages_accuracy" ;;
    performance) wanted+="$packages_performance" ;;
    fresh) wanted+="$packages_fresh" ;;
    tidy) wanted+="$packages_tidy" ;;
    user) wanted+="$packages_user" ;;
    paraview) wanted+="$packages_paraview" ;;
    *)
      echo "install-packages.sh: unknown argument '$argument'" \
        "(groups: build test paraview demo fuzz accuracy performance fresh tidy user)" >&2
      exit 2
      ;;
  esac
done

installed() {
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

missing=()
reasons=""
declare -A seen
while IFS='|' read -r name reason; do
  [ -n "$name" ] || continue
  [ -z "${seen[$name]:-}" ] || continue
  seen[$name]=1
  if [ "$list" = yes ]; then
    echo "$name"
  elif ! installed "$name"; then
    missing+=("$name")
    reasons+=$(printf '  %-20s %s' "$name" "$reason")$'\n'
  fi
done <<<"$wanted"
[ "$list" = no ] || exit 0
[ ${#missing[@]} -gt 0 ] || exit 0

if [ "$install" = no ]; then
  printf 'Missing packages:\n%s' "$reasons" >&2
  exit 1
fi
if ! command -v apt-get >/dev/null; then
  printf 'This machine has no apt-get. Please install these by hand (names as in Debian):\n%s' \
    "$reasons" >&2
  exit 1
fi
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    printf 'Missing packages:\n%sPlease run this as root, or install sudo.\n' "$reasons" >&2
    exit 1
  fi
  as_root=(sudo)
fi
printf 'Installing %d packages (and what they depend on):\n%s' "${#missing[@]}" "$reasons"
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q \
  --no-install-recommends "${missing[@]}"
