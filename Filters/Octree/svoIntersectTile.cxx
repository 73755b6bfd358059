#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoIntersectTile.cxx"
#include <hwy/foreach_target.h>

#include "svoIntersectTile.h"
#include "svoMorton.h"
#include "svoTriangle.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <hwy/highway.h>

#ifndef SVO_INTERSECT_TILE_ONCE
#define SVO_INTERSECT_TILE_ONCE
namespace svo
{
/// What ten roundings to float can do to a linear function, of the sum of its terms' sizes.
constexpr double RoundingSlack = 1.0 / (1 << 18);

/// Lower corners of a node's 64 cells, for a node of edge 1, in the order of cellIndex().
struct CellOffsets
{
  alignas(64) float x[64], y[64], z[64];

  CellOffsets()
  {
    for (int i = 0; i < 64; ++i)
    {
      const glm::ivec3 cell = cellOfIndex(i);
      x[i] = 0.25f * static_cast<float>(cell.x);
      y[i] = 0.25f * static_cast<float>(cell.y);
      z[i] = 0.25f * static_cast<float>(cell.z);
    }
  }
};
}
#endif

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::ScalableTag<float>;
using DI = hn::ScalableTag<std::int32_t>;
using DFour = hn::CappedTag<float, 4>;
using F = hn::Vec<DF>;
using I = hn::Vec<DI>;

/// Bit i: lane i.
template <class D, class M>
HWY_INLINE std::uint64_t laneBits(D d, M mask)
{
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  std::uint64_t bits;
  std::memcpy(&bits, bytes, 8);
  return bits;
}

/// What linear functions grow by from the lower corner of a node, for a node of edge 1.
struct ChildTables
{
  HWY_ALIGN float most[4][64]; // to the best corner of child i, of each side of the pyramid
  HWY_ALIGN float near[64];    // to the least t of child i
  float toCorner[5];           // from there to the child's lower corner; 4: of t
  float deep;                  // from the least to the greatest t of a child
};

HWY_INLINE void fillTable(
  const glm::dvec4& f, double start, const float* x, const float* y, const float* z, float* table)
{
  const DF df;
  const F fx = hn::Set(df, static_cast<float>(f.x));
  const F fy = hn::Set(df, static_cast<float>(f.y));
  const F fz = hn::Set(df, static_cast<float>(f.z));
  const F begin = hn::Set(df, static_cast<float>(start));
  for (std::size_t i = 0; i < 64; i += hn::Lanes(df))
  {
    const F xy = hn::MulAdd(fx, hn::Load(df, x + i), hn::Mul(fy, hn::Load(df, y + i)));
    hn::Store(hn::Add(hn::MulAdd(fz, hn::Load(df, z + i), xy), begin), df, table + i);
  }
}

/// A node that is still to be opened.
struct OpenNode
{
  std::uint32_t node;
  float size;     // edge, octree coordinates
  float x, y, z;  // lower corner, octree coordinates minus 1
  float value[5]; // of the sides and of t at its lower corner, rounding allowed for
};

inline void sortByDepth(std::vector<TileNode>& nodes)
{
  const auto nearer = [](const TileNode& a, const TileNode& b) { return a.tNear < b.tNear; };
  constexpr std::size_t Few = 48;
  if (nodes.size() > Few)
  {
    std::sort(nodes.begin(), nodes.end(), nearer);
    return;
  }
  for (std::size_t i = 1; i < nodes.size(); ++i)
  {
    const TileNode node = nodes[i];
    std::size_t k = i;
    for (; k > 0 && nearer(node, nodes[k - 1]); --k)
    {
      nodes[k] = nodes[k - 1];
    }
    nodes[k] = node;
  }
}

