// A view folded into an instance's octree coordinates: the local rays E' = M^-1 E, V' = M^-1 V of
// Huang and Cheng, 2017.
#ifndef svoLocalView_h
#define svoLocalView_h

#include "svoIntersect.h"
#include "svoOctree.h"
#include "svoRay.h"
#include "svoView.h"
#include "svoWorldToOctree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <glm/mat4x4.hpp>

namespace svo
{
/// Folded in double and re-originated: local rays start on the plane of linear depth `base`, the
/// nearest of the cube's corners (or the near plane), so that what is left fits a float. t of a
/// block is the linear depth minus `base`.
struct LocalView
{
  glm::dvec3 origin, originX, originY;
  glm::dvec3 direction, directionX, directionY;
  WorldToOctree toOctree;
  double base = 0.0;
  float tMax = -1.0f; // far plane or farthest corner, whichever is nearer; minus base
  /// That can see the cube; empty if none. With those of the last tiles beyond the crop.
  PixelRect pixels;
  PixelRect rect; // whole tiles of these
  /// On the plane of `base` rays may start many cubes away from where they meet the cube, as where
  /// an object is flat or long and seen at a slant, or at the border of a very wide view: a float
  /// would lose the voxel. Such rays are traced by intersectStretched().
  bool stretched = false;

