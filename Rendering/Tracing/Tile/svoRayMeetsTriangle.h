// The float test of a single ray and a triangle, to the same bits as svoIntersectTile.h.
#ifndef svoRayMeetsTriangle_h
#define svoRayMeetsTriangle_h

#include "svoSurface.h"
#include "svoTriangle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/vec3.hpp>

namespace svo
{
/// Where a ray meets a triangle, whatever its ends: false if it misses.
inline bool rayMeetsTriangle(const Surface& surface, const glm::vec3& origin,
  const glm::vec3& direction, std::uint32_t triangle, float& t)
{
  // As sortRays() has it.
  const glm::vec3 size(std::abs(direction.x), std::abs(direction.y), std::abs(direction.z));
  const float largest = std::max(std::max(size.x, size.y), size.z);
  constexpr float Smallest = std::numeric_limits<float>::min();
  if (!(largest >= Smallest && largest < std::numeric_limits<float>::infinity()))
  {
    return false;
  }
  const float negligible =
    std::max(largest * (std::numeric_limits<float>::epsilon() / 256.0f), Smallest);
  glm::vec3 along;
  for (int k = 0; k < 3; ++k)
  {
    along[k] = size[k] < negligible ? 0.0f : direction[k];
  }
  const glm::uvec3 points = surface.triangles[triangle];
  return intersectTriangle(ShearedRay<float>(origin, along), surface.points[points.x],
    surface.points[points.y], surface.points[points.z], t);
}
}

#endif
