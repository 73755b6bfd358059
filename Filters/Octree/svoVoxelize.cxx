#include "svoVoxelize.h"

#include "svoBrickMask.h"
#include "svoLattice.h"
#include "svoMorton.h"
#include "svoTriangleBox.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// The voxels, and the bricks around them, whose grown boxes touch a triangle's bounding box.
struct Range
{
  glm::ivec3 first, last;           // voxels
  glm::ivec3 firstBrick, lastBrick; // bricks

  Range(const LatticeTriangle& t, int level)
  {
    const std::int32_t end = (1 << level) - 1;
    for (int i = 0; i < 3; ++i)
    {
      const auto [low, high] =
        std::minmax({ t.vertices[0][i], t.vertices[1][i], t.vertices[2][i] });
      this->first[i] = std::max((low - 2) >> LatticeBits, 0);
      this->last[i] = std::min((high + 1) >> LatticeBits, end);
      this->firstBrick[i] = this->first[i] >> 2;
      this->lastBrick[i] = this->last[i] >> 2;
    }
  }

  std::uint64_t brickMask(const BrickTables& tables, int axis, int brick) const
  {
    return tables.range[axis][std::max(this->first[axis] - 4 * brick, 0)]
                       [std::min(this->last[axis] - 4 * brick, 3)];
  }
};

float offsetInBrick(const LatticeTriangle& t, const glm::ivec3& brick)
{
  return static_cast<float>(t.offset - glm::dot(t.normal, glm::dvec3(brick) * 4.0 + 2.0));
}

/// Triangles without area, which are segments or points: top-down with the exact test.
class SegmentWalker
{
public:
  SegmentWalker(const LatticeTriangle& t, int level, std::vector<BrickRecord>& records)
    : Triangle(t)
    , Test(t.vertices[0], t.vertices[1], t.vertices[2])
    , Within(t, level)
    , Records(records)
  {
  }

  std::uint64_t walk()
  {
    const glm::ivec3 &first = this->Within.first, &last = this->Within.last;
    int bits = 2;
    while ((last.x >> bits) - (first.x >> bits) > 1 || (last.y >> bits) - (first.y >> bits) > 1 ||
      (last.z >> bits) - (first.z >> bits) > 1)
    {
      ++bits;
    }
    for (int z = first.z >> bits; z <= last.z >> bits; ++z)
    {
      for (int y = first.y >> bits; y <= last.y >> bits; ++y)
      {
        for (int x = first.x >> bits; x <= last.x >> bits; ++x)
        {
          this->visit({ x, y, z }, bits);
        }
      }
    }
    return this->Voxels;
  }

private:
  bool touches(const glm::ivec3& cell, int bits) const
  {
    const int shift = bits + LatticeBits;
    const glm::ivec3 low = cell * (1 << shift) - 1;
    return this->Test.overlaps(low, low + ((1 << shift) + 2));
  }

  void visit(const glm::ivec3& cell, int bits)
  {
    if (!this->touches(cell, bits))
    {
      return;
    }
    if (bits > 2)
    {
      for (int i = 0; i < 8; ++i)
      {
        this->visit(cell * 2 + glm::ivec3(i & 1, i >> 1 & 1, i >> 2), bits - 1);
      }
      return;
    }
    std::uint64_t mask = 0;
    for (int i = 0; i < 64; ++i)
    {
      const glm::ivec3 voxel = cell * 4 + cellOfIndex(i);
      if (voxel.x <= this->Within.last.x && voxel.y <= this->Within.last.y &&
        voxel.z <= this->Within.last.z && this->touches(voxel, 0))
      {
        mask |= 1ull << i;
        ++this->Voxels;
      }
    }
    if (mask)
    {
      this->Records.push_back({ mortonKey(cell.x, cell.y, cell.z), mask, this->Triangle.id,
        offsetInBrick(this->Triangle, cell) });
    }
  }

  const LatticeTriangle& Triangle;
  TriangleBox<std::int64_t> Test; // no plane and 2D edges only: never beyond 64 bits
  Range Within;
  std::vector<BrickRecord>& Records;
  std::uint64_t Voxels = 0;
};

