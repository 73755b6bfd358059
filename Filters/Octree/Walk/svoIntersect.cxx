#include "svoIntersect.h"

#include "svoLeafGeometry.h"
#include "svoLocalRay.h"

namespace svo
{
Hit intersect(const Octree& octree, const Ray& ray, const TraceOptions& options)
{
  Hit hit;
  LocalRay local;
  if (!prepareRay(octree, ray, local))
  {
    return hit;
  }
  const LeafQuery query(octree, options);
  const LeafHit<double> found = intersectLeaves(query, local.ray, false);
  if (found.primitive == NoPrimitive)
  {
    return hit;
  }
  hit.t = (found.t + local.start) / local.scale;
  hit.primitive = found.primitive;
  hit.level = query.level;
  hit.cell = found.cell;
  if (hit.cell.x < 0) // a triangle's: the cell that holds the point
  {
    const glm::dvec3 x = local.ray.origin + found.t * local.ray.direction - 1.0;
    hit.cell = glm::clamp(glm::ivec3(glm::floor(x * static_cast<double>(1 << query.bits))),
      glm::ivec3(0), glm::ivec3((1 << query.level) - 1));
  }
  return hit;
}

bool occluded(const Octree& octree, const Ray& ray, const TraceOptions& options)
{
  LocalRay local;
  return prepareRay(octree, ray, local) &&
    intersectLeaves(LeafQuery(octree, options), local.ray, true).primitive != NoPrimitive;
}
}
