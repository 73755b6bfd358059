#include "svoFrustum.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace svo
{
namespace
{
/// A ray at a corner of the rectangle.
struct Corner
{
  glm::dvec3 origin, direction;
};

/// The rays of a rectangle, and what their numbers may be off by.
struct Bundle
{
  Corner corners[4];
  double originNoise, directionNoise; // world; world a unit of depth
};

double sum(const glm::dvec3& v)
{
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

Bundle bundleOf(const View& view, double x0, double y0, double x1, double y1)
{
  Bundle rays;
  for (int i = 0; i < 4; ++i)
  {
    const double x = i & 1 ? x1 : x0, y = i & 2 ? y1 : y0;
    rays.corners[i] = { view.rayOrigin(x, y), view.rayDirection(x, y) };
  }
  const double x = std::max(std::abs(x0), std::abs(x1)), y = std::max(std::abs(y0), std::abs(y1));
  constexpr double Rounding = 0x1p-48;
  rays.originNoise = Rounding * (sum(view.origin) + x * sum(view.originX) + y * sum(view.originY));
  rays.directionNoise =
    Rounding * (sum(view.direction) + x * sum(view.directionX) + y * sum(view.directionY));
  return rays;
}

/// The largest offset of a plane that all rays are inside of with; not finite where there is none:
/// numbers without an end have a noise without one.
double offsetFor(const View& view, const Bundle& rays, const glm::dvec3& normal)
{
  double lowest = std::numeric_limits<double>::infinity();
  for (const Corner& corner : rays.corners)
  {
    const double start = glm::dot(normal, corner.origin);
    const double slope = glm::dot(normal, corner.direction);
    const auto at = [&](double t)
    {
      const double noise = rays.originNoise + std::abs(t) * rays.directionNoise +
        0x1p-50 * (std::abs(start) + std::abs(t * slope));
      return start + t * slope - noise;
    };
    lowest = std::min(lowest, at(view.tNear));
    // A ray that certainly goes away is nearest where it starts, at whatever depth it ends.
    if (!(slope >= 2.0 * rays.directionNoise))
    {
      lowest = std::min(lowest, at(view.tFar));
    }
  }
  return -lowest;
}
}

Frustum::Frustum(const View& view, double margin)
{
  const PixelRect& rect = view.crop;
  const double x0 = rect.x0 - margin, x1 = rect.x1 + margin;
  const double y0 = rect.y0 - margin, y1 = rect.y1 + margin;
  const Bundle rays = bundleOf(view, x0, y0, x1, y1);
  const auto add = [&](const glm::dvec3& normal)
  {
    const double offset = offsetFor(view, rays, normal);
    // What is so far away says nothing; and no plane where something is no number.
    if (std::abs(offset) < 1e200 && std::isfinite(sum(normal)))
    {
      this->Normal[this->Count] = normal;
      this->Offset[this->Count++] = offset;
    }
  };
  // The side of rays at one x, or one y, which go through `a`; along the side rays differ by
  // (origin, direction) `by`, and `inwards` is where the others are.
  const auto addSide = [&](const Corner& a, const Corner& by, const Corner& inwards)
  {
    const bool origins = by.origin != glm::dvec3(0.0);
    const glm::dvec3 along = origins ? by.origin + view.tNear * by.direction : by.direction;
    const glm::dvec3 to =
      origins ? inwards.origin + view.tNear * inwards.direction : inwards.direction;
    glm::dvec3 normal = glm::cross(glm::normalize(along), glm::normalize(a.direction));
    normal /= glm::length(normal);
    normal = glm::dot(normal, to) < 0.0 ? -normal : normal;
    // Turned by a rounding or so, away from the rays: none comes nearer as it goes on, and
    // parallel ones, which start where they like, go away.
    normal += (8.0 * rays.directionNoise) * view.axis;
    add(normal / glm::length(normal));
  };
  const Corner alongX{ view.originX, view.directionX }, alongY{ view.originY, view.directionY };
  const auto turned = [](const Corner& c) { return Corner{ -c.origin, -c.direction }; };
  addSide(rays.corners[0], alongY, alongX);
  addSide(rays.corners[3], alongY, turned(alongX));
  addSide(rays.corners[0], alongX, alongY);
  addSide(rays.corners[3], alongX, turned(alongY));
  add(view.axis);
  add(-view.axis);
}
}
