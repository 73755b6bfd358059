#include "svoOccludedByOthers.h"

#include "svoLocalRay.h"
#include "svoSurface.h"
#include "svoTriangle.h"

#include <cassert>

namespace svo
{
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
}
