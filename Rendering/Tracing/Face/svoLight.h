// A light, as VTK's shaders see it.
#ifndef svoLight_h
#define svoLight_h

#include <cmath>
#include <cstdint>
#include <tuple>

#include <glm/vec3.hpp>

namespace svo
{
struct Light
{
  enum class Kind
  {
    Directional,
    Point, // positional, cone of 90 degrees half angle or more: all directions
    Spot
  };
  Kind kind = Kind::Directional;
  bool headlight = false;           // at the eye, along the view axis
  glm::dvec3 position{ 0.0 };       // world
  glm::dvec3 direction{ 0, 0, -1 }; // world, unit, the way the light shines
  double coneAngle = 90.0;          // half angle, degrees
  double exponent = 1.0;            // of the spot's fall-off
  glm::vec3 attenuation{ 1, 0, 0 }; // constant, linear, quadratic
  glm::vec3 color{ 1.0f };          // diffuse colour times intensity
  bool castShadow = true;
  /// How large it is: of one with a position the radius of a ball, world units; of one at infinity
  /// the angle that its disc subtends, degrees. 0: a point, whose shadows have sharp edges.
  double size = 0.0;
  std::uint64_t id = 0; // stable from frame to frame

  bool atInfinity() const { return this->kind == Kind::Directional; }
  bool soft() const { return this->size > 0.0; }
  /// Of its ball, world; 0 at infinity.
  double radius() const { return this->atInfinity() ? 0.0 : this->size; }
  /// How much wider the way to all of its disc gets for each unit of length; 0 of others.
  double spread() const
  {
    constexpr double HalfDegree = 0.5 * 3.14159265358979323846 / 180.0;
    return this->atInfinity() && this->soft() ? std::tan(this->size * HalfDegree) : 0.0;
  }
  bool hasCone() const { return this->kind == Kind::Spot; }
  /// The way to `x`, world, that the light's ray goes; unit only from infinity.
  glm::dvec3 along(const glm::dvec3& x) const
  {
    return this->atInfinity() ? this->direction : x - this->position;
  }
  /// How many times that way rays to the light go: what it lies on is not between.
  double rayEnd() const { return this->atInfinity() ? 1e300 : 1.0 - 1e-9; }
};

/// All that a light is.
inline auto valuesOf(const Light& l)
{
  static_assert(sizeof(Light) == 120, "who adds a member adds it here");
  return std::tie(l.kind, l.headlight, l.position, l.direction, l.coneAngle, l.exponent,
    l.attenuation, l.color, l.castShadow, l.size, l.id);
}
}

#endif