bool findNodes(const Octree& octree, const CellOffsets& offsets, const TilePyramid& pyramid,
  float tMin, float tMax, std::size_t most, std::vector<TileNode>& nodes)
{
  const DF df;
  ChildTables tables;
  OpenNode open[64 * MaximumDepths];
  int count = 1;
  open[0].node = 0;
  open[0].size = 1.0f;
  open[0].x = open[0].y = open[0].z = 0.0f;
  double tSlack = 0.0;
  for (int k = 0; k < 5; ++k)
  {
    const glm::dvec4& f = k < 4 ? pyramid.side[k] : pyramid.t;
    const double corner = f.x + f.y + f.z + f.w; // octree coordinates begin at 1
    const double slack =
      RoundingSlack * (std::abs(f.x) + std::abs(f.y) + std::abs(f.z) + std::abs(corner));
    if (k < 4)
    {
      const double most = 0.25 * (std::max(f.x, 0.0) + std::max(f.y, 0.0) + std::max(f.z, 0.0));
      fillTable(f, most, offsets.x, offsets.y, offsets.z, tables.most[k]);
      tables.toCorner[k] = static_cast<float>(-most);
      open[0].value[k] = static_cast<float>(corner + slack);
    }
    else
    {
      const double least = 0.25 * (std::min(f.x, 0.0) + std::min(f.y, 0.0) + std::min(f.z, 0.0));
      const double most = 0.25 * (std::max(f.x, 0.0) + std::max(f.y, 0.0) + std::max(f.z, 0.0));
      fillTable(f, least, offsets.x, offsets.y, offsets.z, tables.near);
      tables.toCorner[4] = static_cast<float>(-least);
      tables.deep = static_cast<float>(most - least);
      open[0].value[4] = static_cast<float>(corner - slack);
      tSlack = slack;
    }
  }
  const float tFrom = static_cast<float>(tMin - 2.0 * tSlack);
  const Node* all = octree.nodes();
  const ShortLists& lists = octree.shortLists();
  const std::uint32_t bricks = octree.brickBegin();
  nodes.clear();
  if (bricks == 0 || lists.begin[0] != ShortLists::None)
  {
    nodes.push_back({ -std::numeric_limits<float>::infinity(), 0, 0.0f, 0.0f, 0.0f, 1.0f });
    return true;
  }
  HWY_ALIGN float tNear[64];
  while (count > 0)
  {
    const OpenNode parent = open[--count];
    const Node& node = all[parent.node];
    const F size = hn::Set(df, parent.size);
    const F deep = hn::Set(df, parent.size * tables.deep);
    std::uint64_t inside = 0;
    for (std::size_t i = 0; i < 64; i += hn::Lanes(df))
    {
      const F near = hn::MulAdd(size, hn::Load(df, tables.near + i), hn::Set(df, parent.value[4]));
      hn::Store(near, df, tNear + i);
      auto in =
        hn::And(hn::Le(near, hn::Set(df, tMax)), hn::Ge(hn::Add(near, deep), hn::Set(df, tFrom)));
      for (int k = 0; k < 4; ++k)
      {
        const F best =
          hn::MulAdd(size, hn::Load(df, tables.most[k] + i), hn::Set(df, parent.value[k]));
        in = hn::And(in, hn::Ge(best, hn::Zero(df)));
      }
      inside |= laneBits(df, in) << i;
    }
    if (nodes.size() > most)
    {
      return false;
    }
    for (std::uint64_t left = inside & node.mask; left != 0; left &= left - 1)
    {
      const int i = __builtin_ctzll(left);
      const std::uint32_t child =
        node.first + __builtin_popcountll(node.mask & ((std::uint64_t(1) << i) - 1));
      const float x = parent.x + parent.size * offsets.x[i];
      const float y = parent.y + parent.size * offsets.y[i];
      const float z = parent.z + parent.size * offsets.z[i];
      if (child >= bricks || lists.begin[child] != ShortLists::None)
      {
        nodes.push_back({ tNear[i], child, x, y, z, 0.25f * parent.size });
        continue;
      }
      OpenNode& next = open[count++];
      next.node = child;
      next.size = 0.25f * parent.size;
      next.x = x;
      next.y = y;
      next.z = z;
      for (int k = 0; k < 4; ++k)
      {
        next.value[k] = parent.value[k] + parent.size * (tables.most[k][i] + tables.toCorner[k]);
      }
      next.value[4] = parent.value[4] + parent.size * (tables.near[i] + tables.toCorner[4]);
    }
  }
  sortByDepth(nodes);
  return nodes.size() <= most;
}

