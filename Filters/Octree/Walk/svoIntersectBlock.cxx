// Queries of blocks of 64 rays, on the best instruction set that the machine has.

// With it come vector population counts: 7 % more rays.
#define HWY_WANT_AVX3_DL 1
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoIntersectBlock.cxx"
#include <hwy/foreach_target.h>

#include "svoIntersect.h"
#include "svoIntersectBlock.h"
#include "svoLeafGeometry.h"
#include "svoPacketCells-inl.h"
#include "svoPacketCubes-inl.h"
#include "svoPacketLeaf-inl.h"
#include "svoPacketPlanes-inl.h"
#include "svoPacketWalk-inl.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
#if HWY_TARGET == HWY_SCALAR
// One ray at a time needs no second walk.
void traceBlock(const LeafQuery& query, const WalkTarget&, const RayBlock& rays, HitBlock& hits)
{
  intersectBlockScalar(query.octree, rays, query.options, hits);
}

#else
/// What the leaf geometry says of the lanes of one packet that have arrived.
struct Verdict
{
  Lanes again; // these walk on,
  Lanes skip;  // and of these, these past the whole brick
};

/// Shows the cells where the lanes of `arrived` are to the leaf geometry, one by one.
/// `primitives`: their representative triangles, or null if they have none yet.
HWY_INLINE Verdict meetOneByOne(const LeafQuery& query, const WalkTarget& target,
  const RayBlock& rays, int first, Lanes arrived, I leave, const Primitive* primitives, Packet& p,
  BlockHits& hits)
{
  const DF df;
  const DI di;
  constexpr int Most = RayBlock::Size;
  HWY_ALIGN float direction[3][Most];
  HWY_ALIGN float tMin[Most];
  HWY_ALIGN float t[Most];
  HWY_ALIGN float tMax[Most];
  HWY_ALIGN float tClip[Most];
  HWY_ALIGN float tExit[Most];
  HWY_ALIGN std::int32_t position[3][Most];
  HWY_ALIGN std::int32_t node[Most];
  hn::Store(p.dx, df, direction[0]);
  hn::Store(p.dy, df, direction[1]);
  hn::Store(p.dz, df, direction[2]);
  hn::Store(p.tMin, df, tMin);
  hn::Store(p.t, df, t);
  hn::Store(p.tMax, df, tMax);
  hn::Store(p.tClip, df, tClip);
  hn::Store(exitOf(p, leave), df, tExit);
  hn::Store(p.atX(), di, position[0]);
  hn::Store(p.atY(), di, position[1]);
  hn::Store(p.atZ(), di, position[2]);
  hn::Store(p.node, di, node);
  std::uint64_t again = 0, skip = 0;
  for (std::uint64_t left = bitsOf(di, arrived); left != 0; left &= left - 1)
  {
    const int i = lowestBit(left);
    const int ray = first + i;
    ClippedRay<float> clipped;
    clipped.origin = rays.origin(ray);
    clipped.direction = { direction[0][i], direction[1][i], direction[2][i] };
    clipped.tMin = tMin[i];
    clipped.tStart = rays.tMin[ray];
    clipped.tMax = tClip[i];
    const glm::ivec3 at(position[0][i], position[1][i], position[2][i]);
    StopCell<float> cell = stopCell(query, target, at, node[i]);
    cell.tEnter = t[i];
    cell.tExit = tExit[i];
    LeafHit<float> hit = hits.load(ray);
    const Visit visit = primitives
      ? meetShape(query, clipped, cell, primitives[i], tMax[i], hit)
      : meetCell(
          query, clipped, ShearedRay<float>(clipped.origin, clipped.direction), cell, tMax[i], hit);
    hits.store(ray, hit);
    again |= std::uint64_t(visit != Visit::Stop) << i;
    skip |= std::uint64_t(visit == Visit::SkipBrick) << i;
  }
  p.tMax = hn::Load(df, tMax);
  return { maskOf(di, again), maskOf(di, skip) };
}

