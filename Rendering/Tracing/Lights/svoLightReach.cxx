#include "svoLightReach.h"

#include "svoBox.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace svo
{
LightReach::LightReach(const Light& light, const std::vector<Outline>& outlines,
  const std::vector<std::uint8_t>& casters)
  : Source(light)
{
  if (!light.soft())
  {
    return;
  }
  this->Nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < casters.size(); ++i)
  {
    if (casters[i])
    {
      Box box;
      for (const glm::dvec3& corner : worldCorners(outlines[i], outlines[i].voxelSize))
      {
        box.add(light.atInfinity() ? glm::dvec3(glm::dot(light.direction, corner)) : corner);
      }
      const glm::dvec3 closest = glm::clamp(light.position, box.low, box.high);
      this->Nearest = std::min(
        this->Nearest, light.atInfinity() ? box.low.x : glm::distance(light.position, closest));
    }
  }
}

void LightReach::add(
  const glm::dmat4& worldToClip, const glm::dvec3& point, glm::dvec2& low, glm::dvec2& high) const
{
  // All rays to the light, as far as something casts, lie in a cone; the map sees it from its tip
  // to its end, here in a box.
  glm::dvec3 end = point;
  double radius = 0.0;
  if (this->wide() && this->Source.atInfinity())
  {
    const double length = std::max(glm::dot(this->Source.direction, point) - this->Nearest, 0.0);
    end -= length * this->Source.direction;
    radius = length * this->Source.spread();
  }
  else if (this->wide())
  {
    const glm::dvec3 from = point - this->Source.position;
    const double distance = glm::length(from), r = this->Source.radius();
    const double part = std::max(this->Nearest, r) / distance; // of the way, from the light on
    if (part < 1.0)
    {
      end = this->Source.position + part * from;
      radius = (1.0 - part) * r / std::sqrt(1.0 - r * r / (distance * distance));
    }
  }
  for (int i = 0; i < (radius > 0.0 ? 8 : 1); ++i)
  {
    const glm::dvec4 clip = worldToClip *
      glm::dvec4(end + radius * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1), 1.0);
    constexpr double Infinity = std::numeric_limits<double>::infinity();
    low = clip.w > 0.0 ? glm::min(low, glm::dvec2(clip) / clip.w) : glm::dvec2(-Infinity);
    high = clip.w > 0.0 ? glm::max(high, glm::dvec2(clip) / clip.w) : glm::dvec2(Infinity);
  }
}
}
