#!/bin/bash
# Makes the Debian packages of build/vtk and build/paraview, which Testing/run-tests.sh builds, and
# collects them in build/packages.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

rm -rf build/packages
mkdir -p build/packages
for tree in build/vtk build/paraview; do
  (cd "$tree" && rm -rf packages && cpack)
  cp "$tree"/packages/*.deb build/packages
done
