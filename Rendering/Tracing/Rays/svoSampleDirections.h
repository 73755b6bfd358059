// From samples of a square to directions: over a hemisphere by the cosine, over a light's ball or
// disc. In single precision, with the same bits everywhere.
#ifndef svoSampleDirections_h
#define svoSampleDirections_h

#include "svoLight.h"
#include "svoSampleSequence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// Uniform over the unit disc, without tearing neighbours of the square apart: P. Shirley, K. Chiu,
/// "A Low Distortion Map Between Disk and Square", 1997.
inline glm::vec2 discPoint(const SquarePoint& sample)
{
  const glm::vec2 p = 2.0f * sample.position() - 1.0f;
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const float radius = wide ? p.x : p.y, across = wide ? p.y : p.x;
  if (radius == 0.0f)
  {
    return glm::vec2(0.0f);
  }
  // Sine and cosine of up to 45 degrees, to 3e-7.
  const float angle = 0.785398163f * (across / radius), square = angle * angle;
  const float sine =
    angle * (1.0f + square * (-1.0f / 6 + square * (1.0f / 120 - square * (1.0f / 5040))));
  const float cosine =
    1.0f + square * (-0.5f + square * (1.0f / 24 + square * (-1.0f / 720 + square / 40320)));
  return radius * (wide ? glm::vec2(cosine, sine) : glm::vec2(sine, cosine));
}

/// Two directions across a unit one: Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
struct Basis
{
  glm::vec3 x, y, z;

  explicit Basis(const glm::vec3& axis)
    : z(axis)
  {
    // What rounding makes of the normals of upright surfaces does not turn them round.
    const float sign = axis.z < -1e-4f ? -1.0f : 1.0f;
    const float a = -1.0f / (sign + axis.z), b = axis.x * axis.y * a;
    this->x = { 1.0f + sign * axis.x * axis.x * a, sign * b, -sign * axis.x };
    this->y = { b, sign + axis.y * axis.y * a, -axis.y };
  }
  glm::vec3 toWorld(float alongX, float alongY, float alongZ) const
  {
    return alongX * this->x + alongY * this->y + alongZ * this->z;
  }
};

/// Over the hemisphere about the z of a basis, each direction as often as its cosine.
inline glm::vec3 cosineDirection(const Basis& basis, const SquarePoint& sample)
{
  const glm::vec2 disc = discPoint(sample);
  return basis.toWorld(disc.x, disc.y, std::sqrt(std::max(0.0f, 1.0f - glm::dot(disc, disc))));
}

/// A light's ball or disc as a point sees it. Directions are uniform over it: of a ball by solid
/// angle, of a disc at infinity by its area.
class LightCone
{
public:
  /// `point`: world.
  LightCone(const Light& light, const glm::dvec3& point)
    : Axis(glm::vec3(0, 0, 1))
    , Far(light.atInfinity())
  {
    const glm::dvec3 towards = -light.along(point);
    const double distance = glm::length(towards);
    this->Axis =
      Basis(distance > 0.0 ? glm::vec3(towards / distance) : -glm::vec3(light.direction));
    this->Distance = static_cast<float>(distance);
    // In the ball light comes from all of the hemisphere.
    const double sine = this->Far ? 0.0 : std::min(light.size / distance, 1.0);
    this->Sine2 = static_cast<float>(sine * sine);
    this->Width = static_cast<float>(
      this->Far ? light.spread() : sine * sine / (1.0 + std::sqrt(1.0 - sine * sine)));
  }

  /// Unit. `length`: how far the light is that way; infinite of one at infinity.
  glm::vec3 direction(const SquarePoint& sample, float& length) const
  {
    const glm::vec2 disc = discPoint(sample);
    if (this->Far)
    {
      length = std::numeric_limits<float>::infinity();
      return glm::normalize(this->Axis.toWorld(this->Width * disc.x, this->Width * disc.y, 1.0f));
    }
    // 1 - cosine grows with the area of the disc.
    const float fallen = this->Width * glm::dot(disc, disc), cosine = 1.0f - fallen;
    const float across = std::sqrt(this->Width * (2.0f - fallen));
    // To the ball's near side.
    const float sine2 = fallen * (2.0f - fallen);
    length = this->Distance * (cosine - std::sqrt(std::max(0.0f, this->Sine2 - sine2)));
    return this->Axis.toWorld(across * disc.x, across * disc.y, cosine);
  }

private:
  Basis Axis;
  bool Far;
  float Distance = 0.0f, Width = 0.0f, Sine2 = 0.0f;
};
}

#endif
