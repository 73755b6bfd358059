#!/bin/bash
# Unpacks Debian's ParaView with its Python package into build/paraview-debian, and prints that path.
# Usage: unpack-paraview.sh [--no-install] [folder]
#
# Building a plugin needs the package python3-paraview, which cannot be installed beside python3-vtk9
# (that libvtk9-dev depends on). So the packages paraview, paraview-dev and python3-paraview are
# downloaded and unpacked into a folder of this project; what they depend on is installed as usual, see
# install-packages.sh. Nothing outside of the folder is changed, and a folder that holds the version
# that apt would install is left alone. With --no-install nothing is downloaded: a missing or
# older folder is named, and the exit code is 1.
set -euo pipefail

install=yes
folder="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)/build/paraview-debian"
for argument in "$@"; do
  case "$argument" in
    --no-install) install=no ;;
    -*)
      sed -n '3s/^# //p' "${BASH_SOURCE[0]}" >&2
      exit 2
      ;;
    *) folder="$argument" ;;
  esac
done
packages=(paraview paraview-dev python3-paraview)

# The version of the installed dependencies, so that the unpacked libraries fit them.
wanted=$(dpkg-query -W -f='${Version}' paraview 2>/dev/null || true)
if [ -z "$wanted" ]; then
  echo "unpack-paraview.sh: install paraview first (CMake/install-packages.sh paraview)" >&2
  exit 1
fi
stamp="$folder/unpacked-version"
if [ "$(cat "$stamp" 2>/dev/null || true)" = "$wanted" ]; then
  echo "$folder"
  exit 0
fi
if [ "$install" = no ]; then
  echo "Missing: ${packages[*]} $wanted, unpacked in $folder" >&2
  exit 1
fi

echo "Unpacking ${packages[*]} $wanted" >&2
rm -rf "$folder"
mkdir -p "$folder/packages"
(
  cd "$folder/packages"
  apt-get download -q "${packages[@]/%/=$wanted}" >&2
  for package in *.deb; do
    dpkg-deb -x "$package" ..
  done
)
rm -rf "$folder/packages"
echo "$wanted" >"$stamp"
echo "$folder"
