#!/bin/bash
# Installs the packages in a folder on a fresh Debian and uses them, one after the other: from Python, in
# ParaView, for a program of one's own. Called by run-on.sh, as root.
# Usage: use.sh DIR
set -euo pipefail
packages="$1"
cd "$(dirname "${BASH_SOURCE[0]}")"

step() { printf '\n-- %s\n' "$1"; }
install() {
  DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "$@" ||
    { echo "use.sh: apt cannot install $*" >&2; exit 1; }
}
absent() {
  for tool in "$@"; do
    ! command -v "$tool" || { echo "use.sh: $tool is there, so this proves little" >&2; exit 1; }
  done
}
display() { xvfb-run -a -s "-noreset -screen 0 1920x1200x24" "$@"; }

step "Python"
apt-get update -q
install "$packages"/libvtksvo[0-9]*.deb "$packages"/python3-vtksvo_*.deb xvfb xauth libgl1-mesa-dri
absent g++ c++ cmake ninja
display python3 check_vtk.py "$packages"

# Up to Debian 13 the Python packages of VTK and of ParaView conflict: this one replaces the other. It may
# bring g++, through those that it needs.
step "ParaView"
install "$packages"/paraview-vtksvo_*.deb python3-paraview
absent cmake ninja
for program in pvpython pvbatch; do
  display "$program" check_paraview.py "$packages"
done
plugin=$(dirname "$(dpkg -L paraview-vtksvo | grep '/SparseVoxelOctree\.so$')")
PYTHONPATH="$plugin/python" display pvpython -c \
  'import vtksvo; print(vtksvo.__file__, vtksvo.vtkSVORenderPass().GetClassName())'

# libvtk9-dev needs VTK's Python package. For that apt does not give up ParaView's unless told to.
step "A program"
install "$packages"/libvtksvo-dev_*.deb "$packages"/libvtksvo[0-9]*.deb python3-paraview- \
  g++ cmake ninja-build
cmake -S ../Install/Project -B /tmp/program -G Ninja -DCMAKE_BUILD_TYPE=Release
cmake --build /tmp/program
display /tmp/program/shadow

step "Removed again"
DEBIAN_FRONTEND=noninteractive apt-get purge -y -q libvtksvo-dev 'libvtksvo[0-9]*' paraview-vtksvo
left=$(find /usr /etc /var/lib/dpkg/info -ipath '*vtksvo*' -o -name 'SparseVoxelOctree*' -o -path /usr/bin/paraview.conf)
[ -z "$left" ] || { printf 'use.sh: packages left these behind:\n%s\n' "$left" >&2; exit 1; }
echo "Nothing is left of them."
