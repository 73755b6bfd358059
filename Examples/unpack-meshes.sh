#!/bin/bash
# Unpacks CGAL's sample meshes from Debian's package libcgal-demo into a folder.
# Usage: unpack-meshes.sh FOLDER mesh.off...   or: unpack-meshes.sh FOLDER --all
# Meshes that are there already are left alone. Ends with 1 and a message if one cannot be had.
set -euo pipefail

if [ $# -lt 2 ]; then
  sed -n '2,4s/^# //p' "${BASH_SOURCE[0]}"
  exit 2
fi
fail() {
  echo "unpack-meshes.sh: $1" >&2
  exit 1
}
folder="$1"
shift
missing=()
all=no
[ "$1" != --all ] || { all=yes; shift; }
for mesh in "$@"; do
  [ -s "$folder/$mesh" ] || missing+=("data/meshes/$mesh")
done
[ "$all" = yes ] || [ ${#missing[@]} -gt 0 ] || exit 0

mkdir -p "$folder" || fail "cannot make the folder $folder"
archive=$(dpkg -L libcgal-demo 2>/dev/null | grep '/data\.tar\.gz$') ||
  fail "the package libcgal-demo is not installed, or holds no data.tar.gz"
if [ ! -e "$archive" ]; then
  # Slim images of Debian drop everything below /usr/share/doc when a package is installed.
  echo "Unpacking libcgal-demo once more, as this machine keeps no /usr/share/doc"
  (cd "$folder" && apt-get download -q libcgal-demo && dpkg-deb -x libcgal-demo_*.deb .)
  archive="$folder$archive"
fi
if [ "$all" = yes ]; then
  readarray -t missing < <(tar -tzf "$archive" | grep -E '^data/meshes/[^/]*\.(off|ply|stl)$')
  [ ${#missing[@]} -gt 0 ] || fail "there is no mesh in $archive"
fi
# Unpacked beside and then moved, so that a mesh is whole or not there.
unpacked=$(mktemp -d "$folder/unpacked.XXXXXX")
trap 'rm -rf "$unpacked"' EXIT
tar -xzf "$archive" -C "$unpacked" --strip-components=2 "${missing[@]}" ||
  fail "cannot read ${missing[*]} from $archive"
mv -f "$unpacked"/* "$folder"
if [ "$all" = yes ]; then
  echo "Unpacked from $archive: all ${#missing[@]} meshes"
else
  echo "Unpacked from $archive: ${missing[*]##*/}"
fi
