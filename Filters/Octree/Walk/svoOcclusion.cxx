// Rays of which only is asked whether they meet anything, on the best instruction set that the
// machine has.
#define HWY_WANT_AVX3_DL 1 // as svoIntersectBlock.cxx
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoOcclusion.cxx"
#include <hwy/foreach_target.h>

#include "svoIntersect.h"
#include "svoIntersectBlock.h"
#include "svoLeafGeometry.h"
#include "svoOcclusion.h"
#include "svoPacketOcclusion-inl.h"
#include "svoTraverse.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// Where leaves are triangles that are met exactly.
void traceOcclusion(const LeafQuery& query, const WalkTarget& target, const OcclusionRays& rays,
  OcclusionAnswers& answers)
{
#if SVO_PACKET_LEAVES
  OcclusionTrace trace(query, target, rays, answers);
  target.groups ? trace.run<true>() : trace.run<false>();
#else
  static_cast<void>(target);
  for (int i = 0; i < rays.count; ++i)
  {
    ClippedRay<float> ray;
    if (clip(query.octree, rays.origin(i), rays.direction(i), 0.0f, rays.tMax[i], ray))
    {
      answers.by[i] = intersectLeaves(query, ray, true).primitive;
      answers.met[i / 64] |= std::uint64_t(answers.by[i] != NoPrimitive) << i % 64;
    }
  }
#endif
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(traceOcclusion);

RayBlock blockOf(const OcclusionRays& rays, int first)
{
  RayBlock block;
  const int n = std::min(rays.count - first, static_cast<int>(RayBlock::Size));
  const auto copy = [&](const float* from, float* to, float none)
  { std::fill(std::copy_n(from + first, n, to), to + RayBlock::Size, none); };
  copy(rays.originX, block.originX, 1.0f);
  copy(rays.originY, block.originY, 1.0f);
  copy(rays.originZ, block.originZ, 1.0f);
  copy(rays.directionX, block.directionX, 1.0f);
  copy(rays.directionY, block.directionY, 1.0f);
  copy(rays.directionZ, block.directionZ, 1.0f);
  copy(rays.tMax, block.tMax, -1.0f);
  std::fill_n(block.tMin, RayBlock::Size, 0.0f);
  return block;
}

void occluded(const Octree& octree, const OcclusionRays& rays, const TraceOptions& options,
  std::uint64_t* met, Primitive* by)
{
  assert(rays.count >= 0 && rays.count <= OcclusionRays::Most);
  const int words = (rays.count + 63) / 64;
  OcclusionAnswers answers;
  if (octree && !octree.empty())
  {
    const LeafQuery query(octree, options);
    const WalkTarget target = query.bits > 0 ? walkTarget(query) : WalkTarget();
    if (query.leaf.exact() && target.points != nullptr)
    {
      HWY_DYNAMIC_DISPATCH(traceOcclusion)(query, target, rays, answers);
    }
    else
    {
      std::fill_n(answers.unknown, words, ~std::uint64_t(0));
    }
  }
  // Whatever else there is goes through the block queries.
  for (int word = 0; word < words; ++word)
  {
    if (const std::uint64_t unknown = answers.unknown[word])
    {
      RayBlock block = blockOf(rays, 64 * word);
      HitBlock hits;
      for (int i = 0; i < RayBlock::Size; ++i)
      {
        block.tMax[i] = unknown >> i & 1 ? block.tMax[i] : -1.0f;
      }
      intersect(octree, block, options, hits);
      for (int i = 0; i < RayBlock::Size; ++i)
      {
        if (hits.primitive[i] != NoPrimitive)
        {
          answers.met[word] |= std::uint64_t(1) << i;
          answers.by[64 * word + i] = hits.primitive[i];
        }
      }
    }
  }
  std::copy_n(answers.met, words, met);
  if (by)
  {
    std::copy_n(answers.by, rays.count, by);
  }
}
}
#endif
