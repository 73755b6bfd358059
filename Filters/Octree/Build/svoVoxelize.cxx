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
#include "svoNode.h"

#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
namespace
{
/// True if all coordinates are 0..end - 1.
[[maybe_unused]] bool isWithin(const LatticeTriangle& t, std::int32_t end)
{
  return std::all_of(
    &t.vertices[0][0], &t.vertices[0][0] + 9, [end](std::int32_t c) { return c >= 0 && c < end; });
}

/// The voxels, and the bricks around them, whose grown boxes touch a triangle's bounding box.
struct Range
{
  int first[3], last[3];           // voxels
  int firstBrick[3], lastBrick[3]; // bricks

  Range(const LatticeTriangle& t, int level)
  {
    const std::int32_t end = (1 << level) - 1;
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t a = t.vertices[0][i];
      const std::int32_t b = t.vertices[1][i];
      const std::int32_t c = t.vertices[2][i];
      this->first[i] = std::max((std::min(a, std::min(b, c)) - 2) >> LatticeBits, 0);
      this->last[i] = std::min((std::max(a, std::max(b, c)) + 1) >> LatticeBits, end);
      this->firstBrick[i] = this->first[i] >> NodeLevels;
      this->lastBrick[i] = this->last[i] >> NodeLevels;
    }
  }

  std::uint64_t brickMask(const BrickTables& tables, int axis, int brick) const
  {
    return tables.range[axis][std::max(this->first[axis] - NodeEdge * brick, 0)]
                       [std::min(this->last[axis] - NodeEdge * brick, NodeEdge - 1)];
  }
};

float offsetInBrick(const LatticeTriangle& t, const glm::ivec3& brick)
{
  return static_cast<float>(
    t.offset - glm::dot(t.normal, (glm::dvec3(brick) + 0.5) * double(NodeEdge)));
}

/// True if a triangle without area and a grown cell have a point in common (Schwarz & Seidel 2010):
/// their boxes have, and no edge of a projection has the cell on one side. An edge without length
/// is no test.
bool segmentTouches(const LatticeTriangle& t, const Range& within, const glm::ivec3& cell, int bits)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (cell[axis] < within.first[axis] >> bits || cell[axis] > within.last[axis] >> bits)
    {
      return false;
    }
  }
  const int shift = bits + LatticeBits;
  const glm::ivec3 low = cell * (1 << shift) - 1;
  const glm::ivec3 high = low + ((1 << shift) + 2);
  for (int axis = 0; axis < 3; ++axis)
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t* const p = t.vertices[i];
      const std::int32_t* const q = t.vertices[(i + 1) % 3];
      const std::int64_t nu = p[v] - q[v];
      const std::int64_t nv = q[u] - p[u];
      const std::int64_t most =
        nu * ((nu > 0 ? high[u] : low[u]) - p[u]) + nv * ((nv > 0 ? high[v] : low[v]) - p[v]);
      const std::int64_t least =
        nu * ((nu > 0 ? low[u] : high[u]) - p[u]) + nv * ((nv > 0 ? low[v] : high[v]) - p[v]);
      if (most < 0 || least > 0)
      {
        return false;
      }
    }
  }
  return true;
}

/// Appends the records of a triangle without area in a cell `bits` above the voxels; returns how
/// many voxels they name.
std::uint64_t visitSegment(const LatticeTriangle& t, const Range& within, const glm::ivec3& cell,
  int bits, RecordList& records)
{
  std::uint64_t voxels = 0;
  if (!segmentTouches(t, within, cell, bits))
  {
    return voxels;
  }
  if (bits > NodeLevels)
  {
    for (int i = 0; i < 8; ++i)
    {
      voxels += visitSegment(
        t, within, cell * 2 + glm::ivec3(i & 1, i >> 1 & 1, i >> 2), bits - 1, records);
    }
    return voxels;
  }
  std::uint64_t mask = 0;
  for (int i = 0; i < NodeCells; ++i)
  {
    mask |= segmentTouches(t, within, cell * NodeEdge + cellOfIndex(i), 0) ? cellBit(i) : 0;
  }
  if (mask)
  {
    records.push({ mortonKey(cell.x, cell.y, cell.z), mask, t.id, offsetInBrick(t, cell) });
  }
  return static_cast<std::uint64_t>(countBits(mask));
}

