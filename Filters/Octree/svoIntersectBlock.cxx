// Queries of blocks of 64 rays, on the best instruction set that the machine has.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoIntersectBlock.cxx"
#include <hwy/foreach_target.h>

#include "svoIntersect.h"
#include "svoIntersectBlock.h"
#include "svoIntersectScalar.h"
#include "svoLeafGeometry.h"
#include "svoPacketWalk-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
#if HWY_TARGET == HWY_SCALAR
// One ray at a time needs no second walk.
void traceBlock(
  const LeafQuery& query, const WalkTarget&, const RayBlock& rays, bool, HitBlock& hits)
{
  TraceOptions options;
  options.level = query.level;
  options.leafGeometry = query.geometry;
  intersectBlockScalar(query.octree, rays, options, hits);
}

#else
/// What the leaf geometry says of the lanes of one packet that have arrived.
struct Verdict
{
  Lanes again; // these walk on,
  Lanes skip;  // and of these, these past the whole brick
};

/// Shows the cells where lanes have arrived to the leaf geometry.
HWY_INLINE Verdict meet(const LeafQuery& query, const WalkTarget& target, const RayBlock& rays,
  bool anyHit, int first, I leave, Packet& p, LeafHit<float>* hits)
{
  const DF df;
  const DI di;
  HWY_ALIGN float direction[3][64];
  HWY_ALIGN float tMin[64];
  HWY_ALIGN float t[64];
  HWY_ALIGN float tMax[64];
  HWY_ALIGN float tClip[64];
  HWY_ALIGN float tExit[64];
  HWY_ALIGN std::int32_t position[3][64];
  HWY_ALIGN std::int32_t node[64];
  HWY_ALIGN std::int32_t alive[64];
  HWY_ALIGN std::int32_t answer[64] = {};
  hn::Store(p.dx, df, direction[0]);
  hn::Store(p.dy, df, direction[1]);
  hn::Store(p.dz, df, direction[2]);
  hn::Store(p.tMin, df, tMin);
  hn::Store(p.t, df, t);
  hn::Store(p.tMax, df, tMax);
  hn::Store(p.tClip, df, tClip);
  hn::Store(exitOf(p, leave), df, tExit);
  hn::Store(p.x, di, position[0]);
  hn::Store(p.y, di, position[1]);
  hn::Store(p.z, di, position[2]);
  hn::Store(p.node, di, node);
  hn::Store(hn::VecFromMask(di, hn::Not(p.dead)), di, alive);
  const int n = static_cast<int>(hn::Lanes(df));
  for (int i = 0; i < n; ++i)
  {
    if (!alive[i])
    {
      continue;
    }
    const int ray = first + i;
    ClippedRay<float> clipped;
    clipped.origin = { rays.originX[ray], rays.originY[ray], rays.originZ[ray] };
    clipped.direction = { direction[0][i], direction[1][i], direction[2][i] };
    clipped.tMin = tMin[i];
    clipped.tMax = tClip[i];
    const glm::ivec3 at(position[0][i], position[1][i], position[2][i]);
    StopCell<float> cell = stopCell(query, target, at, node[i]);
    cell.tEnter = t[i];
    cell.tExit = tExit[i];
    const ShearedRay<float> sheared(clipped.origin, clipped.direction);
    const Visit visit = meetCell(query, clipped, sheared, cell, tMax[i], hits[ray]);
    const bool done = visit == Visit::Stop || (anyHit && hits[ray].primitive != NoPrimitive);
    answer[i] = done ? 0 : visit == Visit::Continue ? 1 : 3;
  }
  p.tMax = hn::Load(df, tMax);
  const I answers = hn::Load(di, answer);
  return { hn::Ne(answers, hn::Zero(di)), hn::Gt(answers, hn::Set(di, 1)) };
}

template <bool Groups>
HWY_INLINE void traceTwo(const LeafQuery& query, const WalkTarget& target, const RayBlock& rays,
  bool anyHit, int first, LeafHit<float>* hits)
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
    // Each packet's turn is one long chain of dependent operations: two fill each other's gaps.
    for (;;)
    {
      const Lanes underWayA = turn<Groups>(target, a);
      const Lanes underWayB = turn<Groups>(target, b);
      if (hn::AllFalse(di, hn::Or(underWayA, underWayB)))
      {
        break;
      }
    }
    const auto resume = [&](Packet& p, int firstRay)
    {
      const Verdict verdict = meet(query, target, rays, anyHit, firstRay, leave, p, hits);
      p.dead = hn::Not(verdict.again);
      const Lanes lost = advance(p, verdict.again, hn::IfThenElse(verdict.skip, skip, leave));
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

void traceBlock(const LeafQuery& query, const WalkTarget& target, const RayBlock& rays, bool anyHit,
  HitBlock& hits)
{
  LeafHit<float> found[RayBlock::Size];
  const int n = static_cast<int>(hn::Lanes(DF()));
  for (int i = 0; i < RayBlock::Size; i += 2 * n)
  {
    if (target.groups)
    {
      traceTwo<true>(query, target, rays, anyHit, i, found);
    }
    else
    {
      traceTwo<false>(query, target, rays, anyHit, i, found);
    }
  }
  for (int i = 0; i < RayBlock::Size; ++i)
  {
    finish(found[i]);
    hits.t[i] = found[i].t;
    hits.primitive[i] = found[i].primitive;
  }
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

namespace
{
WalkTarget walkTarget(const LeafQuery& query)
{
  const Octree& octree = query.octree;
  // A node at depth d has cells with 2 (d + 1) bits, in groups with one bit less.
  const int stopDepth = (query.bits - 1) / 2;
  const UpperLevels& upper = octree.upperLevels();
  const int table = std::min(upper.tableCount - 1, stopDepth);
  WalkTarget target;
  target.nodes = reinterpret_cast<const std::uint64_t*>(octree.nodes());
  target.table = upper.tables[table].data();
  target.tableBits = 2 * table;
  target.stopSize = MantissaBits - 2 * (stopDepth + 1);
  target.groups = query.bits % 2 != 0;
  target.brickSize = MantissaBits - 2 * octree.depthCount() + 2;
  target.high = 1.0f + 1.0f / static_cast<float>(1 << rootBits(octree, 0));
  return target;
}
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
  if (query.bits == 0)
  {
    intersectBlockScalar(octree, rays, options, hits);
    return;
  }
  HWY_DYNAMIC_DISPATCH(traceBlock)(query, walkTarget(query), rays, false, hits);
}

std::uint64_t occluded(const Octree& octree, const RayBlock& rays, const TraceOptions& options)
{
  if (!octree || octree.empty())
  {
    return 0;
  }
  const LeafQuery query(octree, options);
  if (query.bits == 0)
  {
    return occludedBlockScalar(octree, rays, options);
  }
  HitBlock hits;
  HWY_DYNAMIC_DISPATCH(traceBlock)(query, walkTarget(query), rays, true, hits);
  std::uint64_t mask = 0;
  for (int i = 0; i < RayBlock::Size; ++i)
  {
    mask |= std::uint64_t(hits.primitive[i] != NoPrimitive) << i;
  }
  return mask;
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