/// The four sides of the pyramid, lane by lane, as functions of octree coordinates minus 1.
struct Sides
{
  HWY_ALIGN float x[4], y[4], z[4], w[4];
};

HWY_INLINE Sides makeSides(const TilePyramid& pyramid)
{
  Sides sides;
  for (int k = 0; k < 4; ++k)
  {
    const glm::dvec4& f = pyramid.side[k];
    const double corner = f.x + f.y + f.z + f.w;
    const double slack =
      RoundingSlack * (std::abs(f.x) + std::abs(f.y) + std::abs(f.z) + std::abs(corner));
    sides.x[k] = static_cast<float>(f.x);
    sides.y[k] = static_cast<float>(f.y);
    sides.z[k] = static_cast<float>(f.z);
    sides.w[k] = static_cast<float>(corner + slack);
  }
  return sides;
}

/// Which of `count` cubes are inside: one bit each. The arrays have room for a vector more.
void cubesInside(const TilePyramid& pyramid, const float* x, const float* y, const float* z,
  const float* size, std::size_t count, std::uint64_t* inside)
{
  const DF df;
  const Sides sides = makeSides(pyramid);
  for (std::size_t first = 0; first < count; first += 64)
  {
    std::uint64_t bits = 0;
    for (std::size_t i = first; i < std::min(first + 64, count); i += hn::Lanes(df))
    {
      const F vx = hn::LoadU(df, x + i);
      const F vy = hn::LoadU(df, y + i);
      const F vz = hn::LoadU(df, z + i);
      const F edge = hn::LoadU(df, size + i);
      auto in = hn::Eq(edge, edge);
      for (int k = 0; k < 4; ++k)
      {
        const float grows =
          std::max(sides.x[k], 0.0f) + std::max(sides.y[k], 0.0f) + std::max(sides.z[k], 0.0f);
        const F best = hn::MulAdd(hn::Set(df, sides.x[k]), vx,
          hn::MulAdd(hn::Set(df, sides.y[k]), vy,
            hn::MulAdd(hn::Set(df, sides.z[k]), vz,
              hn::MulAdd(hn::Set(df, grows), edge, hn::Set(df, sides.w[k])))));
        in = hn::And(in, hn::Ge(best, hn::Zero(df)));
      }
      bits |= laneBits(df, in) << (i - first);
    }
    inside[first / 64] = bits;
  }
}

/// a b - c d as differenceOfProducts() of svoTriangle.h computes it.
HWY_INLINE F exactDifference(F a, F b, F c, F d)
{
  const DF df;
  const F ab = hn::Mul(a, b);
  const F cd = hn::Mul(c, d);
  const F difference = hn::Sub(ab, cd);
  const auto equal = hn::Eq(ab, cd);
  if (HWY_LIKELY(hn::AllFalse(df, equal)))
  {
    return difference;
  }
#if HWY_NATIVE_FMA
  const F exact = hn::Sub(hn::MulSub(a, b, ab), hn::MulSub(c, d, cd));
  return hn::IfThenElse(equal, exact, difference);
#else
  HWY_ALIGN float v[5][hn::MaxLanes(df)];
  hn::Store(a, df, v[0]);
  hn::Store(b, df, v[1]);
  hn::Store(c, df, v[2]);
  hn::Store(d, df, v[3]);
  for (std::size_t i = 0; i < hn::Lanes(df); ++i)
  {
    v[4][i] = differenceOfProducts(v[0][i], v[1][i], v[2][i], v[3][i]);
  }
  return hn::Load(df, v[4]);
#endif
}

