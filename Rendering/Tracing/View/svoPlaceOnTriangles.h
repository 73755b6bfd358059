// Hits of float rays moved onto their triangles' planes, along the rays in double.
#ifndef svoPlaceOnTriangles_h
#define svoPlaceOnTriangles_h

#include "svoLocalView.h"
#include "svoSurface.h"

#include <algorithm>
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

/// Where a ray through the point (x, y) of the image, as it is in double, meets the plane.
/// `edgeOn`: whether the sine of its angle to the plane is less than 1e-3.
inline double meetPlane(
  const TrianglePlane& plane, const LocalView& local, double x, double y, bool& edgeOn)
{
  const glm::dvec3 direction = local.directionAt(x, y);
  const double along = glm::dot(plane.normal, direction);
  edgeOn =
    !(along * along > 1e-6 * glm::dot(plane.normal, plane.normal) * glm::dot(direction, direction));
  return glm::dot(plane.normal, plane.p - local.originAt(x, y)) / along;
}

/// Moves the hit of a ray onto the plane of its triangle, along the ray: so that nothing is lost
/// but the rounding of the triangle's own points. The error along a ray of a picture is then less
/// than half as large.
inline float placeOnPlane(
  const TrianglePlane& plane, const LocalView& local, double x, double y, float hit)
{
  bool edgeOn;
  const double t = meetPlane(plane, local, x, y, edgeOn);
  const double move = std::abs(t - hit);
  // Not where it is not a number.
  return move <= edgeOnReach(local) || (move <= placingReach(local) && !edgeOn)
    ? std::clamp(static_cast<float>(t), 0.0f, local.tMax)
    : hit;
}

/// The same for the hits of a block of rays through the points x, y of the image.
inline void placeOnTriangles(
  const Surface& surface, const LocalView& local, const double* x, const double* y, HitBlock& hits)
{
  Primitive last = NoPrimitive; // neighbours often meet the same triangle
  TrianglePlane plane;
  for (int k = 0; k < RayBlock::Size; ++k)
  {
    const Primitive primitive = hits.primitive[k];
    if (primitive == NoPrimitive)
    {
      continue;
    }
    if (primitive != last)
    {
      last = primitive;
      plane = TrianglePlane(surface, primitive);
    }
    hits.t[k] = placeOnPlane(plane, local, x[k], y[k], hits.t[k]);
  }
}
}

#endif
