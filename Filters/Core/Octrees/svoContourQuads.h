// The quads of a contour: which cells they join.
#ifndef svoContourQuads_h
#define svoContourQuads_h

#include "svoCellPlanes.h"
#include "svoParallel.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace svo
{
/// Numbers of points, counter-clockwise seen from where planes' normals point.
using Quad = std::array<std::int32_t, 4>;
using CellFlags = std::unique_ptr<std::atomic<unsigned char>[]>;

/// The quads around the edges of cells whose corners lie on different sides, of the cells' numbers,
/// in parts whose order is always the same. `used`: set to 1 for cells that are part of a quad.
std::vector<std::vector<Quad>> quadsOf(
  const CellPlanes& cells, const ParallelFor& parallelFor, const CellFlags& used);
}

#endif
