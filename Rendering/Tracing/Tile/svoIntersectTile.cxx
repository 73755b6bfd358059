#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoIntersectTile.cxx"
#include <hwy/foreach_target.h>

#include "svoCounters.h"
#include "svoIntersectTile.h"
#include "svoLaneBits-inl.h"
#include "svoLaneProducts-inl.h"
#include "svoLaneTriples-inl.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
using DFour = hn::CappedTag<float, 4>;

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
constexpr std::int32_t NoId = -1; // less than all

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
    const F u = differenceOfProducts(cx, by, cy, bx);
    const F v = differenceOfProducts(ax, cy, ay, cx);
    const F w = differenceOfProducts(bx, ay, by, ax);
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
      hn::Or(hn::Lt(t, best), hn::RebindMask(df, hn::Gt(hn::Set(di, id), bestId)));
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

HWY_INLINE bool outside(const PyramidSides& sides, const float* p, const float* q, const float* r)
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
  rays.farthest = highestOf(rays.tEnd);
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

void traceKind(const Octree& octree, const PyramidSides& sides, const std::vector<TileNode>& nodes,
  ShearedRays& rays)
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
      assert(lists.begin[candidate.node] != ShortLists::None);
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
      assert(id < surface.triangles.size());
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
      if (outside(sides, p, q, r))
      {
        SVO_COUNT(TileTrianglesOutside, 1);
      }
      else
      {
        SVO_COUNT(TileTriangles, 1);
        any = meetTriangle(rays, p, q, r, static_cast<std::int32_t>(id)) || any;
      }
    }
    if (any)
    {
      rays.farthest = highestOf(rays.tEnd);
    }
  }
}

void traceTile(const Octree& octree, const TilePyramid& pyramid, const std::vector<TileNode>& nodes,
  const RayBlock& block, HitBlock& hits)
{
  assert(octree.surface() != nullptr);
  assert(std::is_sorted(nodes.begin(), nodes.end(),
    [](const TileNode& a, const TileNode& b) { return a.tNear < b.tNear; }));
  const PyramidSides sides(pyramid);
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

/// Sets t of the rays of one kind, where each meets its triangle.
void meetOwn(const Surface& surface, const ShearedRays& rays, const std::int32_t* kinds, int kind,
  HitBlock& hits)
{
  const DF df;
  const DI di;
  const auto* triangles = reinterpret_cast<const std::int32_t*>(&surface.triangles[0].x);
  const float* points = &surface.points[0].x;
  for (std::size_t i = 0; i < 64; i += hn::Lanes(df))
  {
    const I primitive = hn::Load(di, reinterpret_cast<const std::int32_t*>(hits.primitive) + i);
    const auto mine = hn::And(
      hn::Eq(hn::Load(di, kinds + i), hn::Set(di, kind)), hn::Gt(primitive, hn::Set(di, -1)));
    if (hn::AllFalse(di, mine))
    {
      continue;
    }
    const auto corners = loadTriples(di, triangles, hn::IfThenElseZero(mine, primitive));
    F x[3], y[3], z[3]; // sheared; z is not
    for (int corner = 0; corner < 3; ++corner)
    {
      const auto point = loadTriples(df, points,
        corner == 0     ? corners.x
          : corner == 1 ? corners.y
                        : corners.z);
      const F along[3] = { point.x, point.y, point.z };
      z[corner] = hn::Sub(along[rays.z], hn::Load(df, rays.origin[2] + i));
      x[corner] = hn::Sub(hn::Sub(along[rays.x], hn::Load(df, rays.origin[0] + i)),
        hn::Mul(hn::Load(df, rays.shear[0] + i), z[corner]));
      y[corner] = hn::Sub(hn::Sub(along[rays.y], hn::Load(df, rays.origin[1] + i)),
        hn::Mul(hn::Load(df, rays.shear[1] + i), z[corner]));
    }
    const F u = differenceOfProducts(x[2], y[1], y[2], x[1]);
    const F v = differenceOfProducts(x[0], y[2], y[0], x[2]);
    const F w = differenceOfProducts(x[1], y[0], y[1], x[0]);
    const F determinant = hn::Add(hn::Add(u, v), w);
    const F sum = hn::Add(hn::Add(hn::Mul(u, z[0]), hn::Mul(v, z[1])), hn::Mul(w, z[2]));
    const F t = hn::Div(hn::Mul(sum, hn::Load(df, rays.shear[2] + i)), determinant);
    const auto mineF = hn::RebindMask(df, mine);
    hn::Store(hn::IfThenElse(mineF, t, hn::Load(df, hits.t + i)), df, hits.t + i);
  }
}

void meetOwnTriangles(const Octree& octree, const RayBlock& block, HitBlock& hits)
{
  assert(octree.surface() != nullptr);
  HWY_ALIGN float direction[3][64];
  HWY_ALIGN std::int32_t kinds[64];
  float* const directions[3] = { direction[0], direction[1], direction[2] };
  const unsigned present = sortRays(block, directions, kinds);
  ShearedRays rays;
  for (int kind = 0; kind < 6; ++kind)
  {
    if (present >> kind & 1)
    {
      shear(block, directions, kinds, kind, rays);
      meetOwn(*octree.surface(), rays, kinds, kind, hits);
    }
  }
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(traceTile);
HWY_EXPORT(meetOwnTriangles);

void depthsOnTriangles(const Octree& octree, const RayBlock& rays, HitBlock& hits)
{
  HWY_DYNAMIC_DISPATCH(meetOwnTriangles)(octree, rays, hits);
}

void intersectTile(const Octree& octree, const TilePyramid& pyramid,
  const std::vector<TileNode>& nodes, const RayBlock& rays, HitBlock& hits)
{
  HWY_DYNAMIC_DISPATCH(traceTile)(octree, pyramid, nodes, rays, hits);
}
}
#endif
