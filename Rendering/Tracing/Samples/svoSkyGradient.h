// A sky of two colours, between which it goes by the cosine to where it is overhead.
#ifndef svoSkyGradient_h
#define svoSkyGradient_h

#include "svoFrame.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
class SkyGradient
{
public:
  explicit SkyGradient(const FrameSettings& settings)
    : Mean(0.5 * settings.skyStrength * (settings.skyColor + settings.groundColor))
    , Rise(0.5 * settings.skyStrength * (settings.skyColor - settings.groundColor))
  {
    const double length = glm::length(settings.skyUp);
    this->Up = length > 0.0 ? glm::vec3(settings.skyUp / length) : glm::vec3(0.0f);
  }

  /// What comes from a direction (unit, towards the sky), pi times its radiance: a white surface
  /// under nothing else is of that colour.
  glm::vec3 from(const glm::vec3& direction) const
  {
    return this->Mean + glm::dot(direction, this->Up) * this->Rise;
  }
  /// What arrives on an open plane (unit normal): the mean of the above by the cosine.
  glm::vec3 over(const glm::vec3& normal) const
  {
    return this->Mean + (2.0f / 3.0f) * glm::dot(normal, this->Up) * this->Rise;
  }
  /// No more comes from anywhere.
  glm::vec3 brightest() const { return this->Mean + glm::abs(this->Rise); }

  const glm::vec3& mean() const { return this->Mean; }
  const glm::vec3& rise() const { return this->Rise; } // from the mean to what is overhead
  const glm::vec3& up() const { return this->Up; }     // unit, or 0

private:
  glm::vec3 Mean, Rise, Up;
};
}

#endif
