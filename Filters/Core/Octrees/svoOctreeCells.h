// Walks over the occupied cells of one octree level, in Morton order.
#ifndef svoOctreeCells_h
#define svoOctreeCells_h

#include "svoMorton.h"
#include "svoNode.h"
#include "svoOctree.h"

#include <algorithm>
#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// An occupied cell, and where it is stored: StopCell.
struct OctreeCell
{
  glm::ivec3 cell;    // integer coordinates at the level
  std::uint32_t node; // whose mask holds the cell's bits
  int firstBit;
  int above;
};

namespace detail
{
template <class Visit>
bool visitCells(
  const Octree& octree, std::uint32_t index, glm::ivec3 block, int remaining, const Visit& visit)
{
  const Node& node = octree.nodes()[index];
  const int above = std::max(NodeLevels - remaining, 0);
  std::uint32_t child = node.first;
  for (std::uint64_t mask = node.mask; mask;)
  {
    const int first = firstBelow(lowestBit(mask), above);
    mask &= ~(maskBelow(above) << first);
    const glm::ivec3 at = (NodeEdge * block + cellOfIndex(first)) >> above;
    const bool goOn = remaining <= NodeLevels
      ? visit(OctreeCell{ at, index, first, above })
      : visitCells(octree, child++, at, remaining - NodeLevels, visit);
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
  return octree.empty() ||
    detail::visitCells(octree, 0, glm::ivec3(0), octree.rootBits(level), visit);
}
}

#endif
