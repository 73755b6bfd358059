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

/// -1 where values fall along what is said to be the gradient, as in vtkImplicitBoolean's
/// differences; else 1. Near the point, so that edges do not matter.
double signOfGradient(const ScalarField& field, const glm::dvec3& at, double half, double value,
  const glm::dvec3& gradient)
{
  const double length = glm::length(gradient);
  constexpr double Near = 0.01; // of half a voxel
  return field.value(at + Near * half / length * gradient) < value ? -1.0 : 1.0;
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

bool FieldSource::planeIn(const glm::dvec3& centre, double half, SourcePlane& plane) const
{
  const double value = this->Field.value(centre), middle = value - this->Options.value;
  if (!std::isfinite(middle) || this->tooFar(middle, half))
  {
    return false;
  }
  glm::dvec3 gradient = this->Field.gradient(centre);
  double sign = 1.0;
  if (usableGradient(gradient))
  {
    sign = signOfGradient(this->Field, centre, half, value, gradient);
    gradient *= sign;
  }
  else
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
    const double rest = this->Field.value(centre + step) - this->Options.value;
    settled = std::abs(rest) <= 0.5 * std::abs(middle);
    const glm::dvec3 there = settled ? sign * this->Field.gradient(centre + step) : gradient;
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
