// Enumerates the bricks of a triangle row by row over the plane it faces most, on the best
// instruction set that the machine has.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoVoxelize.cxx"
#include <hwy/foreach_target.h>

#include "svoVoxelize.h"

#include "svoBrickMask-inl.h"
#include "svoBrickTables.h"
#include "svoLattice.h"
#include "svoMorton.h"
#include "svoTriangleBox.h"

#include <cmath>

#include <glm/geometric.hpp>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
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
  SegmentWalker(const LatticeTriangle& t, int level, RecordList& records)
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
      this->Records.push({ mortonKey(cell.x, cell.y, cell.z), mask, this->Triangle.id,
        offsetInBrick(this->Triangle, cell) });
    }
  }

  const LatticeTriangle& Triangle;
  TriangleBox<std::int64_t> Test; // no plane and 2D edges only: never beyond 64 bits
  Range Within;
  RecordList& Records;
  std::uint64_t Voxels = 0;
};

/// A triangle's projection along an axis, as half planes over the voxels of tiles that are counted
/// from `origin` (voxels). `area` is the normal's component along the axis: only its sign matters.
/// Where it is 0 the projection is a segment, which a box must meet from both sides of every edge.
template <typename Lane>
void projectTriangle(const LatticeTriangle& t, const glm::ivec3& origin, int axis,
  std::int64_t area, TileEdges<Lane>& edges)
{
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const auto add = [&](std::int64_t nu, std::int64_t nv, const glm::ivec3& p)
  {
    // The corner of the first voxel's grown box that lies farthest to the inside.
    const std::int64_t pu = p[u] - origin[u] * LatticeUnits;
    const std::int64_t pv = p[v] - origin[v] * LatticeUnits;
    const std::int64_t most =
      nu * ((nu > 0 ? LatticeUnits + 1 : -1) - pu) + nv * ((nv > 0 ? LatticeUnits + 1 : -1) - pv);
    const std::int64_t span = (std::abs(nu) + std::abs(nv)) * (LatticeUnits + 2);
    // Rounding down is exact: what is compared are integers.
    edges.add(nu, nv, most >> LatticeBits, (span >> LatticeBits) + 1);
  };
  edges.clear();
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
      add(nu, nv, p);
    }
    if (area <= 0)
    {
      add(-nu, -nv, p);
    }
  }
}

