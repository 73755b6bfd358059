// A view folded into an instance's octree coordinates: the local rays E' = M^-1 E, V' = M^-1 V.
#ifndef svoLocalView_h
#define svoLocalView_h

#include "svoOctree.h"
#include "svoRay.h"
#include "svoView.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace svo
{
/// Folded in double and re-originated: local rays start on the plane of linear depth `base`, the
/// nearest of the cube's corners (or the near plane), so that what is left fits a float. t of a
/// block is the linear depth minus `base`.
struct LocalView
{
  glm::dvec3 origin, originX, originY;
  glm::dvec3 direction, directionX, directionY;
  double base = 0.0;
  float tMax = -1.0f; // far plane or farthest corner, whichever is nearer; minus base
  PixelRect rect;     // of whole tiles that can see the cube; empty if none

  /// Ray k of a block: the one through point (x, y) of the image.
  void fill(double x, double y, int k, RayBlock& rays) const
  {
    rays.originX[k] =
      static_cast<float>(this->origin.x + y * this->originY.x + x * this->originX.x);
    rays.originY[k] =
      static_cast<float>(this->origin.y + y * this->originY.y + x * this->originX.y);
    rays.originZ[k] =
      static_cast<float>(this->origin.z + y * this->originY.z + x * this->originX.z);
    rays.directionX[k] =
      static_cast<float>(this->direction.x + y * this->directionY.x + x * this->directionX.x);
    rays.directionY[k] =
      static_cast<float>(this->direction.y + y * this->directionY.y + x * this->directionX.y);
    rays.directionZ[k] =
      static_cast<float>(this->direction.z + y * this->directionY.z + x * this->directionX.z);
  }
  /// Rays of the tile with its lower left pixel at (x0, y0).
  void fill(int x0, int y0, RayBlock& rays) const
  {
    for (int k = 0; k < 64; ++k)
    {
      this->fill(x0 + (k & 7) + 0.5, y0 + (k >> 3) + 0.5, k, rays);
    }
  }
};

/// Smallest float that is not below x.
inline float roundUp(double x)
{
  const float f = static_cast<float>(x);
  return f < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

inline LocalView makeLocalView(
  const Octree& octree, const glm::dmat4& localToWorld, const View& view)
{
  LocalView local;
  const Header& h = octree.header();
  const double edge = h.voxelSize * static_cast<double>(1u << h.level);
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  bool behind = false;
  const glm::dmat4 toView = view.worldToView * localToWorld;
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec4 corner(h.origin[0] + (i & 1) * edge, h.origin[1] + (i >> 1 & 1) * edge,
      h.origin[2] + (i >> 2) * edge, 1.0);
    const glm::dvec4 v = toView * corner;
    nearest = std::min(nearest, -v.z);
    farthest = std::max(farthest, -v.z);
    const glm::dvec4 clip = view.viewToClip * v;
    behind = behind || !(clip.w > 1e-9 * std::abs(clip.x) && clip.w > 1e-9 * std::abs(clip.y));
    const glm::dvec2 pixel(
      (clip.x / clip.w + 1.0) * 0.5 * view.width, (clip.y / clip.w + 1.0) * 0.5 * view.height);
    low = glm::min(low, pixel);
    high = glm::max(high, pixel);
  }
  if (!(farthest >= view.tNear && nearest <= view.tFar))
  {
    return local;
  }
  const double slack = 1e-5 * (farthest - nearest);
  local.base = std::max(nearest - slack, view.tNear);
  local.tMax = roundUp(std::min(farthest + slack, view.tFar) - local.base);
  if (behind)
  {
    local.rect = { 0, 0, view.width, view.height };
  }
  else
  {
    // A pixel of margin for the rounding of floats.
    const auto clamp = [](double v, int most)
    { return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(most))); };
    local.rect = { clamp(std::floor(low.x - 1.0), view.width),
      clamp(std::floor(low.y - 1.0), view.height), clamp(std::ceil(high.x + 1.0), view.width),
      clamp(std::ceil(high.y + 1.0), view.height) };
  }
  if (local.rect.empty())
  {
    local.rect = PixelRect();
    return local;
  }
  local.rect = { local.rect.x0 & ~7, local.rect.y0 & ~7, (local.rect.x1 + 7) & ~7,
    (local.rect.y1 + 7) & ~7 };
  const glm::dmat4 toOctree = octree.localToOctree() * glm::inverse(localToWorld);
  const glm::dmat3 linear(toOctree);
  local.direction = linear * view.direction;
  local.directionX = linear * view.directionX;
  local.directionY = linear * view.directionY;
  local.origin = glm::dvec3(toOctree * glm::dvec4(view.origin + local.base * view.direction, 1.0));
  local.originX = linear * (view.originX + local.base * view.directionX);
  local.originY = linear * (view.originY + local.base * view.directionY);
  return local;
}
}

#endif
