#include "svoIntersectScalar.h"

#include "svoLeafGeometry.h"
#include "svoTraverse.h"

namespace svo
{
namespace
{
LeafHit<float> trace(const LeafQuery& query, const RayBlock& rays, int i, bool anyHit)
{
  ClippedRay<float> ray;
  const glm::vec3 origin(rays.originX[i], rays.originY[i], rays.originZ[i]);
  const glm::vec3 direction(rays.directionX[i], rays.directionY[i], rays.directionZ[i]);
  if (!clip(query.octree, origin, direction, rays.tMin[i], rays.tMax[i], ray))
  {
    return {};
  }
  return intersectLeaves(query, ray, anyHit);
}
}

void intersectBlockScalar(
  const Octree& octree, const RayBlock& rays, const TraceOptions& options, HitBlock& hits)
{
  std::fill_n(hits.t, RayBlock::Size, 0.0f);
  std::fill_n(hits.primitive, RayBlock::Size, NoPrimitive);
  if (!octree || octree.empty())
  {
    return;
  }
  const LeafQuery query(octree, options);
  for (int i = 0; i < RayBlock::Size; ++i)
  {
    const LeafHit<float> hit = trace(query, rays, i, false);
    hits.t[i] = hit.t;
    hits.primitive[i] = hit.primitive;
  }
}

std::uint64_t occludedBlockScalar(
  const Octree& octree, const RayBlock& rays, const TraceOptions& options)
{
  std::uint64_t mask = 0;
  if (!octree || octree.empty())
  {
    return mask;
  }
  const LeafQuery query(octree, options);
  for (int i = 0; i < RayBlock::Size; ++i)
  {
    mask |= std::uint64_t(trace(query, rays, i, true).primitive != NoPrimitive) << i;
  }
  return mask;
}
}
