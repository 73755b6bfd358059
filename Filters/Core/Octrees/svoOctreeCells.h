// Walks over the occupied cells of one octree level, in Morton order.
#ifndef svoOctreeCells_h
#define svoOctreeCells_h

#include "svoMorton.h"
#include "svoNode.h"
#include "svoOctree.h"

#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// An occupied cell, and where it is stored.
struct OctreeCell
{
  glm::ivec3 cell;    // integer coordinates at the level
  std::uint32_t node; // whose mask holds the cell's bits
  int firstBit;
  int bitCount; // 1, 8 for a level in between, or 64 for the cube itself
};

namespace detail
{
template <class Visit>
bool visitCells(
  const Octree& octree, std::uint32_t index, glm::ivec3 block, int remaining, const Visit& visit)
{
  const Node& node = octree.nodes()[index];
  if (remaining == 1) // the level in between: a byte of the mask is a cell
  {
    for (int group = 0; group < 8; ++group)
    {
      const glm::ivec3 at = 2 * block + glm::ivec3(group & 1, group >> 1 & 1, group >> 2);
      const int first = GroupSize * group;
      if (groupCells(node, first) != 0 && !visit(OctreeCell{ at, index, first, GroupSize }))
      {
        return false;
      }
    }
    return true;
  }
  std::uint32_t child = node.first;
  for (std::uint64_t mask = node.mask; mask; mask &= mask - 1)
  {
    const int bit = lowestBit(mask);
    const glm::ivec3 at = 4 * block + cellOfIndex(bit);
    const bool goOn = remaining == 2 ? visit(OctreeCell{ at, index, bit, 1 })
                                     : visitCells(octree, child++, at, remaining - 2, visit);
    if (!goOn)
    {
      return false;
    }
  }
  return true;
}
}

/// Calls visit(const OctreeCell&) for every occupied cell of `level` (0..octree.level()) until it
/// returns false; then returns false.
template <class Visit>
bool forEachCell(const Octree& octree, int level, const Visit& visit)
{
  if (octree.empty())
  {
    return true;
  }
  const int bits = level + 2 * octree.depthCount() - octree.level();
  return bits == 0 ? visit(OctreeCell{ glm::ivec3(0), 0, 0, 64 })
                   : detail::visitCells(octree, 0, glm::ivec3(0), bits, visit);
}
}

#endif
