#include "svoIntersectScalar.h"

#include "svoLeafGeometry.h"
#include "svoTraverse.h"

namespace svo
{
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
    ClippedRay<float> ray;
    if (clip(octree, rays.origin(i), rays.direction(i), rays.tMin[i], rays.tMax[i], ray))
    {
      const LeafHit<float> hit = intersectLeaves(query, ray, false);
      hits.t[i] = hit.t;
      hits.primitive[i] = hit.primitive;
    }
  }
}
}
