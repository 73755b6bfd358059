// Reading a node (svoLayout.h): which of its cells are occupied, and where their nodes lie.
//
// Cells are named by their index in Morton order. A brick's cells are voxels and have no nodes. The
// cells that make up one of an octree level `above` them, 8^above, follow each other: with 1 it is
// the level in between, with NodeLevels the node's whole block.
#ifndef svoNode_h
#define svoNode_h

#include "svoLayout.h"

#include <cassert>
#include <cstdint>

namespace svo
{
/// Set bits of a mask.
inline int countBits(std::uint64_t mask)
{
  return __builtin_popcountll(mask);
}

/// Index of the lowest set bit of a mask, which is not 0.
inline int lowestBit(std::uint64_t mask)
{
  assert(mask != 0);
  return __builtin_ctzll(mask);
}

/// A mask with one cell in it.
inline std::uint64_t cellBit(int i)
{
  assert(i >= 0 && i < NodeCells);
  return std::uint64_t(1) << i;
}

/// True if cell i is occupied: then an inner node has a child there, a brick a voxel.
inline bool hasChild(const Node& node, int i)
{
  assert(i >= 0 && i < NodeCells);
  return node.mask >> i & 1;
}

/// Occupied cells of a node: the children of an inner node, the voxels of a brick.
inline int childCount(const Node& node)
{
  return countBits(node.mask);
}

/// Occupied cells before cell i.
inline int childrenBefore(const Node& node, int i)
{
  return countBits(node.mask & (cellBit(i) - 1));
}

/// Index of the node of cell i, which is occupied. The node is an inner one.
inline std::uint32_t child(const Node& node, int i)
{
  assert(hasChild(node, i));
  return node.first + static_cast<std::uint32_t>(childrenBefore(node, i));
}

/// Cells of a node that make up one `above` them.
constexpr int cellsBelow(int above)
{
  return 1 << (3 * above);
}

/// The first of those that cell i is one of.
constexpr int firstBelow(int i, int above)
{
  return i & -cellsBelow(above);
}

/// As many bits.
constexpr std::uint64_t maskBelow(int above)
{
  return ~std::uint64_t(0) >> (64 - cellsBelow(above));
}

/// The occupied cells of a node, or of a mask, of those from `first` on: bits from 0 on.
inline std::uint64_t occupiedBelow(std::uint64_t mask, int first, int above)
{
  assert(first >= 0 && first < NodeCells && first == firstBelow(first, above));
  return mask >> first & maskBelow(above);
}
inline std::uint64_t occupiedBelow(const Node& node, int first, int above)
{
  return occupiedBelow(node.mask, first, above);
}

/// How far above a cell that is not occupied the largest one around it is that is empty, too.
inline int emptyAbove(const Node& node, int i)
{
  int above = 0;
  while (above + 1 < NodeLevels && occupiedBelow(node, firstBelow(i, above + 1), above + 1) == 0)
  {
    ++above;
  }
  return above;
}
}

#endif
