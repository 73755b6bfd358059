// The one triangle that stands for a cell of an octree.
#ifndef svoRepresentative_h
#define svoRepresentative_h

#include "svoOctree.h"
#include "svoOctreeCells.h"

#include <cstdint>

namespace svo
{
/// A triangle below the node: the first one of the first brick.
std::uint32_t firstTriangle(const Octree& octree, std::uint32_t node);

/// The triangle that is nearest to the cell's centre among those of the cell's brick; above the
/// bricks, the first triangle. The octree must have its surface.
std::uint32_t nearestTriangle(const Octree& octree, const OctreeCell& cell, int level);
}

#endif
