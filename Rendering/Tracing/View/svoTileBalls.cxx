#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTileBalls.cxx"
#include <hwy/foreach_target.h>

#ifndef svoTileBalls_rays
#define svoTileBalls_rays

#include "svoTileBalls.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace svo
{
/// A tile's rays in radii from the ball's centre. They begin `start` further on, nearly beside the
/// centre, where floats have the most digits.
struct BallRays
{
  glm::vec3 origin, originX, originY;
  glm::vec3 direction, directionX, directionY;
  float start, end;
};
}
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
// Loops vectorise where what they read of all pixels alike has been copied first.

void mergeBall(const BallRays& from, double base, std::int64_t name, TileBalls& seen, double& last)
{
  constexpr float Infinity = std::numeric_limits<float>::infinity();
  const BallRays rays = from;
  alignas(64) float t[64];
  for (int i = 0; i < 64; ++i)
  {
    const float px = static_cast<float>(i & 7), py = static_cast<float>(i >> 3);
    const float ox = rays.origin.x + py * rays.originY.x + px * rays.originX.x;
    const float oy = rays.origin.y + py * rays.originY.y + px * rays.originX.y;
    const float oz = rays.origin.z + py * rays.originY.z + px * rays.originX.z;
    const float dx = rays.direction.x + py * rays.directionY.x + px * rays.directionX.x;
    const float dy = rays.direction.y + py * rays.directionY.y + px * rays.directionX.y;
    const float dz = rays.direction.z + py * rays.directionY.z + px * rays.directionX.z;
    // By the point of the ray that is nearest to the centre: squares of coordinates cancel where
    // the ball is small (Haines et al., "Precision Improvements for Ray/Sphere Intersection", Ray
    // Tracing Gems, 2019).
    const float perLength2 = 1.0f / (dx * dx + dy * dy + dz * dz);
    const float middle = -(ox * dx + oy * dy + oz * dz) * perLength2;
    const float nx = ox + middle * dx, ny = oy + middle * dy, nz = oz + middle * dz;
    const float inside = 1.0f - (nx * nx + ny * ny + nz * nz);
    const float half = std::sqrt((inside > 0.0f ? inside : 0.0f) * perLength2);
    const float near = rays.start + (middle - half), far = rays.start + (middle + half);
    const float first = near >= 0.0f ? near : far;
    t[i] = inside >= 0.0f && first >= 0.0f && first <= rays.end ? first : Infinity;
  }
  double* const depth = seen.depth;
  double* const kept = seen.t;
  std::int64_t* const ball = seen.ball;
  for (int i = 0; i < 64; ++i)
  {
    const double own = t[i], z = base + own;
    const bool nearer = z < depth[i] || (z == depth[i] && own < Infinity && name > ball[i]);
    depth[i] = nearer ? z : depth[i];
    kept[i] = nearer ? own : kept[i];
    ball[i] = nearer ? name : ball[i];
  }
  alignas(64) double deepest[8];
  for (int k = 0; k < 8; ++k)
  {
    deepest[k] = depth[k];
  }
  for (int row = 1; row < 8; ++row)
  {
    for (int k = 0; k < 8; ++k)
    {
      const double d = depth[8 * row + k];
      deepest[k] = d > deepest[k] ? d : deepest[k];
    }
  }
  last = *std::max_element(deepest, deepest + 8);
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(mergeBall);

void TileBalls::clear()
{
  std::fill(this->depth, this->depth + 64, std::numeric_limits<double>::infinity());
  std::fill(this->t, this->t + 64, 0.0);
  std::fill(this->ball, this->ball + 64, None);
}

double TileBalls::merge(
  const Octree& octree, const LocalView& local, int tileX, int tileY, std::int64_t name)
{
  const Header& h = octree.header();
  const double radii = octree.rootEdge();
  const glm::dvec3 centre = 1.0 - glm::dvec3(h.origin[0], h.origin[1], h.origin[2]) / radii;
  const double x = 8 * tileX + 0.5, y = 8 * tileY + 0.5;
  constexpr double Middle = 3.5;
  const glm::dvec3 from = local.originAt(x + Middle, y + Middle) - centre;
  const glm::dvec3 along = local.directionAt(x + Middle, y + Middle);
  const double start = -glm::dot(from, along) / glm::dot(along, along);
  const glm::dvec3 direction = local.directionAt(x, y);
  const glm::dvec3 origin = local.originAt(x, y) - centre + start * direction;
  const BallRays rays{ radii * origin, radii * (local.originX + start * local.directionX),
    radii * (local.originY + start * local.directionY), radii * direction, radii * local.directionX,
    radii * local.directionY, static_cast<float>(start), local.tMax };
  double last;
  HWY_DYNAMIC_DISPATCH(mergeBall)(rays, local.base, name, *this, last);
  return last;
}
}
#endif