  /// The ray through point (x, y) of the image; floats of these are what is traced.
  glm::dvec3 originAt(double x, double y) const
  {
    return this->origin + y * this->originY + x * this->originX;
  }
  glm::dvec3 directionAt(double x, double y) const
  {
    return this->direction + y * this->directionY + x * this->directionX;
  }
};

/// Smallest float that is not below x.
inline float roundUp(double x)
{
  const float f = static_cast<float>(x);
  return f < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

/// A cube of local coordinates as a view sees it.
struct SeenCube
{
  double nearest = 0.0; // linear depth of the nearest corner, or of the near plane
  double farthest = 0.0;
  PixelRect rect; // empty if it cannot be seen
};

/// `low`, `edge`: the cube's lower corner and the length of its edges, local.
inline SeenCube seeCube(
  const glm::dvec3& low, double edge, const glm::dmat4& localToWorld, const View& view)
{
  assert(edge >= 0.0 && view.width >= 0 && view.height >= 0);
  SeenCube seen;
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  glm::dvec2 lowest(std::numeric_limits<double>::infinity());
  glm::dvec2 highest = -lowest;
  bool behind = false;
  const glm::dmat4 toView = view.worldToView * localToWorld;
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec4 corner(
      low[0] + (i & 1) * edge, low[1] + (i >> 1 & 1) * edge, low[2] + (i >> 2) * edge, 1.0);
    const glm::dvec4 v = toView * corner;
    nearest = std::min(nearest, -v.z);
    farthest = std::max(farthest, -v.z);
    const glm::dvec4 clip = view.viewToClip * v;
    behind = behind || !(clip.w > 1e-9 * std::abs(clip.x) && clip.w > 1e-9 * std::abs(clip.y));
    const glm::dvec2 pixel(
      (clip.x / clip.w + 1.0) * 0.5 * view.width, (clip.y / clip.w + 1.0) * 0.5 * view.height);
    lowest = glm::min(lowest, pixel);
    highest = glm::max(highest, pixel);
  }
  if (!(farthest >= view.tNear && nearest <= view.tFar))
  {
    return seen;
  }
  const double slack = 1e-5 * (farthest - nearest);
  seen.nearest = std::max(nearest - slack, view.tNear);
  seen.farthest = std::min(farthest + slack, view.tFar);
  if (behind)
  {
    seen.rect = view.crop;
  }
  else
  {
    // A pixel of margin for the rounding of floats.
    const PixelRect& crop = view.crop;
    const auto clamp = [](double v, int from, int to)
    { return static_cast<int>(std::clamp(v, static_cast<double>(from), static_cast<double>(to))); };
    seen.rect = { clamp(std::floor(lowest.x - 1.0), crop.x0, crop.x1),
      clamp(std::floor(lowest.y - 1.0), crop.y0, crop.y1),
      clamp(std::ceil(highest.x + 1.0), crop.x0, crop.x1),
      clamp(std::ceil(highest.y + 1.0), crop.y0, crop.y1) };
  }
  if (seen.rect.empty())
  {
    seen.rect = PixelRect();
  }
  return seen;
}

/// The cube of an octree's voxels.
inline SeenCube seeOctree(const Octree& octree, const glm::dmat4& localToWorld, const View& view)
{
  const Header& h = octree.header();
  return seeCube({ h.origin[0], h.origin[1], h.origin[2] },
    h.voxelSize * static_cast<double>(1u << h.level), localToWorld, view);
}

inline LocalView makeLocalView(
  const Octree& octree, const glm::dmat4& localToWorld, const View& view)
{
  LocalView local;
  const SeenCube seen = seeOctree(octree, localToWorld, view);
  local.pixels = seen.rect;
  if (local.pixels.empty())
  {
    return local;
  }
  local.base = seen.nearest;
  local.tMax = roundUp(seen.farthest - local.base);
  PixelRect& p = local.pixels;
  local.rect = { p.x0 & ~7, p.y0 & ~7, (p.x1 + 7) & ~7, (p.y1 + 7) & ~7 };
  p.x1 = p.x1 < view.crop.x1 ? p.x1 : local.rect.x1;
  p.y1 = p.y1 < view.crop.y1 ? p.y1 : local.rect.y1;
  local.toOctree = WorldToOctree(octree, localToWorld);
  const WorldToOctree& toOctree = local.toOctree;
  local.direction = toOctree.vector(view.direction);
  local.directionX = toOctree.vector(view.directionX);
  local.directionY = toOctree.vector(view.directionY);
  local.origin = toOctree.point(view.origin + local.base * view.direction);
  local.originX = toOctree.vector(view.originX + local.base * view.directionX);
  local.originY = toOctree.vector(view.originY + local.base * view.directionY);
  // The farthest that a ray can start from where it meets the cube, in cubes: 16 of them, rounded
  // to a float, are a thousandth of a voxel of level 10.
  constexpr double FarthestStart = 16.0;
  const double across = std::max({ glm::length(local.direction), // at the corners of the image
    glm::length(local.direction + static_cast<double>(view.width) * local.directionX),
    glm::length(local.direction + static_cast<double>(view.height) * local.directionY),
    glm::length(local.direction + static_cast<double>(view.width) * local.directionX +
      static_cast<double>(view.height) * local.directionY) });
  local.stretched = local.tMax * across > FarthestStart;
  return local;
}

/// As intersect() of a block, for rays through the points x[k], y[k] of the image whose tMin and
/// tMax are set: every ray starts where it enters the cube, found in double.
inline void intersectStretched(const Octree& octree, const LocalView& local, const double* x,
  const double* y, RayBlock& rays, const TraceOptions& options, HitBlock& hits)
{
  const double high = 1.0 + std::ldexp(1.0, -octree.rootBits(0));
  double start[RayBlock::Size];
  for (int k = 0; k < RayBlock::Size; ++k)
  {
    const glm::dvec3 origin = local.originAt(x[k], y[k]), d = local.directionAt(x[k], y[k]);
    double enter = rays.tMin[k];
    double leave = rays.tMax[k];
    for (int a = 0; a < 3; ++a)
    {
      if (d[a] != 0.0)
      {
        const double low = (1.0 - origin[a]) / d[a];
        const double far = (high - origin[a]) / d[a];
        enter = std::max(enter, std::min(low, far));
        leave = std::min(leave, std::max(low, far));
      }
    }
    start[k] = enter;
    const glm::dvec3 at = origin + enter * d;
    rays.aim(k, at, d);
    // What the float ray has of the cube is decided by its own clipping; before it the ray begins
    // where it began.
    rays.tMin[k] = enter <= leave ? static_cast<float>(rays.tMin[k] - enter) : 1.0f;
    // A hit that is rounded down to tMax below has to be found, or cutting would change ties.
    const double end = std::nextafter(rays.tMax[k], std::numeric_limits<float>::infinity());
    rays.tMax[k] = enter <= leave ? roundUp(end - enter) : 0.0f;
  }
  intersect(octree, rays, options, hits);
  for (int k = 0; k < RayBlock::Size; ++k)
  {
    hits.t[k] = static_cast<float>(start[k] + hits.t[k]);
  }
}
}

#endif