/// A triangle's projection along an axis, as half planes over the voxels of 4x4 tiles.
class Projection
{
public:
  /// `area` is the normal's component along the axis: only its sign matters. Where it is 0 the
  /// projection is a segment, which a box must meet from both sides of every edge.
  void set(const LatticeTriangle& t, int axis, int area)
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    this->Count = 0;
    for (int i = 0; i < 3; ++i)
    {
      const glm::ivec3& p = t.vertices[i];
      const glm::ivec3& q = t.vertices[i == 2 ? 0 : i + 1];
      const std::int64_t nu = p[v] - q[v];
      const std::int64_t nv = q[u] - p[u];
      if (nu == 0 && nv == 0)
      {
        continue;
      }
      if (area >= 0)
      {
        this->add(nu, nv, p[u], p[v]);
      }
      if (area <= 0)
      {
        this->add(-nu, -nv, p[u], p[v]);
      }
    }
  }

  /// Tiles of a row that the projection may touch, intersected with [first, last].
  void clipRow(int tileY, int& first, int& last) const
  {
    for (int i = 0; i < this->Count && first <= last; ++i)
    {
      this->Edges[i].clipRow(tileY, first, last);
    }
  }

  /// Cells of a tile that the projection touches, 16 bits; `inside` if the whole tile is inside it.
  unsigned mask(int tileX, int tileY, bool& inside) const
  {
    unsigned outside = 0;
    inside = true;
    for (int i = 0; i < this->Count; ++i)
    {
      const TileEdge& edge = this->Edges[i];
      const std::int64_t value = edge.at(tileX, tileY);
      if (edge.misses(value))
      {
        return 0;
      }
      inside = inside && edge.contains(value);
      if (!edge.covers(value))
      {
        edge.addOutside(value, outside);
      }
    }
    return ~outside & 0xffffu;
  }

private:
  void add(std::int64_t nu, std::int64_t nv, std::int64_t pu, std::int64_t pv)
  {
    // The corner of voxel (0, 0)'s grown box that lies farthest to the inside.
    const std::int64_t most =
      nu * ((nu > 0 ? LatticeUnits + 1 : -1) - pu) + nv * ((nv > 0 ? LatticeUnits + 1 : -1) - pv);
    const std::int64_t span = (std::abs(nu) + std::abs(nv)) * (LatticeUnits + 2);
    this->Edges[this->Count++] = TileEdge(nu, nv, most >> LatticeBits, (span >> LatticeBits) + 1);
  }

  TileEdge Edges[6];
  int Count = 0;
};

/// Int holds the plane's values over the whole triangle, Lane those over the brick it crosses.
template <typename Int, typename Lane>
class PlaneWalker
{
public:
  PlaneWalker(const LatticeTriangle& t, const Range& within, const std::int64_t normal[3])
    : Triangle(t)
    , Within(within)
    , Normal{ normal[0], normal[1], normal[2] }
    , Slab(normal, this->initialise(normal))
  {
  }

  std::uint64_t walk(std::vector<BrickRecord>& records, std::uint32_t part, std::uint32_t parts)
  {
    const BrickTables& tables = BrickTables::get();
    const Range& r = this->Within;
    const int w = this->dominantAxis();
    const int u = (w + 1) % 3;
    const int v = (w + 2) % 3;
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t n = this->Normal[axis];
      this->Shadows[axis].set(this->Triangle, axis, (n > 0) - (n < 0));
    }
    const std::uint64_t rows = r.lastBrick[v] - r.firstBrick[v] + 1;
    const int firstRow = r.firstBrick[v] + static_cast<int>(rows * part / parts);
    const int endRow = r.firstBrick[v] + static_cast<int>(rows * (part + 1) / parts);
    std::uint64_t voxels = 0;
    glm::ivec3 b;
    for (b[v] = firstRow; b[v] < endRow; ++b[v])
    {
      int first = r.firstBrick[u];
      int last = r.lastBrick[u];
      if (last - first > 3)
      {
        this->Shadows[w].clipRow(b[v], first, last);
      }
      const std::uint64_t row = r.brickMask(tables, v, b[v]);
      const std::uint64_t rowKey = spreadBits(b[v]) << v;
      for (b[u] = first; b[u] <= last; ++b[u])
      {
        bool inside;
        const unsigned tile = this->Shadows[w].mask(b[u], b[v], inside);
        const std::uint64_t column = row & r.brickMask(tables, u, b[u]) & tables.columns(w, tile);
        if (column == 0)
        {
          continue;
        }
        const std::uint64_t columnKey = rowKey | spreadBits(b[u]) << u;
        int firstW, lastW;
        Int base = this->columnBase(b, u, v, w, firstW, lastW);
        for (b[w] = firstW; b[w] <= lastW; ++b[w], base += 4 * this->Normal[w])
        {
          if (base + this->Most < 0 || base + this->Least > this->Thickness)
          {
            continue;
          }
          std::uint64_t mask =
            column & r.brickMask(tables, w, b[w]) & this->Slab.mask(static_cast<Lane>(base));
          if (mask != 0 && !inside)
          {
            bool ignored;
            mask &= tables.columns(u, this->Shadows[u].mask(b[v], b[w], ignored)) &
              tables.columns(v, this->Shadows[v].mask(b[w], b[u], ignored));
          }
          if (mask != 0)
          {
            voxels += __builtin_popcountll(mask);
            records.push_back({ columnKey | spreadBits(b[w]) << w, mask, this->Triangle.id,
              offsetInBrick(this->Triangle, b) });
          }
        }
      }
    }
    return voxels;
  }

