#include "svoLightView.h"

#include "svoBox.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace svo
{
namespace
{
/// Corners of the casters' boxes, a voxel wider than the meshes.
std::vector<glm::dvec3> casterCorners(
  const std::vector<Outline>& outlines, const std::vector<std::uint8_t>& casters)
{
  std::vector<glm::dvec3> corners;
  corners.reserve(
    8 * (casters.size() - static_cast<std::size_t>(std::count(casters.begin(), casters.end(), 0))));
  for (std::size_t i = 0; i < outlines.size(); ++i)
  {
    if (casters[i])
    {
      const std::array<glm::dvec3, 8> box = worldCorners(outlines[i], outlines[i].voxelSize);
      corners.insert(corners.end(), box.begin(), box.end());
    }
  }
  return corners;
}

// A view that follows every turn of a caster is a new view, and all its layers are traced anew. So
// each quantity of a fit is rounded outwards to a coarse grid: it changes now and then.

/// Power of two not below x.
double powerOfTwo(double x)
{
  return std::exp2(std::ceil(std::log2(x)));
}

/// World -> a view at `eye` that looks along `direction`.
glm::dmat4 lookAlong(const glm::dvec3& eye, const glm::dvec3& direction)
{
  // The axis least along the direction, so that the view does not spin with it.
  const glm::dvec3 a = glm::abs(direction);
  const glm::dvec3 up = a.y <= a.x && a.y <= a.z ? glm::dvec3(0, 1, 0)
    : a.z <= a.x                                 ? glm::dvec3(0, 0, 1)
                                                 : glm::dvec3(1, 0, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(direction, up));
  const glm::dvec3 above = glm::cross(right, direction);
  glm::dmat4 m(1.0);
  for (int i = 0; i < 3; ++i)
  {
    m[i] = glm::dvec4(right[i], above[i], -direction[i], 0.0);
  }
  m[3] = glm::dvec4(-glm::dot(right, eye), -glm::dot(above, eye), glm::dot(direction, eye), 1.0);
  return m;
}

/// Where rays of positional lights begin, of the farthest corner: before a small caster beside a
/// light above a vast ground.
constexpr double NearestDepth = 1e-6;

void add(std::vector<View>& views, const glm::dmat4& worldToView, const glm::dmat4& viewToClip,
  int resolution)
{
  View view;
  if (makeView(worldToView, viewToClip, resolution, resolution, view))
  {
    views.push_back(view);
  }
}

/// Widens [low, high] to a grid of at most an eighth of its length, so that fitted bounds seldom
/// change.
void roundOutwards(double& low, double& high)
{
  assert(!(high < low)); // of forged octrees not numbers: makeView() refuses such views
  const double step = powerOfTwo(high - low) / 16.0;
  low = std::floor(low / step) * step;
  high = std::ceil(high / step) * step;
}

std::vector<View> fitDirectional(
  const std::vector<glm::dvec3>& corners, const glm::dvec3& direction, int resolution)
{
  Box world;
  for (const glm::dvec3& p : corners)
  {
    world.add(p);
  }
  const double across = powerOfTwo(glm::length(world.high - world.low));
  const glm::dvec3 centre =
    glm::round(0.5 * (world.low + world.high) / (0.25 * across)) * (0.25 * across);
  const glm::dmat4 toView = lookAlong(centre, direction);
  Box box;
  for (const glm::dvec3& p : corners)
  {
    box.add(glm::dvec3(toView * glm::dvec4(p, 1.0)));
  }
  for (int i = 0; i < 3; ++i)
  {
    box.high[i] = std::max(box.high[i], box.low[i] + 1e-9 * across);
    roundOutwards(box.low[i], box.high[i]);
  }
  // A texel of margin, so that casters never touch the border.
  const glm::dvec3 margin = (box.high - box.low) / static_cast<double>(std::max(resolution - 2, 1));
  std::vector<View> views;
  add(views, toView,
    glm::ortho(box.low.x - margin.x, box.high.x + margin.x, box.low.y - margin.y,
      box.high.y + margin.y, -(box.high.z + margin.z), -(box.low.z - margin.z)),
    resolution);
  return views;
}

std::vector<View> sixFaces(const glm::dvec3& position, double farthest, int resolution)
{
  std::vector<View> views;
  for (int i = 0; i < 6; ++i)
  {
    glm::dvec3 direction(0.0);
    direction[i / 2] = i % 2 ? -1.0 : 1.0;
    const double n = NearestDepth * farthest;
    add(views, lookAlong(position, direction), glm::frustum(-n, n, -n, n, n, farthest), resolution);
  }
  return views;
}

std::vector<View> fitPositional(
  const std::vector<glm::dvec3>& corners, const Light& light, int resolution)
{
  const bool spot = light.hasCone() && light.coneAngle < 60.0;
  glm::dvec3 axis(0.0);
  double farthest = 0.0;
  for (const glm::dvec3& p : corners)
  {
    const double distance = glm::length(p - light.position);
    farthest = std::max(farthest, distance);
    axis += distance > 0.0 ? (p - light.position) / distance : glm::dvec3(0.0);
  }
  farthest = powerOfTwo(1.001 * farthest);
  if (!(farthest > 0.0) || !std::isfinite(farthest))
  {
    return {};
  }
  if (spot)
  {
    axis = light.direction;
  }
  const double length = glm::length(axis);
  if (!(length > 1e-9))
  {
    return sixFaces(light.position, farthest, resolution);
  }
  axis /= length;
  if (!spot)
  {
    axis = glm::normalize(glm::round(4.0 * axis)); // at most 12 degrees off
  }
  const glm::dmat4 toView = lookAlong(light.position, axis);
  Box slopes;
  bool wide = false;
  for (const glm::dvec3& p : corners)
  {
    const glm::dvec3 v(toView * glm::dvec4(p, 1.0));
    if (!(-v.z > 0.5 * glm::length(v)))
    {
      wide = true; // beyond 60 degrees
      continue;
    }
    slopes.add(glm::dvec3(v.x / -v.z, v.y / -v.z, 0.0));
  }
  if (wide && !spot)
  {
    return sixFaces(light.position, farthest, resolution);
  }
  const double nearest = NearestDepth * farthest;
  for (int i = 0; i < 2 && !wide; ++i)
  {
    slopes.high[i] = std::max(slopes.high[i], slopes.low[i] + 1e-9);
    roundOutwards(slopes.low[i], slopes.high[i]);
  }
  if (spot)
  {
    const double reach = std::tan(glm::radians(light.coneAngle)) * 1.001 + 1e-6;
    if (wide)
    {
      slopes.low = glm::dvec3(-reach);
      slopes.high = glm::dvec3(reach);
    }
    slopes.low = glm::clamp(slopes.low, -reach, reach);
    slopes.high = glm::clamp(slopes.high, -reach, reach);
  }
  const glm::dvec3 size = glm::max(slopes.high - slopes.low, glm::dvec3(1e-9));
  const glm::dvec3 margin = size / static_cast<double>(std::max(resolution - 2, 1));
  const glm::dvec3 low = (slopes.low - margin) * nearest;
  const glm::dvec3 high = (slopes.high + margin) * nearest;
  std::vector<View> views;
  add(views, toView, glm::frustum(low.x, high.x, low.y, high.y, nearest, farthest), resolution);
  return views;
}
}

std::vector<View> fitLight(const std::vector<Outline>& outlines,
  const std::vector<std::uint8_t>& casters, const Light& light, int resolution)
{
  assert(casters.size() <= outlines.size());
  const std::vector<glm::dvec3> corners = casterCorners(outlines, casters);
  if (corners.empty() || resolution < 1)
  {
    return {};
  }
  return light.atInfinity() ? fitDirectional(corners, light.direction, resolution)
                            : fitPositional(corners, light, resolution);
}
}