/// Shows the cells where lanes have arrived to the leaf geometry.
HWY_INLINE Verdict meet(const LeafQuery& query, const WalkTarget& target, const RayBlock& rays,
  int first, I leave, Packet& p, BlockHits& hits)
{
  const Lanes arrived = hn::Not(p.dead);
  if (target.ownPlanes)
  {
    const Lanes again = meetOwnPlanes(query, target, rays, first, arrived, leave, p, hits);
    return { again, hn::Ne(p.size, p.size) };
  }
#if SVO_PACKET_LEAVES
  if (target.points != nullptr)
  {
    const DF df;
    const DI di;
    const DU du;
    const Lanes none = hn::Ne(p.size, p.size);
    const Lists lists = findLists(target, p.node, arrived);
    Lanes triangles = none;
    if (query.leaf.exact())
    {
      const I longest = hn::Set(di, static_cast<int>(query.leaf.longestExact));
      triangles = hn::AndNot(hn::Gt(lists.count, longest), arrived);
    }
    const Lanes others = hn::AndNot(triangles, arrived);
    F hitT = hn::Load(df, hits.out.t + first);
    I hitId = hn::BitCast(di, hn::Load(du, hits.out.primitive + first));
    Verdict verdict{ none, none };
    if (!hn::AllFalse(di, triangles))
    {
      meetLists(target, p, lists, triangles, hitT, hitId);
      verdict = { triangles, triangles };
    }
    HWY_ALIGN Primitive primitives[RayBlock::Size];
    const bool anyOther = !hn::AllFalse(di, others);
    if (anyOther)
    {
      ArrivedCells cells;
      note(p, others, cells);
      representatives(query, target, cells, first, primitives);
    }
    hn::Store(hitT, df, hits.out.t + first);
    hn::Store(hn::BitCast(du, hitId), du, hits.out.primitive + first);
    if (anyOther)
    {
      const Verdict planes =
        meetOneByOne(query, target, rays, first, others, leave, primitives, p, hits);
      verdict.again = hn::Or(verdict.again, planes.again);
    }
    return verdict;
  }
#endif
  return meetOneByOne(query, target, rays, first, arrived, leave, nullptr, p, hits);
}

/// Walks until every lane has arrived or died.
template <bool Groups>
HWY_INLINE void walkBoth(const WalkTarget& walkTarget, Packet& first, Packet& second)
{
  // Copies, so that nothing the loop reads can change behind its back: they stay in registers.
  const WalkTarget target = walkTarget;
  Packet a = first;
  Packet b = second;
  countTurn(hn::Not(a.dead), hn::Not(b.dead));
  // Each packet's turn is one long chain of dependent operations: two fill each other's gaps.
  for (;;)
  {
    const Lanes underWayA = turn<Groups>(target, a);
    const Lanes underWayB = turn<Groups>(target, b);
    if (hn::AllFalse(DI(), hn::Or(underWayA, underWayB)))
    {
      break;
    }
    countTurn(underWayA, underWayB);
  }
  first = a;
  second = b;
}

template <bool Groups>
HWY_INLINE void traceTwo(const LeafQuery& query, const WalkTarget& target, const RayBlock& rays,
  int first, BlockHits& hits)
{
  const DF df;
  const DI di;
  const int n = static_cast<int>(hn::Lanes(df));
  Packet a = makePacket(target, rays, first);
  Packet b = makePacket(target, rays, first + n);
  const I leave = hn::Set(di, target.stopSize + (Groups ? 1 : 0));
  const I skip = hn::Max(leave, hn::Set(di, target.brickSize));
  for (;;)
  {
    walkBoth<Groups>(target, a, b);
    const auto resume = [&](Packet& p, int firstRay)
    {
      const Verdict verdict = meet(query, target, rays, firstRay, leave, p, hits);
      p.dead = hn::Not(verdict.again);
      const Lanes lost = advance(p, p.dead, hn::IfThenElse(verdict.skip, skip, leave));
      find(target, p, lost);
      return hn::AllTrue(di, p.dead);
    };
    const bool doneA = resume(a, first);
    const bool doneB = resume(b, first + n);
    if (doneA && doneB)
    {
      return;
    }
  }
}