/// The rays of a tile whose direction is longest along one axis, sheared as ShearedRay of
/// svoTriangle.h does.
struct ShearedRays
{
  int x, y, z;
  HWY_ALIGN float origin[3][64]; // along x, y, z
  HWY_ALIGN float shear[3][64];
  HWY_ALIGN float tMin[64];
  HWY_ALIGN float tEnd[64]; // where a hit must lie before, or at
  HWY_ALIGN float t[64];    // of the hit
  HWY_ALIGN std::int32_t id[64];
  float farthest; // of tEnd
};
constexpr std::int32_t NoId = 0x7fffffff;

/// Tests a triangle against all rays. True if any is hit.
HWY_INLINE bool meetTriangle(
  ShearedRays& rays, const float* p, const float* q, const float* r, std::int32_t id)
{
  const DF df;
  const DI di;
  const F zero = hn::Zero(df);
  const F px = hn::Set(df, p[rays.x]), py = hn::Set(df, p[rays.y]), pz = hn::Set(df, p[rays.z]);
  const F qx = hn::Set(df, q[rays.x]), qy = hn::Set(df, q[rays.y]), qz = hn::Set(df, q[rays.z]);
  const F rx = hn::Set(df, r[rays.x]), ry = hn::Set(df, r[rays.y]), rz = hn::Set(df, r[rays.z]);
  bool any = false;
  for (std::size_t i = 0; i < 64; i += hn::Lanes(df))
  {
    const F ox = hn::Load(df, rays.origin[0] + i);
    const F oy = hn::Load(df, rays.origin[1] + i);
    const F oz = hn::Load(df, rays.origin[2] + i);
    const F sx = hn::Load(df, rays.shear[0] + i);
    const F sy = hn::Load(df, rays.shear[1] + i);
    const F az = hn::Sub(pz, oz);
    const F bz = hn::Sub(qz, oz);
    const F cz = hn::Sub(rz, oz);
    const F ax = hn::Sub(hn::Sub(px, ox), hn::Mul(sx, az));
    const F ay = hn::Sub(hn::Sub(py, oy), hn::Mul(sy, az));
    const F bx = hn::Sub(hn::Sub(qx, ox), hn::Mul(sx, bz));
    const F by = hn::Sub(hn::Sub(qy, oy), hn::Mul(sy, bz));
    const F cx = hn::Sub(hn::Sub(rx, ox), hn::Mul(sx, cz));
    const F cy = hn::Sub(hn::Sub(ry, oy), hn::Mul(sy, cz));
    const F u = exactDifference(cx, by, cy, bx);
    const F v = exactDifference(ax, cy, ay, cx);
    const F w = exactDifference(bx, ay, by, ax);
    const F least = hn::Min(hn::Min(u, v), w);
    const F most = hn::Max(hn::Max(u, v), w);
    const auto within = hn::Or(hn::Ge(least, zero), hn::Le(most, zero));
    if (hn::AllFalse(df, within))
    {
      continue;
    }
    const F determinant = hn::Add(hn::Add(u, v), w);
    const F sum = hn::Add(hn::Add(hn::Mul(u, az), hn::Mul(v, bz)), hn::Mul(w, cz));
    const F t = hn::Div(hn::Mul(sum, hn::Load(df, rays.shear[2] + i)), determinant);
    const F tEnd = hn::Load(df, rays.tEnd + i);
    const F best = hn::Load(df, rays.t + i);
    const I bestId = hn::Load(di, rays.id + i);
    const auto in = hn::And(hn::And(within, hn::Ne(determinant, zero)),
      hn::And(hn::Ge(t, hn::Load(df, rays.tMin + i)), hn::Le(t, tEnd)));
    const auto nearer =
      hn::Or(hn::Lt(t, best), hn::RebindMask(df, hn::Lt(hn::Set(di, id), bestId)));
    const auto hit = hn::And(in, nearer);
    if (hn::AllFalse(df, hit))
    {
      continue;
    }
    any = true;
    hn::Store(hn::IfThenElse(hit, t, tEnd), df, rays.tEnd + i);
    hn::Store(hn::IfThenElse(hit, t, best), df, rays.t + i);
    hn::Store(hn::IfThenElse(hn::RebindMask(di, hit), hn::Set(di, id), bestId), di, rays.id + i);
  }
  return any;
}

