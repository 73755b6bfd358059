// Hits of float rays moved onto their triangles' planes, along the rays in double.
#ifndef svoPlaceOnTriangles_h
#define svoPlaceOnTriangles_h

#include "svoLocalView.h"
#include "svoSurface.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// How far placeOnTriangles() may move a hit, in t. Float rays are off by about 1e-7 of the cube
/// across, and at a slant by a few times that along the ray; on a triangle that is n times as long
/// as wide by about n times that.
inline double placingReach(const LocalView& local)
{
  return 1e-3 * local.tMax;
}

/// The same where a triangle is seen edge-on, so that its plane says nothing of what is farther.
inline double edgeOnReach(const LocalView& local)
{
  return 1e-5 * local.tMax;
}

/// True if the sine of a ray's angle to a triangle is less than 1e-3. `along`: the product of
/// `normal` and `direction`.
inline bool seenEdgeOn(const glm::dvec3& normal, const glm::dvec3& direction, double along)
{
  return !(along * along > 1e-6 * glm::dot(normal, normal) * glm::dot(direction, direction));
}

/// Moves the hits of a block of rays, through the points x, y of the image, onto the planes of
/// their triangles, along the rays as they are in double: so that nothing is lost but the rounding
/// of the triangles' own points. The error along a ray of a picture is then less than half of what
/// it was.
inline void placeOnTriangles(
  const Surface& surface, const LocalView& local, const double* x, const double* y, HitBlock& hits)
{
  const double reach = placingReach(local);
  const double nearReach = edgeOnReach(local);
  Primitive last = NoPrimitive; // neighbours often meet the same triangle
  glm::dvec3 p(0.0), normal(0.0);
  for (int k = 0; k < RayBlock::Size; ++k)
  {
    const Primitive primitive = hits.primitive[k];
    if (primitive == NoPrimitive)
    {
      continue;
    }
    if (primitive != last)
    {
      assert(primitive < surface.triangles.size());
      last = primitive;
      const glm::uvec3 triangle = surface.triangles[primitive];
      p = glm::dvec3(surface.points[triangle.x]);
      normal = glm::cross(
        glm::dvec3(surface.points[triangle.y]) - p, glm::dvec3(surface.points[triangle.z]) - p);
    }
    const glm::dvec3 origin = local.origin + y[k] * local.originY + x[k] * local.originX;
    const glm::dvec3 direction =
      local.direction + y[k] * local.directionY + x[k] * local.directionX;
    const double along = glm::dot(normal, direction);
    const double t = glm::dot(normal, p - origin) / along;
    const double move = std::abs(t - hits.t[k]);
    // Not where it is not a number.
    if (move <= nearReach || (move <= reach && !seenEdgeOn(normal, direction, along)))
    {
      hits.t[k] = std::clamp(static_cast<float>(t), 0.0f, local.tMax);
    }
  }
}
}

#endif
