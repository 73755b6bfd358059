#include "svoTranslucentGroups.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace svo
{
namespace
{
/// More casters are not compared with each other: it takes the square of their number.
constexpr std::size_t MostCompared = 512;
/// Texels that filters look beyond a shadow's edge.
constexpr double GroupReach = 6.0;

/// Where a caster is in a view, in clip space.
struct Place
{
  glm::dvec2 low{ std::numeric_limits<double>::infinity() };
  glm::dvec2 high{ -std::numeric_limits<double>::infinity() };
  bool meets(const Place& o) const
  {
    return low.x <= o.high.x && low.y <= o.high.y && high.x >= o.low.x && high.y >= o.low.y;
  }
};

Place placeOf(const Outline& outline, const View& view, const glm::dmat4& toClip)
{
  Place place;
  for (const glm::dvec3& corner : worldCorners(outline, outline.voxelSize))
  {
    const glm::dvec4 clip = toClip * glm::dvec4(corner, 1.0);
    if (!(clip.w > 0.0))
    {
      constexpr double Infinity = std::numeric_limits<double>::infinity();
      return { glm::dvec2(-Infinity), glm::dvec2(Infinity) };
    }
    place.low = glm::min(place.low, glm::dvec2(clip) / clip.w);
    place.high = glm::max(place.high, glm::dvec2(clip) / clip.w);
  }
  const glm::dvec2 reach = GroupReach / glm::dvec2(view.width, view.height);
  return { place.low - reach, place.high + reach };
}
}

int groupTranslucent(const std::vector<Outline>& outlines, const std::vector<View>& views,
  std::vector<std::uint8_t>& casters)
{
  std::vector<std::size_t> translucent;
  for (std::size_t i = 0; i < casters.size(); ++i)
  {
    if (casters[i] && outlines[i].translucent)
    {
      translucent.push_back(i);
    }
  }
  const bool compare = views.size() == 1 && translucent.size() <= MostCompared;
  const glm::dmat4 toClip =
    compare ? views.front().viewToClip * views.front().worldToView : glm::dmat4(1.0);
  std::vector<Place> groups[MostTranslucentGroups];
  int used = 0;
  for (std::size_t k = 0; k < translucent.size(); ++k)
  {
    const std::size_t i = translucent[k];
    int group = static_cast<int>(k % MostTranslucentGroups);
    if (compare)
    {
      const Place place = placeOf(outlines[i], views.front(), toClip);
      const auto isFree = [&](const std::vector<Place>& others)
      {
        return std::none_of(
          others.begin(), others.end(), [&](const Place& other) { return place.meets(other); });
      };
      const auto* free = std::find_if(std::begin(groups), std::end(groups), isFree);
      group = free != std::end(groups) ? static_cast<int>(free - groups) : group;
      groups[group].push_back(place);
    }
    casters[i] = static_cast<std::uint8_t>(OpaqueCasters + 1 + group);
    used = std::max(used, group + 1);
  }
  return used;
}
}