HWY_INLINE bool outside(const Sides& sides, const float* p, const float* q, const float* r)
{
  const DFour d;
  for (std::size_t i = 0; i < 4; i += hn::Lanes(d))
  {
    const auto x = hn::Load(d, sides.x + i);
    const auto y = hn::Load(d, sides.y + i);
    const auto z = hn::Load(d, sides.z + i);
    const auto w = hn::Load(d, sides.w + i);
    const auto at = [&](const float* v)
    {
      return hn::MulAdd(x, hn::Set(d, v[0] - 1.0f),
        hn::MulAdd(y, hn::Set(d, v[1] - 1.0f), hn::MulAdd(z, hn::Set(d, v[2] - 1.0f), w)));
    };
    if (!hn::AllFalse(d, hn::Lt(hn::Max(hn::Max(at(p), at(q)), at(r)), hn::Zero(d))))
    {
      return true;
    }
  }
  return false;
}

float farthestEnd(const ShearedRays& rays)
{
  const DF df;
  F most = hn::Load(df, rays.tEnd);
  for (std::size_t i = hn::Lanes(df); i < 64; i += hn::Lanes(df))
  {
    most = hn::Max(most, hn::Load(df, rays.tEnd + i));
  }
  return hn::GetLane(hn::MaxOfLanes(df, most));
}

/// Shears the rays that are longest along axis `z`, negative or not; the others end before they
/// begin. `kind`: 2 z + (1 if negative), of each ray.
void shear(const RayBlock& block, const float* const direction[3], const std::int32_t* kinds,
  int kind, ShearedRays& rays)
{
  const DF df;
  const DI di;
  const float* const origin[3] = { block.originX, block.originY, block.originZ };
  rays.z = kind / 2;
  rays.x = (rays.z + 1) % 3;
  rays.y = (rays.x + 1) % 3;
  if (kind % 2 != 0)
  {
    std::swap(rays.x, rays.y);
  }
  const F infinity = hn::Set(df, std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < 64; i += hn::Lanes(df))
  {
    const auto mine = hn::RebindMask(df, hn::Eq(hn::Load(di, kinds + i), hn::Set(di, kind)));
    const F z = hn::IfThenElse(mine, hn::Load(df, direction[rays.z] + i), hn::Set(df, 1.0f));
    hn::Store(hn::Load(df, origin[rays.x] + i), df, rays.origin[0] + i);
    hn::Store(hn::Load(df, origin[rays.y] + i), df, rays.origin[1] + i);
    hn::Store(hn::Load(df, origin[rays.z] + i), df, rays.origin[2] + i);
    hn::Store(hn::Div(hn::Load(df, direction[rays.x] + i), z), df, rays.shear[0] + i);
    hn::Store(hn::Div(hn::Load(df, direction[rays.y] + i), z), df, rays.shear[1] + i);
    hn::Store(hn::Div(hn::Set(df, 1.0f), z), df, rays.shear[2] + i);
    hn::Store(hn::Load(df, block.tMin + i), df, rays.tMin + i);
    hn::Store(
      hn::IfThenElse(mine, hn::Load(df, block.tMax + i), hn::Neg(infinity)), df, rays.tEnd + i);
    hn::Store(infinity, df, rays.t + i);
    hn::Store(hn::Set(di, NoId), di, rays.id + i);
  }
  rays.farthest = farthestEnd(rays);
}

