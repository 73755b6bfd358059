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

/// Where something begins along a light, and ends; world.
struct Span
{
  double first = VolumeReach::Endless, last = -VolumeReach::Endless;
  double size = 0.0; // of the largest part

  void add(double along)
  {
    this->first = std::min(this->first, along);
    this->last = std::max(this->last, along);
  }
  void add(const Outline& outline, const Light& light)
  {
    const auto corners = worldCorners(outline, 0.0);
    for (const glm::dvec3& corner : corners)
    {
      this->add(glm::dot(light.direction, corner));
    }
    this->size = std::max(this->size, glm::distance(corners.front(), corners.back()));
  }
  /// A little behind all of it.
  double end() const
  {
    return this->last + Margin * std::max(this->size, this->last - this->first);
  }
};

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

VolumeReach::VolumeReach(
  const std::vector<Outline>& outlines, const Light& light, const View& view, bool endless)
  : Outlines(outlines)
  , Of(light)
  , Eye(view)
  , Last(Endless)
{
  // Parallel rays that come from behind the ends have no eye to be reached.
  if (endless || !light.atInfinity() ||
    (view.parallel && glm::dot(light.direction, view.axis) < 0.0))
  {
    return;
  }
  Span span;
  for (const Outline& outline : outlines)
  {
    if (outline.receives)
    {
      span.add(outline, light);
    }
  }
  if (!view.parallel)
  {
    span.add(glm::dot(light.direction, view.eye));
  }
  this->Last = span.end();
}

bool VolumeReach::find(std::size_t instance, double& end) const
{
  end = Endless;
  if (this->Last == Endless)
  {
    return true;
  }
  Span span;
  span.add(this->Outlines[instance], this->Of);
  end = std::max(this->Last, span.end()) - glm::dot(this->Of.direction, this->Eye.eye);
  return span.first <= this->Last;
}

VolumeDraws::Way VolumeReach::way(const CasterInMemory& caster) const
{
  const WorldToOctree& to = caster.toOctree;
  const glm::dvec3 margin = Margin * (0.1 + caster.box.high - caster.box.low);
  const Box wide{ caster.box.low - margin, caster.box.high + margin };
  const glm::dvec4 eye = this->Eye.parallel ? glm::dvec4(to.vector(-this->Eye.axis), 0.0)
                                            : glm::dvec4(to.point(this->Eye.eye), 1.0);
  return meets(wide, eye, placeOf(this->Of, to)) ? VolumeDraws::Behind : VolumeDraws::Before;
}
}
