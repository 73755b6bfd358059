#include "svoFieldSource.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace svo
{
namespace
{
constexpr double Sqrt3 = 1.7320508075688773;
constexpr double Rounding = 1.0 + 1e-9; // touching counts

bool usableGradient(const glm::dvec3& g)
{
  const double square = glm::dot(g, g);
  return square > 0.0 && std::isfinite(square);
}

/// Whether a gradient is about what differences of values say. Not closer: they are those of a
/// step, and some functions have smoother gradients than their own on purpose.
bool agree(const glm::dvec3& gradient, const glm::dvec3& differences)
{
  constexpr double Most = 0.35; // 20 degrees
  const glm::dvec3 apart = gradient - differences;
  return glm::dot(apart, apart) <= Most * Most * glm::dot(differences, differences);
}
}

/// Values at the corners of a cube, less the surface's.
struct FieldSource::Samples
{
  double corners[8];
  double low = std::numeric_limits<double>::infinity(); // of those that are finite
  double high = -std::numeric_limits<double>::infinity();

  bool any() const { return low <= high; }
  /// False where all are the surface's value: such a field has no surface, it is one.
  bool crosses() const { return low <= 0.0 && high >= 0.0 && low < high; }
  /// As if the field were linear; of any length. NaN if a corner has no value.
  glm::dvec3 gradient() const
  {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 8; ++i)
    {
      sum += corners[i] * glm::dvec3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
    }
    return sum;
  }
};

FieldSource::Samples FieldSource::sample(const glm::dvec3& centre, double half) const
{
  Samples s;
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec3 corner(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
    s.corners[i] = this->Field.value(centre + corner) - this->Options.value;
    if (std::isfinite(s.corners[i]))
    {
      s.low = std::min(s.low, s.corners[i]);
      s.high = std::max(s.high, s.corners[i]);
    }
  }
  return s;
}

bool FieldSource::tooFar(double value, double half) const
{
  const double bound = this->Options.gradientBound;
  return bound > 0.0 && std::abs(value) > bound * Sqrt3 * half * Rounding;
}

bool FieldSource::mayPass(const glm::dvec3& centre, double half) const
{
  const bool large = half > this->Options.coarsest;
  if (large && !(this->Options.gradientBound > 0.0))
  {
    return true;
  }
  const double middle = this->Field.value(centre) - this->Options.value;
  const bool finite = std::isfinite(middle);
  if (this->Options.gradientBound > 0.0 && finite && middle != 0.0)
  {
    return !this->tooFar(middle, half);
  }
  if (large)
  {
    return true; // of large cubes nine samples say little
  }
  const Samples s = this->sample(centre, half);
  if (!s.any() || s.crosses() || !finite)
  {
    return s.any();
  }
  // Where all are the same there is no surface, whatever the value.
  const double most = std::max(std::abs(s.low - middle), std::abs(s.high - middle));
  return std::abs(middle) <= 2.0 * most && most > 0.0;
}

/// VTK's own vtkImplicitBoolean has wrong ones (9.1), and not only by their sign. A short step
/// tells right ones for three values more, edges close by or not. Where it does not, rounding may
/// be to blame: then a wider one decides.
glm::dvec3 FieldSource::gradientAt(const glm::dvec3& at, double value, double half) const
{
  constexpr double Short = 0.01, Wide = 0.25; // of half a voxel
  const glm::dvec3 given = this->Field.gradient(at);
  if (!this->Options.gradientsAreChecked)
  {
    return given;
  }
  const auto valueAside = [&](int axis, double step)
  {
    glm::dvec3 aside = at;
    aside[axis] += step;
    return this->Field.value(aside);
  };
  glm::dvec3 differences;
  for (int i = 0; i < 3; ++i)
  {
    differences[i] = (valueAside(i, Short * half) - value) / (Short * half);
  }
  if (agree(given, differences))
  {
    return given;
  }
  // At an edge the slopes ahead and behind are different ones; those of either face lie between.
  glm::dvec3 between;
  for (int i = 0; i < 3; ++i)
  {
    const double ahead = (valueAside(i, Wide * half) - value) / (Wide * half);
    const double behind = (value - valueAside(i, -Wide * half)) / (Wide * half);
    differences[i] = 0.5 * (ahead + behind);
    between[i] = std::clamp(given[i], std::min(ahead, behind), std::max(ahead, behind));
  }
  return agree(given, between) || !usableGradient(differences) ? given : differences;
}

bool FieldSource::planeIn(const glm::dvec3& centre, double half, SourcePlane& plane) const
{
  const double value = this->Field.value(centre), middle = value - this->Options.value;
  if (!std::isfinite(middle) || this->tooFar(middle, half))
  {
    return false;
  }
  glm::dvec3 gradient = this->gradientAt(centre, value, half);
  if (!usableGradient(gradient))
  {
    gradient = this->sample(centre, half).gradient() / (8.0 * half);
    if (!usableGradient(gradient))
    {
      return false;
    }
  }
  const double square = glm::dot(gradient, gradient);
  plane.normal = gradient / std::sqrt(square);
  plane.offset = -middle / std::sqrt(square);
  // The foot, if it is near enough to be one, and if the field is flat enough there.
  bool settled = false;
  if (std::abs(plane.offset) <= 2.0 * Sqrt3 * half)
  {
    const glm::dvec3 step = plane.offset * plane.normal;
    const double foot = this->Field.value(centre + step), rest = foot - this->Options.value;
    settled = std::abs(rest) <= 0.5 * std::abs(middle);
    const glm::dvec3 there = settled ? this->gradientAt(centre + step, foot, half) : gradient;
    // Beyond an edge the foot has the plane of the other side, which is not there.
    constexpr double SameSide = 0.7;
    const double length = glm::length(there);
    if (settled && usableGradient(there) && glm::dot(there, plane.normal) > SameSide * length)
    {
      plane.normal = there / length;
      plane.offset = glm::dot(plane.normal, step) - rest / length;
    }
  }
  const glm::dvec3 n = glm::abs(plane.normal);
  const bool passes = settled && std::abs(plane.offset) <= half * (n.x + n.y + n.z) * Rounding;
  return passes || this->sample(centre, half).crosses();
}
}