/// Triangles without area, which are segments or points: top-down with an exact test.
std::uint64_t walkSegment(const LatticeTriangle& t, const Range& within, RecordList& records)
{
  const int* const f = within.first;
  const int* const l = within.last;
  int bits = NodeLevels;
  while ((l[0] >> bits) - (f[0] >> bits) > 1 || (l[1] >> bits) - (f[1] >> bits) > 1 ||
    (l[2] >> bits) - (f[2] >> bits) > 1)
  {
    ++bits;
  }
  std::uint64_t voxels = 0;
  for (int z = f[2] >> bits; z <= l[2] >> bits; ++z)
  {
    for (int y = f[1] >> bits; y <= l[1] >> bits; ++y)
    {
      for (int x = f[0] >> bits; x <= l[0] >> bits; ++x)
      {
        voxels += visitSegment(t, within, { x, y, z }, bits, records);
      }
    }
  }
  return voxels;
}

/// A triangle's projection along an axis, as half planes over the voxels of tiles that are counted
/// from `firstBrick`. `area` is the normal's component along the axis: only its sign matters.
/// Where it is 0 the projection is a segment, which a box must meet from both sides of every edge.
template <typename Lane>
void projectTriangle(const LatticeTriangle& t, const int firstBrick[3], int axis, std::int64_t area,
  TileEdges<Lane>& edges)
{
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const auto add = [&](std::int64_t nu, std::int64_t nv, const std::int32_t* p)
  {
    // The corner of the first voxel's grown box that lies farthest to the inside.
    const std::int64_t pu = p[u] - firstBrick[u] * (NodeEdge * LatticeUnits);
    const std::int64_t pv = p[v] - firstBrick[v] * (NodeEdge * LatticeUnits);
    const std::int64_t most =
      nu * ((nu > 0 ? LatticeUnits + 1 : -1) - pu) + nv * ((nv > 0 ? LatticeUnits + 1 : -1) - pv);
    const std::int64_t span = (std::abs(nu) + std::abs(nv)) * (LatticeUnits + 2);
    // Rounding down is exact: what is compared are integers.
    edges.add(nu, nv, most >> LatticeBits, (span >> LatticeBits) + 1);
  };
  edges.clear();
  for (int i = 0; i < 3; ++i)
  {
    const std::int32_t* const p = t.vertices[i];
    const std::int32_t* const q = t.vertices[i == 2 ? 0 : i + 1];
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
      projectTriangle(this->Triangle, r.firstBrick, axis, this->Normal[axis], this->Shadows[axis]);
    }
    // The plane's offset from a brick's centre.
    const glm::dvec3& n = this->Triangle.normal;
    const double normal[3] = { n.x, n.y, n.z };
    const auto along = [&](int axis, int brick)
    { return normal[axis] * (NodeEdge * (brick + 0.5)); };
    // Added to a key with the bits between set, one more brick carries over them.
    const std::uint64_t axisBits = 0x1249249249249249ull;
    const int rows = r.lastBrick[v] - r.firstBrick[v] + 1;
    const int endRow = static_cast<int>(std::int64_t(rows) * (part + 1) / parts);
    std::uint64_t voxels = 0;
    for (int y = static_cast<int>(std::int64_t(rows) * part / parts); y < endRow; ++y)
    {
      int first = 0;
      int last = r.lastBrick[u] - r.firstBrick[u];
      if (last > 3)
      {
        this->Shadows[w].clipRow(y, first, last);
      }
      const int brickV = r.firstBrick[v] + y;
      const std::uint64_t row = r.brickMask(tables, v, brickV);
      const std::uint64_t rowKey = spreadBits(brickV) << v;
      const double rowOffset = this->Triangle.offset - along(v, brickV);
      for (int x = first; x <= last; ++x)
      {
        const unsigned tile = this->Shadows[w].mask(x, y);
        const int brickU = r.firstBrick[u] + x;
        const std::uint64_t column = row & r.brickMask(tables, u, brickU) & tables.columns(w, tile);
        if (column == 0)
        {
          continue;
        }
        // A box above the inside of a projection meets the triangle where it meets its plane.
        const bool inside = tile == BrickTables::AllColumns && this->Shadows[w].contains(x, y);
        const double columnOffset = rowOffset - along(u, brickU);
        int firstW, lastW;
        Int base = this->columnBase(x, y, u, v, w, firstW, lastW);
        std::uint64_t keyW = spreadBits(r.firstBrick[w] + firstW);
        const std::uint64_t columnKey = rowKey | spreadBits(brickU) << u;
        for (int z = firstW; z <= lastW;
             ++z, base += NodeEdge * this->Normal[w], keyW = ((keyW | ~axisBits) + 1) & axisBits)
        {
          if (base + this->Most < 0 || base + this->Least > this->Thickness)
          {
            continue;
          }
          const int brickW = r.firstBrick[w] + z;
          std::uint64_t mask =
            column & r.brickMask(tables, w, brickW) & this->Slab.mask(static_cast<Lane>(base));
          if (!inside)
          {
            mask &= tables.columns(u, this->Shadows[u].mask(y, z)) &
              tables.columns(v, this->Shadows[v].mask(z, x));
          }
          if (mask != 0)
          {
            voxels += countBits(mask);
            records.push({ columnKey | keyW << w, mask, this->Triangle.id,
              static_cast<float>(columnOffset - along(w, brickW)) });
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
        (this->Within.firstBrick[i] << (NodeLevels + LatticeBits)) - this->Triangle.vertices[0][i];
      const std::int32_t high = n[i] > 0 ? LatticeUnits + 1 : -1;
      const std::int32_t low = n[i] > 0 ? -1 : LatticeUnits + 1;
      most += static_cast<Int>(n[i]) * (from + high);
      least += static_cast<Int>(n[i]) * (from + low);
      this->Most += (NodeEdge - 1) * std::max<std::int64_t>(n[i], 0);
      this->Least += (NodeEdge - 1) * std::min<std::int64_t>(n[i], 0);
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
  Int columnBase(int x, int y, int u, int v, int w, int& first, int& last) const
  {
    const Range& r = this->Within;
    first = 0;
    last = r.lastBrick[w] - r.firstBrick[w];
    Int base = this->Base + static_cast<Int>(this->Normal[u]) * (NodeEdge * x) +
      static_cast<Int>(this->Normal[v]) * (NodeEdge * y);
    if (last > 3)
    {
      // 0 <= base + Most + step * i and base + Least + step * i <= Thickness, give or take one for
      // the division in double.
      const double step = double(NodeEdge) * static_cast<double>(this->Normal[w]);
      const double a = -static_cast<double>(base + this->Most) / step;
      const double c = static_cast<double>(this->Thickness - this->Least - base) / step;
      const double span = last;
      first = static_cast<int>(std::clamp(std::min(a, c) - 1.0, 0.0, span));
      last = static_cast<int>(std::clamp(std::max(a, c) + 2.0, 0.0, span));
      base += static_cast<Int>(this->Normal[w]) * NodeEdge * first;
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
  assert(level >= 1 && level <= MaximumLevel && part < parts);
  assert(isWithin(t, 1 << (level + LatticeBits)));
  const Range range(t, level);
  std::int64_t normal[3];
  std::int64_t largest = 0;
  int bricks = 0;
  for (int i = 0; i < 3; ++i)
  {
    const int u = (i + 1) % 3;
    const int v = (i + 2) % 3;
    const std::int64_t pu = t.vertices[1][u] - t.vertices[0][u];
    const std::int64_t pv = t.vertices[1][v] - t.vertices[0][v];
    const std::int64_t qu = t.vertices[2][u] - t.vertices[0][u];
    const std::int64_t qv = t.vertices[2][v] - t.vertices[0][v];
    normal[i] = pu * qv - pv * qu;
    largest = std::max(largest, std::abs(normal[i]));
    bricks = std::max(bricks, range.lastBrick[i] - range.firstBrick[i]);
  }
  if (largest == 0)
  {
    return part == 0 ? walkSegment(t, range, records) : 0;
  }
  if (bricks >= 1 << 8)
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
