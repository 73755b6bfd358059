// Morton order: interleaved coordinate bits, x lowest.
#ifndef svoMorton_h
#define svoMorton_h

#include "svoLayout.h"

#include <cassert>
#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// Index 0..63 of the cell (x, y, z), each 0..3, in a 4x4x4 block.
constexpr int cellIndex(int x, int y, int z)
{
  assert((x & 3) == x && (y & 3) == y && (z & 3) == z);
  return (x & 1) | (y & 1) << 1 | (z & 1) << 2 | (x >> 1) << 3 | (y >> 1) << 4 | (z >> 1) << 5;
}

/// Index of the cell of a node that a cell `shift` levels further down, or a place among such, lies
/// in.
constexpr int cellAt(const glm::ivec3& place, int shift = 0)
{
  constexpr int In = NodeEdge - 1;
  return cellIndex(place.x >> shift & In, place.y >> shift & In, place.z >> shift & In);
}

/// Inverse of cellIndex.
inline glm::ivec3 cellOfIndex(int i)
{
  assert(i >= 0 && i < NodeCells);
  return { (i & 1) | (i >> 2 & 2), (i >> 1 & 1) | (i >> 3 & 2), (i >> 2 & 1) | (i >> 4 & 2) };
}

/// Spreads the low 21 bits of v to every third bit.
constexpr std::uint64_t spreadBits(std::uint64_t v)
{
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffull;
  v = (v | v << 16) & 0x1f0000ff0000ffull;
  v = (v | v << 8) & 0x100f00f00f00f00full;
  v = (v | v << 4) & 0x10c30c30c30c30c3ull;
  v = (v | v << 2) & 0x1249249249249249ull;
  return v;
}

/// Morton key of a cell with up to 21 bits a coordinate.
constexpr std::uint64_t mortonKey(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  return spreadBits(x) | spreadBits(y) << 1 | spreadBits(z) << 2;
}
}

#endif
