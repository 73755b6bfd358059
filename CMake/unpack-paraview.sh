#!/bin/bash
# Unpacks Debian's ParaView with its Python package into build/paraview-debian, and prints that path.
# Usage: unpack-paraview.sh [--no-install] [folder]
#
# Building a plugin needs the package python3-paraview, which up to Debian 13 cannot be installed beside
# python3-vtk9 (that libvtk9-dev depends on), and CMake files that find what is in it. So the packages paraview, paraview-dev and python3-paraview are
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

# From Debian 13 on the names of Python's modules say for which interpreter they are. ParaView's CMake
# files expect the plain names.
find "$folder/usr/lib/python3" -name '*.cpython-*.so' | while read -r module; do
  ln -s "$(basename "$module")" "${module%%.cpython-*}.so"
done
# Where ParaView brings its own VTK, readers that a plugin does not use are linked to these, but the CMake
# files look for them only when such a reader is asked for.
for vtk in "$folder"/usr/lib/*/cmake/paraview-*/vtk; do
  [ -d "$vtk" ] || continue
  cat >"$vtk/vtk-find-package-helpers.cmake" <<'EOF'
foreach (unused IN ITEMS hdf5::hdf5 hdf5::hdf5_hl NetCDF::NetCDF)
  if (NOT TARGET "${unused}")
    add_library("${unused}" INTERFACE IMPORTED)
  endif ()
endforeach ()
EOF
done
echo "$wanted" >"$stamp"
echo "$folder"
