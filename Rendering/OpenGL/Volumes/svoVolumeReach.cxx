#include "svoVolumeReach.h"

#include "svoBox.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
namespace
{
/// Boxes are wider by so much of themselves, and of the cube; volumes longer by as much.
constexpr double Margin = 0.01;

/// True if the way from one homogeneous point to another, of which at most one may be at infinity,
/// meets a box. Two that are: whether they are almost the same but for their sign.
bool meets(const Box& box, const glm::dvec4& from, const glm::dvec4& to)
{
  if (from.w == 0.0 && to.w == 0.0)
  {
    const glm::dvec3 a(from), b(to);
    return glm::dot(a, b) < -0.9999 * glm::length(a) * glm::length(b);
  }
  const glm::dvec3 start(from.w != 0.0 ? from : to);
  const glm::dvec3 way = from.w == 0.0 ? glm::dvec3(from)
    : to.w == 0.0                      ? glm::dvec3(to)
                                       : glm::dvec3(to) - start;
  double first = 0.0, last = from.w != 0.0 && to.w != 0.0 ? 1.0 : 1e300;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = box.low[axis] - start[axis], high = box.high[axis] - start[axis];
    if (way[axis] == 0.0)
    {
      last = low > 0.0 || high < 0.0 ? -1.0 : last;
      continue;
    }
    first = std::max(first, std::min(low / way[axis], high / way[axis]));
    last = std::min(last, std::max(low / way[axis], high / way[axis]));
  }
  return first <= last;
}
}

glm::dvec4 placeOf(const Light& light, const WorldToOctree& to)
{
  return light.atInfinity() ? glm::dvec4(to.vector(-light.direction), 0.0)
                            : glm::dvec4(to.point(light.position), 1.0);
}

VolumeReach::VolumeReach(const std::vector<Outline>& outlines,
  const std::vector<std::uint8_t>& casters, const Light& light, const View& view,
  const FrameSettings& settings)
  : Outlines(outlines)
  , Of(light)
  , Eye(view)
  , Last(Endless)
{
  if (settings.wholeShadowBuffers) // some receivers may be drawn beside their boxes
  {
    return;
  }
  const SeenDepths& seen = this->Seen.emplace(outlines, casters, light, view);
  // Parallel rays that come from behind the ends have no eye to be reached.
  if (light.atInfinity() && !(view.parallel && glm::dot(light.direction, view.axis) < 0.0))
  {
    this->Last =
      view.parallel ? seen.last() : std::max(seen.last(), glm::dot(light.direction, view.eye));
  }
  if (!settings.occlusionCulling)
  {
    this->Seen.reset();
  }
}

bool VolumeReach::find(std::size_t instance, double& end) const
{
  end = Endless;
  if (this->Seen && !this->Seen->behind(this->Outlines[instance]))
  {
    return false;
  }
  if (this->Last < Endless)
  {
    const double eye = glm::dot(this->Of.direction, this->Eye.eye);
    double first = Endless, last = -Endless;
    const auto corners = worldCorners(this->Outlines[instance], 0.0);
    for (const glm::dvec3& corner : corners)
    {
      first = std::min(first, glm::dot(this->Of.direction, corner));
      last = std::max(last, glm::dot(this->Of.direction, corner));
    }
    last = std::max(last, this->Last);
    end =
      last + Margin * std::max(glm::distance(corners.front(), corners.back()), last - first) - eye;
  }
  return true;
}

VolumeDraws::Sides VolumeReach::way(const CasterInMemory& caster) const
{
  const WorldToOctree& to = caster.toOctree;
  const glm::dvec3 margin = Margin * (0.1 + caster.box.high - caster.box.low);
  const Box wide{ caster.box.low - margin, caster.box.high + margin };
  const glm::dvec4 eye = this->Eye.parallel ? glm::dvec4(to.vector(-this->Eye.axis), 0.0)
                                            : glm::dvec4(to.point(this->Eye.eye), 1.0);
  return meets(wide, eye, placeOf(this->Of, to)) ? VolumeDraws::Behind : VolumeDraws::Before;
}
}
