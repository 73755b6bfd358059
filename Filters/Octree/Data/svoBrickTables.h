// Tables that widen masks of a coordinate, or of a tile of columns, to the voxels of a brick.
#ifndef svoBrickTables_h
#define svoBrickTables_h

#include "svoMorton.h"

#include <cstdint>

namespace svo
{
struct BrickTables
{
  /// Of a tile.
  static constexpr unsigned AllColumns = (1u << NodeEdge * NodeEdge) - 1;

  /// [axis][low byte, high byte][bits]: the cells of a 4x4 tile across `axis`, in Morton order
  /// (u, v, u, v with u = axis + 1 and v = axis + 2, cyclically), as columns of voxels.
  std::uint64_t column[3][2][256] = {};
  /// [axis][first][last]: the voxels with first <= coordinate <= last.
  std::uint64_t range[3][4][4] = {};

  BrickTables()
  {
    for (int i = 0; i < NodeCells; ++i)
    {
      const glm::ivec3 c = cellOfIndex(i);
      for (int axis = 0; axis < 3; ++axis)
      {
        const int u = c[(axis + 1) % 3];
        const int v = c[(axis + 2) % 3];
        const int cell = (u & 1) | (v & 1) << 1 | (u & 2) << 1 | (v & 2) << 2;
        for (int bits = 0; bits < 256; ++bits)
        {
          this->column[axis][cell >> 3][bits] |= std::uint64_t(bits >> (cell & 7) & 1) << i;
        }
        for (int first = 0; first <= c[axis]; ++first)
        {
          for (int last = c[axis]; last < NodeEdge; ++last)
          {
            this->range[axis][first][last] |= std::uint64_t(1) << i;
          }
        }
      }
    }
  }

  std::uint64_t columns(int axis, unsigned tile) const
  {
    return this->column[axis][0][tile & 255] | this->column[axis][1][tile >> 8];
  }

  static const BrickTables& get()
  {
    static const BrickTables tables;
    return tables;
  }
};
}

#endif
