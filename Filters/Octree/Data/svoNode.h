// Reading a node (svoLayout.h): which of its 64 cells are occupied, and where their nodes lie.
//
// Cells are named by their index 0..63 in Morton order. A brick's cells are voxels and have no
// nodes. Eight cells in a row, from a multiple of 8 on, are a group: the 2x2x2 cells that are one
// cell of the octree level in between.
#ifndef svoNode_h
#define svoNode_h

#include "svoLayout.h"

#include <cassert>
#include <cstdint>

namespace svo
{
constexpr int GroupSize = 8; // cells

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
  assert(i >= 0 && i < 64);
  return std::uint64_t(1) << i;
}

/// True if cell i is occupied: then an inner node has a child there, a brick a voxel.
inline bool hasChild(const Node& node, int i)
{
  assert(i >= 0 && i < 64);
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

/// The first cell of the group that cell i is in.
constexpr int groupOf(int i)
{
  return i & 56;
}

/// The occupied cells of the group whose first cell is `first`, as bits 0..7.
inline std::uint64_t groupCells(const Node& node, int first)
{
  assert(first >= 0 && first < 64 && first % GroupSize == 0);
  return node.mask >> first & 0xff;
}
}

#endif
