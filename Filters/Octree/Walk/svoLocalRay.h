// A ray in double, made ready for the walk through an octree.
#ifndef svoLocalRay_h
#define svoLocalRay_h

#include "svoRay.h"
#include "svoTraverse.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>

namespace svo
{
/// A ray scaled, clipped and moved to where it enters the cube: t = (local t + start) / scale.
struct LocalRay
{
  ClippedRay<double> ray;
  double start = 0.0;
  double scale = 1.0;
};

/// False if the ray misses the octree's cube.
inline bool prepareRay(const Octree& octree, const Ray& ray, LocalRay& local)
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
  const double edge = 1.0 / static_cast<double>(1 << octree.rootBits(0));
  local.start = local.ray.tMin;
  local.ray.origin = glm::clamp(ray.origin + local.start * local.ray.direction, 1.0, 1.0 + edge);
  local.ray.tMin = 0.0;
  local.ray.tStart -= local.start;
  local.ray.tMax -= local.start;
  assert(local.ray.tMax >= 0.0);
  return true;
}
}

#endif
