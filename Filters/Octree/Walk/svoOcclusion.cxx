#include "svoOcclusion.h"

#include "svoIntersect.h"

#include <algorithm>
#include <cassert>

namespace svo
{
namespace
{
/// 64 rays from `first` on; those that there are not end before they begin.
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
}

void occluded(const Octree& octree, const OcclusionRays& rays, const TraceOptions& options,
  std::uint64_t* met)
{
  assert(rays.count >= 0 && rays.count <= OcclusionRays::Most);
  for (int first = 0; first < rays.count; first += RayBlock::Size)
  {
    HitBlock hits;
    intersect(octree, blockOf(rays, first), options, hits);
    std::uint64_t bits = 0;
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      bits |= std::uint64_t(hits.primitive[i] != NoPrimitive) << i;
    }
    met[first / RayBlock::Size] = bits;
  }
}
}
