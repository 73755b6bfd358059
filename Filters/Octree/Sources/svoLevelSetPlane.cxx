#include "svoLevelSetPlane.h"

#include "svoImageSource.h"

#include <algorithm>
#include <cmath>

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
  return trilinear(low, at - glm::dvec3(low), 0.0, values);
}

/// Where along a way of that length the field is 0, if it has changed its sign at the end:
/// Illinois' method, on what is a cubic polynomial in an octant.
bool findZero(const VoxelValues& values, const glm::dvec3& way, double& share)
{
  constexpr int Most = 12;
  constexpr double Close = 1e-4;
  double a = 0.0, b = 1.0, atA = values(0, 0, 0), atB = interpolated(values, way);
  if ((atA < 0.0) == (atB < 0.0))
  {
    return false;
  }
  share = 1.0;
  for (int i = 0; i < Most && atB != 0.0; ++i)
  {
    const double next = b - (b - a) * (atB / (atB - atA));
    const double there = interpolated(values, next * way);
    const bool close = std::abs(next - share) < Close;
    share = next;
    if (close)
    {
      break;
    }
    if ((there < 0.0) != (atB < 0.0))
    {
      a = b;
      atA = atB;
    }
    else
    {
      atA *= 0.5;
    }
    b = next;
    atB = there;
  }
  return true;
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

/// In each of its octants the field is trilinear, so that its extremes lie at the corners of the
/// octants: means of two, four and eight values.
bool VoxelValues::passed() const
{
  double half[Count];
  std::copy(this->at, this->at + Count, half);
  for (const int step : { 1, 3, 9 })
  {
    for (int i = 0; i < Count; ++i)
    {
      if (i / step % 3 == 1)
      {
        half[i - step] = 0.5 * (half[i - step] + half[i]);
        half[i + step] = 0.5 * (half[i] + half[i + step]);
      }
    }
  }
  double low = half[0], high = half[0];
  bool finite = true;
  for (int i = 0; i < Count; ++i)
  {
    finite = finite && std::isfinite(this->at[i]);
    low = std::min(low, half[i]);
    high = std::max(high, half[i]);
  }
  return finite && low <= 0.0 && high >= 0.0 && low < high;
}

bool levelSetPlane(const VoxelValues& values, SourcePlane& plane)
{
  if (!values.passed())
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
  // Where the field bends, its plane need not pass. A trifle inside, or the plane's last digit
  // could take it out of the octree.
  constexpr double Inside = 2e-3;
  const double reach = 0.5 * (size.x + size.y + size.z) / length - Inside;
  const double side = values(0, 0, 0) < 0.0 ? reach : -reach;
  double share = 0.0;
  plane.offset = findZero(values, side * plane.normal, share)
    ? share * side
    : std::clamp(plane.offset, -reach, reach);
  return std::isfinite(plane.offset);
}
}
