// The sky of a frame: a picture, or two colours between which it goes by the cosine to where it is
// overhead.
#ifndef svoSky_h
#define svoSky_h

#include "svoFrame.h"
#include "svoSkyPicture.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
class Sky
{
public:
  explicit Sky(const FrameSettings& settings)
    : Picture(settings.skyPicture.get())
    , Strength(static_cast<float>(settings.skyStrength))
    , Mean(0.5 * settings.skyStrength * (settings.skyColor + settings.groundColor))
    , Rise(0.5 * settings.skyStrength * (settings.skyColor - settings.groundColor))
  {
    const double length = glm::length(settings.skyUp);
    this->Up = length > 0.0 ? glm::vec3(settings.skyUp / length) : glm::vec3(0.0f);
  }

  /// Null: it has two colours.
  const SkyPicture* picture() const { return this->Picture; }

  /// What a sample of a direction (unit, towards the sky) counts, of brightest(). The mean over
  /// samples is what arrives on a plane (unit normal), pi times its radiance: a white surface under
  /// nothing else is of that colour.
  glm::vec3 share(const glm::vec3& direction, const glm::vec3& normal) const
  {
    return this->Picture ? this->Picture->share(direction, normal)
                         : (this->Mean + glm::dot(direction, this->Up) * this->Rise) /
        glm::max(this->brightest(), 1e-30f);
  }
  /// What arrives on an open plane.
  glm::vec3 over(const glm::vec3& normal) const
  {
    return this->Picture ? this->Strength * this->Picture->over(normal)
                         : this->Mean + (2.0f / 3.0f) * glm::dot(normal, this->Up) * this->Rise;
  }
  /// No sample counts for more.
  glm::vec3 brightest() const
  {
    return this->Picture ? glm::vec3(this->Strength * this->Picture->brightest())
                         : this->Mean + glm::abs(this->Rise);
  }
  float strength() const { return this->Strength; }

  // Of two colours:
  const glm::vec3& mean() const { return this->Mean; }
  const glm::vec3& rise() const { return this->Rise; } // from the mean to what is overhead
  const glm::vec3& up() const { return this->Up; }     // unit, or 0

private:
  const SkyPicture* Picture;
  float Strength;
  glm::vec3 Mean, Rise, Up;
};
}

#endif