private:
  /// Coordinates are relative to the first brick, to keep Int small. Returns the slab's thickness.
  Lane initialise(const std::int64_t n[3])
  {
    Int most = 0;
    Int least = 0;
    this->Most = 0;
    this->Least = 0;
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t from =
        (this->Within.firstBrick[i] << (2 + LatticeBits)) - this->Triangle.vertices[0][i];
      const std::int32_t high = n[i] > 0 ? LatticeUnits + 1 : -1;
      const std::int32_t low = n[i] > 0 ? -1 : LatticeUnits + 1;
      most += static_cast<Int>(n[i]) * (from + high);
      least += static_cast<Int>(n[i]) * (from + low);
      this->Most += 3 * std::max<std::int64_t>(n[i], 0);
      this->Least += 3 * std::min<std::int64_t>(n[i], 0);
    }
    // Rounding down is exact: what is compared with them are integers.
    this->Base = most >> LatticeBits;
    this->Thickness = static_cast<std::int64_t>((-least >> LatticeBits) + this->Base);
    return static_cast<Lane>(this->Thickness);
  }

  int dominantAxis() const
  {
    const std::int64_t x = std::abs(this->Normal[0]);
    const std::int64_t y = std::abs(this->Normal[1]);
    const std::int64_t z = std::abs(this->Normal[2]);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  }

  /// The plane's value in the first brick of a column, and the bricks it may cross there.
  Int columnBase(const glm::ivec3& b, int u, int v, int w, int& first, int& last) const
  {
    const Range& r = this->Within;
    first = r.firstBrick[w];
    last = r.lastBrick[w];
    Int base = this->Base + static_cast<Int>(this->Normal[u]) * (4 * (b[u] - r.firstBrick[u])) +
      static_cast<Int>(this->Normal[v]) * (4 * (b[v] - r.firstBrick[v]));
    if (last - first > 3)
    {
      // 0 <= base + Most + step * i and base + Least + step * i <= Thickness, give or take one for
      // the division in double.
      const double step = 4.0 * static_cast<double>(this->Normal[w]);
      const double a = -static_cast<double>(base + this->Most) / step;
      const double c = static_cast<double>(this->Thickness - this->Least - base) / step;
      const double span = last - first;
      const int from = static_cast<int>(std::clamp(std::min(a, c) - 1.0, 0.0, span));
      const int to = static_cast<int>(std::clamp(std::max(a, c) + 2.0, 0.0, span));
      base += static_cast<Int>(this->Normal[w]) * 4 * from;
      last = first + to;
      first += from;
    }
    return base;
  }

  const LatticeTriangle& Triangle;
  const Range& Within;
  std::int64_t Normal[3];
  Int Base;
  std::int64_t Thickness, Most, Least;
  BrickSlab<Lane> Slab;
  Projection Shadows[3];
};
}

std::uint64_t voxelizeTriangle(const LatticeTriangle& t, int level,
  std::vector<BrickRecord>& records, std::uint32_t part, std::uint32_t parts)
{
  const Range range(t, level);
  const glm::ivec3 p = t.vertices[1] - t.vertices[0];
  const glm::ivec3 q = t.vertices[2] - t.vertices[0];
  std::int64_t normal[3];
  std::int64_t largest = 0;
  for (int i = 0; i < 3; ++i)
  {
    const int u = (i + 1) % 3;
    const int v = (i + 2) % 3;
    normal[i] = static_cast<std::int64_t>(p[u]) * q[v] - static_cast<std::int64_t>(p[v]) * q[u];
    largest = std::max(largest, std::abs(normal[i]));
  }
  if (largest == 0)
  {
    return part == 0 ? SegmentWalker(t, level, records).walk() : 0;
  }
  if (largest < 1 << 24)
  {
    return PlaneWalker<std::int64_t, std::int32_t>(t, range, normal).walk(records, part, parts);
  }
  const glm::ivec3 bricks = range.lastBrick - range.firstBrick;
  if (largest < std::int64_t(1) << 38 && std::max({ bricks.x, bricks.y, bricks.z }) < 1 << 9)
  {
    return PlaneWalker<std::int64_t, std::int64_t>(t, range, normal).walk(records, part, parts);
  }
  return PlaneWalker<__int128, std::int64_t>(t, range, normal).walk(records, part, parts);
}
}