/// Int holds the plane's values over the whole triangle, Lane those over a brick that it crosses,
/// EdgeLane those of the projections' edges over the whole triangle.
template <typename Int, typename Lane, typename EdgeLane>
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

  std::uint64_t walk(RecordList& records, std::uint32_t part, std::uint32_t parts)
  {
    const BrickTables& tables = BrickTables::get();
    const Range& r = this->Within;
    const int w = this->dominantAxis();
    const int u = (w + 1) % 3;
    const int v = (w + 2) % 3;
    for (int axis = 0; axis < 3; ++axis)
    {
      projectTriangle(
        this->Triangle, r.firstBrick * 4, axis, this->Normal[axis], this->Shadows[axis]);
    }
    const int rows = r.lastBrick[v] - r.firstBrick[v] + 1;
    const int endRow = static_cast<int>(std::int64_t(rows) * (part + 1) / parts);
    std::uint64_t voxels = 0;
    glm::ivec3 i; // the brick, counted from the first
    for (i[v] = static_cast<int>(std::int64_t(rows) * part / parts); i[v] < endRow; ++i[v])
    {
      int first = 0;
      int last = r.lastBrick[u] - r.firstBrick[u];
      if (last > 3)
      {
        this->Shadows[w].clipRow(i[v], first, last);
      }
      const std::uint64_t row = r.brickMask(tables, v, r.firstBrick[v] + i[v]);
      const std::uint64_t rowKey = spreadBits(r.firstBrick[v] + i[v]) << v;
      for (i[u] = first; i[u] <= last; ++i[u])
      {
        const unsigned tile = this->Shadows[w].mask(i[u], i[v]);
        const std::uint64_t column =
          row & r.brickMask(tables, u, r.firstBrick[u] + i[u]) & tables.columns(w, tile);
        if (column == 0)
        {
          continue;
        }
        // A box above the inside of a projection meets the triangle where it meets its plane.
        const bool inside = tile == 0xffffu && this->Shadows[w].contains(i[u], i[v]);
        const std::uint64_t columnKey = rowKey | spreadBits(r.firstBrick[u] + i[u]) << u;
        int firstW, lastW;
        Int base = this->columnBase(i, u, v, w, firstW, lastW);
        for (i[w] = firstW; i[w] <= lastW; ++i[w], base += 4 * this->Normal[w])
        {
          if (base + this->Most < 0 || base + this->Least > this->Thickness)
          {
            continue;
          }
          const int brickW = r.firstBrick[w] + i[w];
          std::uint64_t mask =
            column & r.brickMask(tables, w, brickW) & this->Slab.mask(static_cast<Lane>(base));
          if (!inside)
          {
            mask &= tables.columns(u, this->Shadows[u].mask(i[v], i[w])) &
              tables.columns(v, this->Shadows[v].mask(i[w], i[u]));
          }
          if (mask != 0)
          {
            voxels += __builtin_popcountll(mask);
            records.push({ columnKey | spreadBits(brickW) << w, mask, this->Triangle.id,
              offsetInBrick(this->Triangle, r.firstBrick + i) });
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
  Int columnBase(const glm::ivec3& i, int u, int v, int w, int& first, int& last) const
  {
    const Range& r = this->Within;
    first = 0;
    last = r.lastBrick[w] - r.firstBrick[w];
    Int base = this->Base + static_cast<Int>(this->Normal[u]) * (4 * i[u]) +
      static_cast<Int>(this->Normal[v]) * (4 * i[v]);
    if (last > 3)
    {
      // 0 <= base + Most + step * i and base + Least + step * i <= Thickness, give or take one for
      // the division in double.
      const double step = 4.0 * static_cast<double>(this->Normal[w]);
      const double a = -static_cast<double>(base + this->Most) / step;
      const double c = static_cast<double>(this->Thickness - this->Least - base) / step;
      const double span = last;
      first = static_cast<int>(std::clamp(std::min(a, c) - 1.0, 0.0, span));
      last = static_cast<int>(std::clamp(std::max(a, c) + 2.0, 0.0, span));
      base += static_cast<Int>(this->Normal[w]) * 4 * first;
    }
    return base;
  }

  const LatticeTriangle& Triangle;
  const Range& Within;
  std::int64_t Normal[3];
  Int Base;
  std::int64_t Thickness, Most, Least;
  BrickSlab<Lane> Slab;
  TileEdges<EdgeLane> Shadows[3];
};
}

std::uint64_t voxelize(
  const LatticeTriangle& t, int level, RecordList& records, std::uint32_t part, std::uint32_t parts)
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
  const glm::ivec3 bricks = range.lastBrick - range.firstBrick;
  if (std::max({ bricks.x, bricks.y, bricks.z }) >= 1 << 8)
  {
    return PlaneWalker<__int128, std::int64_t, std::int64_t>(t, range, normal)
      .walk(records, part, parts);
  }
  return largest < 1 << 24 ? PlaneWalker<std::int64_t, std::int32_t, std::int32_t>(t, range, normal)
                               .walk(records, part, parts)
                           : PlaneWalker<std::int64_t, std::int64_t, std::int32_t>(t, range, normal)
                               .walk(records, part, parts);
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(voxelize);

std::uint64_t voxelizeTriangle(
  const LatticeTriangle& t, int level, RecordList& records, std::uint32_t part, std::uint32_t parts)
{
  return HWY_DYNAMIC_DISPATCH(voxelize)(t, level, records, part, parts);
}
}
#endif