void traceBlock(
  const LeafQuery& query, const WalkTarget& target, const RayBlock& rays, HitBlock& hits)
{
  BlockHits found(hits);
#if SVO_PACKET_LEAVES
  if (onlyCubes(query, target))
  {
    target.groups ? traceCubes<true>(query, target, rays, hits)
                  : traceCubes<false>(query, target, rays, hits);
    return;
  }
#endif
  const int n = static_cast<int>(hn::Lanes(DF()));
  assert(RayBlock::Size % (2 * n) == 0);
  for (int i = 0; i < RayBlock::Size; i += 2 * n)
  {
    const auto ends = [&](int first)
    { return hn::Le(hn::Load(DF(), rays.tMin + first), hn::Load(DF(), rays.tMax + first)); };
    if (hn::AllFalse(DF(), hn::Or(ends(i), ends(i + n))))
    {
      continue;
    }
    target.groups ? traceTwo<true>(query, target, rays, i, found)
                  : traceTwo<false>(query, target, rays, i, found);
  }
  found.finish();
}
#endif

Chosen chosen()
{
  return { hwy::TargetName(HWY_TARGET),
    static_cast<int>(hwy::HWY_NAMESPACE::Lanes(hwy::HWY_NAMESPACE::ScalableTag<float>())) };
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(traceBlock);
HWY_EXPORT(chosen);

WalkTarget walkTarget(const LeafQuery& query)
{
  const Octree& octree = query.octree;
  // A node at depth d has cells with NodeLevels (d + 1) bits, in groups with fewer.
  const int stopDepth = (query.bits - 1) / NodeLevels;
  assert(query.bits > 0 && stopDepth < octree.depthCount());
  const UpperLevels& upper = octree.upperLevels();
  const int table = std::min(upper.tableCount - 1, stopDepth);
  WalkTarget target;
  target.words = reinterpret_cast<const std::uint32_t*>(octree.nodes());
  target.table = upper.tables[table].data();
  target.tableBits = NodeLevels * table;
  target.stopSize = MantissaBits - NodeLevels * (stopDepth + 1);
  target.groups = query.bits % NodeLevels != 0;
  target.brickSize = MantissaBits - NodeLevels * (octree.depthCount() - 1);
  target.cellSize = MantissaBits - query.bits;
  target.touchedHalf = static_cast<float>(touchedHalf(query.bits));
  // The packets' leaves index with 32 bits and a sign.
  const Surface* surface = octree.surface();
  constexpr std::size_t most = std::size_t(1) << 29;
  if (surface && target.stopSize < target.brickSize && surface->points.size() < most &&
    surface->triangles.size() < most && octree.header().nodeCount < most / 4 &&
    octree.header().listWords < most)
  {
    target.points = &surface->points.data()->x;
    target.triangles = reinterpret_cast<const std::int32_t*>(&surface->triangles.data()->x);
    target.listBegin = static_cast<int>(4 * octree.header().nodeCount);
    if (!target.groups && octree.representatives())
    {
      target.kept = &octree.representatives();
    }
  }
  // Words are indexed with 32 bits and a sign.
  const Header& h = octree.header();
  if (query.leaf.shape == CellShape::Plane && (!query.inBrick || query.planes) &&
    4 * h.nodeCount + h.listWords < std::uint64_t(1) << 31)
  {
    target.ownPlanes = true;
    target.listBegin = static_cast<int>(4 * h.nodeCount);
  }
  assert(target.tableBits >= 0 && !upper.tables[table].empty());
  assert(target.cellSize == target.stopSize + target.groups);
  assert(target.stopSize + NodeLevels >= target.brickSize && target.brickSize <= MantissaBits);
  target.high = 1.0f + 1.0f / static_cast<float>(1 << octree.rootBits(0));
  return target;
}

void intersect(
  const Octree& octree, const RayBlock& rays, const TraceOptions& options, HitBlock& hits)
{
  if (!octree || octree.empty())
  {
    std::fill_n(hits.primitive, RayBlock::Size, NoPrimitive);
    return;
  }
  const LeafQuery query(octree, options);
  // Nodes' words, too, are indexed with 32 bits and a sign.
  if (query.bits == 0 || octree.header().nodeCount >= std::uint64_t(1) << 29)
  {
    intersectBlockScalar(octree, rays, options, hits);
    return;
  }
  HWY_DYNAMIC_DISPATCH(traceBlock)(query, walkTarget(query), rays, hits);
}

const char* instructionSet()
{
  return HWY_DYNAMIC_DISPATCH(chosen)().name;
}

int vectorLanes()
{
  return HWY_DYNAMIC_DISPATCH(chosen)().lanes;
}
}
#endif
