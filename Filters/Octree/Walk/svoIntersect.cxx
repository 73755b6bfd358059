#include "svoIntersect.h"

#include "svoLeafGeometry.h"
#include "svoLocalRay.h"
#include "svoSurface.h"
#include "svoTriangle.h"

#include <algorithm>
#include <cassert>

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

bool occludedByOthers(
  const Octree& octree, const Ray& ray, const std::function<bool(Primitive)>& skipped)
{
  LocalRay local;
  if (!prepareRay(octree, ray, local))
  {
    return false;
  }
  assert(octree.surface());
  const Surface& surface = *octree.surface();
  const ShearedRay<double> sheared(local.ray.origin, local.ray.direction);
  bool met = false;
  walk(octree, local.ray, octree.level(),
    [&](const StopCell<double>& cell, double& tMax)
    {
      std::uint32_t count = 0;
      std::uint32_t inlineId = 0;
      const std::uint32_t* list = octree.brickTriangles(cell.node, count, inlineId);
      for (std::uint32_t k = 0; k < count && !met; ++k)
      {
        const glm::uvec3 triangle = surface.triangles[list[k]];
        double t;
        met = intersectTriangle(sheared, surface.points[triangle.x], surface.points[triangle.y],
                surface.points[triangle.z], t) &&
          t >= local.ray.tMin && t <= tMax && !skipped(list[k]);
      }
      return met ? Visit::Stop : Visit::SkipBrick;
    });
  return met;
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
