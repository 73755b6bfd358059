// The depths of a tile's pixels on the planes of their triangles: the same floats as
// svoPlaceOnTriangles.h, from two linear functions of the pixel.
#ifndef svoTilePlanes_h
#define svoTilePlanes_h

#include "svoPlaceOnTriangles.h"

#include <cstdint>

namespace svo
{
/// How large the numbers are that rays of an image are added up from; octree coordinates.
struct RaySizes
{
  double origin = 0.0, direction = 0.0;
  double longest = 0.0; // direction, squared

  RaySizes() = default;
  RaySizes(const LocalView& local, const View& view)
  {
    const double width = view.width, height = view.height;
    this->origin = 2.0 + largestOf(local.origin) + width * largestOf(local.originX) +
      height * largestOf(local.originY);
    this->direction = largestOf(local.direction) + width * largestOf(local.directionX) +
      height * largestOf(local.directionY);
    for (int corner = 0; corner < 4; ++corner)
    {
      const glm::dvec3 d = local.directionAt(corner & 2 ? width : 0.0, corner & 1 ? height : 0.0);
      this->longest = std::max(this->longest, glm::dot(d, d));
    }
  }
};

/// A triangle's plane as a view sees it: depths are (n + nx x + ny y) / (d + dx x + dy y).
struct SeenPlane
{
  double n = 0.0, nx = 0.0, ny = 0.0;
  double d = 1.0, dx = 0.0, dy = 0.0;
  double slack = 0.0;  // in parts of the denominator: what depths can be off by
  double edgeOn = 0.0; // the denominator's square, where the plane may be seen edge-on

  SeenPlane() = default;

  /// The sums of meetPlane() and those here have at most 8 roundings each, of what adds up to the
  /// size of the normal times that of rays.
  SeenPlane(const TrianglePlane& plane, const LocalView& local, const RaySizes& sizes)
  {
    const glm::dvec3& normal = plane.normal;
    this->n = glm::dot(normal, plane.p - local.origin);
    this->nx = -glm::dot(normal, local.originX);
    this->ny = -glm::dot(normal, local.originY);
    this->d = glm::dot(normal, local.direction);
    this->dx = glm::dot(normal, local.directionX);
    this->dy = glm::dot(normal, local.directionY);
    const double size = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
    this->slack = 0x1p-48 * size * (sizes.origin + 2.0 * local.tMax * sizes.direction);
    this->edgeOn = 1.001e-6 * glm::dot(normal, normal) * sizes.longest;
  }
};

/// For the pixels' centres of a tile of 8x8 whose lower left corner is (x, y): depths on the planes
/// that `plane` names of each, as meetPlane() has them, rounded to float. One bit each for pixels
/// where that is not certain: meetPlane() may be rounded to another float, or the plane be seen
/// edge-on.
std::uint64_t depthsOnPlanes(
  const SeenPlane* planes, const std::int32_t* plane, double x, double y, float* t);

/// Aims all rays of a block through the points x, y of the image.
void fillRays(const LocalView& local, const double* x, const double* y, RayBlock& rays);
}

#endif