/// The axis and sign of each ray's direction, -1 where there is none; and which there are. Clears
/// what is negligible of the direction, as clip() of svoTraverse.h does.
unsigned sortRays(const RayBlock& block, float* const direction[3], std::int32_t* kinds)
{
  const DF df;
  const DI di;
  const F zero = hn::Zero(df);
  const F smallest = hn::Set(df, std::numeric_limits<float>::min());
  const F infinity = hn::Set(df, std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < 64; i += hn::Lanes(df))
  {
    F x = hn::Load(df, block.directionX + i);
    F y = hn::Load(df, block.directionY + i);
    F z = hn::Load(df, block.directionZ + i);
    const F largest = hn::Max(hn::Max(hn::Abs(x), hn::Abs(y)), hn::Abs(z));
    const F negligible = hn::Max(
      hn::Mul(largest, hn::Set(df, std::numeric_limits<float>::epsilon() / 256.0f)), smallest);
    const auto finite = [&](F v) { return hn::Lt(hn::Abs(v), infinity); };
    auto alive =
      hn::And(hn::Ge(largest, smallest), hn::And(hn::And(finite(x), finite(y)), finite(z)));
    alive = hn::And(alive,
      hn::And(finite(hn::Load(df, block.originX + i)),
        hn::And(finite(hn::Load(df, block.originY + i)), finite(hn::Load(df, block.originZ + i)))));
    const auto clear = [&](F v) { return hn::IfThenElse(hn::Lt(hn::Abs(v), negligible), zero, v); };
    x = clear(x);
    y = clear(y);
    z = clear(z);
    hn::Store(x, df, direction[0] + i);
    hn::Store(y, df, direction[1] + i);
    hn::Store(z, df, direction[2] + i);
    const F ax = hn::Abs(x), ay = hn::Abs(y), az = hn::Abs(z);
    const auto xOverY = hn::Gt(ax, ay);
    const auto isX = hn::And(xOverY, hn::Gt(ax, az));
    const auto isY = hn::AndNot(xOverY, hn::Gt(ay, az));
    const F longest = hn::IfThenElse(isX, x, hn::IfThenElse(isY, y, z));
    const I axis = hn::IfThenElse(hn::RebindMask(di, isX), hn::Zero(di),
      hn::IfThenElse(hn::RebindMask(di, isY), hn::Set(di, 2), hn::Set(di, 4)));
    const I negative =
      hn::IfThenElseZero(hn::RebindMask(di, hn::Lt(longest, zero)), hn::Set(di, 1));
    hn::Store(hn::IfThenElse(hn::RebindMask(di, alive), hn::Or(axis, negative), hn::Set(di, -1)),
      di, kinds + i);
  }
  unsigned present = 0;
  for (int i = 0; i < 64; ++i)
  {
    present |= kinds[i] >= 0 ? 1u << kinds[i] : 0u;
  }
  return present;
}

void traceKind(
  const Octree& octree, const Sides& sides, const std::vector<TileNode>& nodes, ShearedRays& rays)
{
  constexpr std::uint32_t Mailboxes = 64;
  std::uint32_t mailbox[Mailboxes]; // triangles that were tested
  std::memset(mailbox, 0xff, sizeof(mailbox));
  const Surface& surface = *octree.surface();
  const ShortLists& lists = octree.shortLists();
  const std::uint32_t bricks = octree.brickBegin();
  for (const TileNode& candidate : nodes)
  {
    if (candidate.tNear > rays.farthest)
    {
      break;
    }
    std::uint32_t count, inlineId;
    const std::uint32_t* list;
    if (candidate.node < bricks)
    {
      list = lists.words.data() + lists.begin[candidate.node];
      count = *list++;
    }
    else
    {
      list = octree.brickTriangles(candidate.node, count, inlineId);
    }
    bool any = false;
    for (std::uint32_t k = 0; k < count; ++k)
    {
      const std::uint32_t id = list[k];
      std::uint32_t& tested = mailbox[id % Mailboxes];
      if (tested == id)
      {
        continue;
      }
      tested = id;
      const glm::uvec3 triangle = surface.triangles[id];
      const float* p = &surface.points[triangle.x].x;
      const float* q = &surface.points[triangle.y].x;
      const float* r = &surface.points[triangle.z].x;
      if (!outside(sides, p, q, r))
      {
        any = meetTriangle(rays, p, q, r, static_cast<std::int32_t>(id)) || any;
      }
    }
    if (any)
    {
      rays.farthest = farthestEnd(rays);
    }
  }
}

