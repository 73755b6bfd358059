#!/bin/bash
# Unpacks all meshes of Debian's package libcgal-demo. Usage: unpack-all-meshes.sh folder
set -euo pipefail
mkdir -p "$1"
archive=$(dpkg -L libcgal-demo | grep '/data\.tar\.gz$')
if [ ! -e "$archive" ]; then
  # Slim images of Debian drop everything below /usr/share/doc when a package is installed.
  (cd "$1" && apt-get download -q libcgal-demo && dpkg-deb -x libcgal-demo_*.deb .)
  archive="$1$archive"
fi
tar -xzf "$archive" -C "$1" --strip-components=2 --wildcards 'data/meshes/*.off'
