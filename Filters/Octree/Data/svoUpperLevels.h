// Dense tables of an octree's upper levels: where a ray that has left its node goes on.
//
// A packet of rays keeps no stack. A lane that leaves its node looks its new position up here and
// finds either the node that holds it, a few levels above the voxels, or how far the empty space
// around it reaches, which replaces several steps from the root.
#ifndef svoUpperLevels_h
#define svoUpperLevels_h

#include "svoLayout.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
struct UpperLevels
{
  /// The finest table that is made: 64^3 entries, 1 MB. Small octrees end at 16^3 (16 KB).
  static constexpr int MaximumTables = 1 + 6 / NodeLevels;

  /// An entry holds the node and the size of its cells as an exponent of mantissa bits:
  /// node << 5 | exponent. An empty entry is Empty | (exponent of the empty cell - NodeLevels): a
  /// node without any cell, in whose place the whole block is empty.
  static constexpr std::uint32_t Empty = 0x80000000u;

  /// Table k divides the root cube's edge by n = NodeEdge^k; entry x + n (y + n z).
  std::vector<std::uint32_t> tables[MaximumTables];
  int tableCount = 0;

  /// The box of the entries of the last table that are not empty, octree coordinates.
  glm::vec3 low{ 1.0f };
  glm::vec3 high{ 2.0f };

  std::size_t bytes() const;
};

/// The tables of an octree with these nodes, for `bytes` of which at most about as much memory
/// again is spent.
UpperLevels makeUpperLevels(const Header& header, const Node* nodes, std::size_t bytes);
}

#endif