void traceTile(const Octree& octree, const TilePyramid& pyramid, const std::vector<TileNode>& nodes,
  const RayBlock& block, HitBlock& hits)
{
  const Sides sides = makeSides(pyramid);
  HWY_ALIGN float direction[3][64];
  HWY_ALIGN std::int32_t kinds[64];
  float* const directions[3] = { direction[0], direction[1], direction[2] };
  const unsigned present = sortRays(block, directions, kinds);
  std::fill_n(hits.primitive, 64, NoPrimitive);
  ShearedRays rays;
  for (int kind = 0; kind < 6; ++kind)
  {
    if (!(present >> kind & 1))
    {
      continue;
    }
    shear(block, directions, kinds, kind, rays);
    traceKind(octree, sides, nodes, rays);
    for (int i = 0; i < 64; ++i)
    {
      if (rays.id[i] != NoId)
      {
        hits.t[i] = rays.t[i];
        hits.primitive[i] = static_cast<Primitive>(rays.id[i]);
      }
    }
  }
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(findNodes);
HWY_EXPORT(cubesInside);
HWY_EXPORT(traceTile);

bool findTileNodes(const Octree& octree, const TilePyramid& pyramid, float tMin, float tMax,
  std::size_t most, std::vector<TileNode>& nodes)
{
  static const CellOffsets offsets;
  nodes.clear();
  return !octree || octree.empty() ||
    HWY_DYNAMIC_DISPATCH(findNodes)(octree, offsets, pyramid, tMin, tMax, most, nodes);
}

bool TileGroup::find(
  const Octree& octree, const TilePyramid& pyramid, float tMin, float tMax, std::size_t most)
{
  if (!findTileNodes(octree, pyramid, tMin, tMax, most, this->Nodes))
  {
    return false;
  }
  constexpr std::size_t Vector = 16;
  for (std::vector<float>* array : { &this->X, &this->Y, &this->Z, &this->Size })
  {
    array->assign(this->Nodes.size() + Vector, 0.0f);
  }
  for (std::size_t i = 0; i < this->Nodes.size(); ++i)
  {
    this->X[i] = this->Nodes[i].x;
    this->Y[i] = this->Nodes[i].y;
    this->Z[i] = this->Nodes[i].z;
    this->Size[i] = this->Nodes[i].size;
  }
  return true;
}

void TileGroup::select(const TilePyramid& pyramid, std::vector<TileNode>& nodes) const
{
  nodes.clear();
  constexpr std::size_t Chunk = 512;
  std::uint64_t inside[Chunk / 64];
  for (std::size_t first = 0; first < this->Nodes.size(); first += Chunk)
  {
    const std::size_t count = std::min(Chunk, this->Nodes.size() - first);
    HWY_DYNAMIC_DISPATCH(cubesInside)
    (pyramid, this->X.data() + first, this->Y.data() + first, this->Z.data() + first,
      this->Size.data() + first, count, inside);
    for (std::size_t k = 0; k < count; k += 64)
    {
      std::uint64_t bits = inside[k / 64];
      if (count - k < 64)
      {
        bits &= (std::uint64_t(1) << (count - k)) - 1;
      }
      for (; bits != 0; bits &= bits - 1)
      {
        nodes.push_back(this->Nodes[first + k + __builtin_ctzll(bits)]);
      }
    }
  }
}

void intersectTile(const Octree& octree, const TilePyramid& pyramid,
  const std::vector<TileNode>& nodes, const RayBlock& rays, HitBlock& hits)
{
  HWY_DYNAMIC_DISPATCH(traceTile)(octree, pyramid, nodes, rays, hits);
}
}
#endif
