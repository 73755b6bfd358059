// Where in a map a point looks for what hides a part of a light with a size.
#ifndef svoLightReach_h
#define svoLightReach_h

#include "svoLight.h"
#include "svoOutline.h"

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// Of a light without a size it is the point's own place.
class LightReach
{
public:
  LightReach() = default;
  /// `casters` as from castersOf().
  LightReach(const Light& light, const std::vector<Outline>& outlines,
    const std::vector<std::uint8_t>& casters);

  bool wide() const { return this->Source.soft(); }
  /// ShadowMap::nearest.
  double nearest() const { return this->Nearest; }
  /// Adds to a rectangle of a map, clip space, what a point looks up there; infinite if that is not
  /// known.
  void add(const glm::dmat4& worldToClip, const glm::dvec3& point, glm::dvec2& low,
    glm::dvec2& high) const;

private:
  Light Source;
  double Nearest = 0.0;
};
}

#endif
