#include "svoLevelSetPlane.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// The trilinear field at a point of [-1, 1]^3, 0 being the middle voxel's centre.
double interpolated(const VoxelValues& values, const glm::dvec3& at)
{
  const glm::ivec3 low(at.x < 0.0 ? -1 : 0, at.y < 0.0 ? -1 : 0, at.z < 0.0 ? -1 : 0);
  const glm::dvec3 t = at - glm::dvec3(low);
  double sum = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    const glm::ivec3 upper(i & 1, i >> 1 & 1, i >> 2);
    const double weight =
      (upper.x ? t.x : 1.0 - t.x) * (upper.y ? t.y : 1.0 - t.y) * (upper.z ? t.z : 1.0 - t.z);
    sum += weight * values(low.x + upper.x, low.y + upper.y, low.z + upper.z);
  }
  return sum;
}

/// Whether the surface passes the voxel. In each of its octants the field is trilinear, so that its
/// extremes lie at the corners of the octants: means of two, four and eight values.
bool crosses(const VoxelValues& values)
{
  double half[VoxelValues::Count];
  std::copy(values.at, values.at + VoxelValues::Count, half);
  for (const int step : { 1, 3, 9 })
  {
    for (int i = 0; i < VoxelValues::Count; ++i)
    {
      if (i / step % 3 == 1)
      {
        half[i - step] = 0.5 * (half[i - step] + half[i]);
        half[i + step] = 0.5 * (half[i] + half[i + step]);
      }
    }
  }
  const auto [low, high] = std::minmax_element(half, half + VoxelValues::Count);
  return *low <= 0.0 && *high >= 0.0 && *low < *high;
}

/// Differences of neighbours; where they cancel, as in a thin sheet, of all that is around.
glm::dvec3 gradientOf(const VoxelValues& v)
{
  const glm::dvec3 g(v(1, 0, 0) - v(-1, 0, 0), v(0, 1, 0) - v(0, -1, 0), v(0, 0, 1) - v(0, 0, -1));
  if (g != glm::dvec3(0.0))
  {
    return 0.5 * g;
  }
  glm::dvec3 sum(0.0);
  for (int i = 0; i < VoxelValues::Count; ++i)
  {
    sum += v.at[i] * glm::dvec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
  }
  return sum / 18.0;
}
}

bool VoxelValues::change() const
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : this->at)
  {
    if (!std::isfinite(value))
    {
      return false;
    }
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return low <= 0.0 && high >= 0.0 && low < high;
}

bool levelSetPlane(const VoxelValues& values, SourcePlane& plane)
{
  if (!values.change() || !crosses(values))
  {
    return false;
  }
  // Scaled: squares of values near the ends of a double's range would not be finite.
  const glm::dvec3 gradient = gradientOf(values);
  const glm::dvec3 size = glm::abs(gradient);
  const double scale = std::max({ size.x, size.y, size.z });
  if (!(scale > 0.0) || !std::isfinite(scale) || !std::isfinite(1.0 / scale))
  {
    plane = { glm::dvec3(0.0, 0.0, 1.0), 0.0 };
    return true;
  }
  const double length = scale * glm::length(gradient / scale);
  plane.normal = glm::normalize(gradient / scale);
  plane.offset = -values(0, 0, 0) / length;
  // What the field is at the foot corrects, if that is near enough to be one, and the field is flat
  // enough there.
  if (std::abs(plane.offset) <= 1.0)
  {
    const double rest = interpolated(values, plane.offset * plane.normal);
    const bool settled = std::abs(rest) <= 0.5 * std::abs(values(0, 0, 0));
    plane.offset -= settled ? rest / length : 0.0;
  }
  // Where the field bends, its plane need not pass.
  const double reach = 0.5 * (size.x + size.y + size.z) / length;
  plane.offset = std::clamp(plane.offset, -reach, reach);
  return std::isfinite(plane.offset);
}
}
