#include "svoIntersect.h"

#include "svoLeafGeometry.h"
#include "svoTraverse.h"

#include <cassert>
#include <cmath>

namespace svo
{
namespace
{
/// A ray scaled, clipped and moved to where it enters the cube: t = (local t + start) / scale.
struct LocalRay
{
  ClippedRay<double> ray;
  double start = 0.0;
  double scale = 1.0;
};

/// False if the ray misses the octree's cube.
bool prepare(const Octree& octree, const Ray& ray, LocalRay& local)
{
  if (!octree || octree.empty())
  {
    return false;
  }
  const glm::dvec3 d = glm::abs(ray.direction);
  const double largest = std::max({ d.x, d.y, d.z });
  if (!std::isfinite(largest) || !(largest > 0.0))
  {
    return false;
  }
  // A power of two is exact: directions of any length, denormal ones too, trace alike.
  const int exponent = std::clamp(std::ilogb(largest), -1000, 1000);
  local.scale = std::ldexp(1.0, exponent);
  const glm::dvec3 direction = ray.direction / local.scale;
  if (!clip(
        octree, ray.origin, direction, ray.tMin * local.scale, ray.tMax * local.scale, local.ray))
  {
    return false;
  }
  const double edge = 1.0 / static_cast<double>(1 << rootBits(octree, 0));
  local.start = local.ray.tMin;
  local.ray.origin = glm::clamp(ray.origin + local.start * local.ray.direction, 1.0, 1.0 + edge);
  local.ray.tMin = 0.0;
  local.ray.tStart -= local.start;
  local.ray.tMax -= local.start;
  assert(local.ray.tMax >= 0.0);
  return true;
}
}

Hit intersect(const Octree& octree, const Ray& ray, const TraceOptions& options)
{
  Hit hit;
  LocalRay local;
  if (!prepare(octree, ray, local))
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
  return prepare(octree, ray, local) &&
    intersectLeaves(LeafQuery(octree, options), local.ray, true).primitive != NoPrimitive;
}
}
