#include "svoSeenReceivers.h"

#include "svoShadowRules.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace svo
{
namespace
{
/// Of a box, in its diagonals.
constexpr double WiderBy = 0.1;
/// Texels around a point that are looked up: half of the widest filter's window, and the next ones.
constexpr double Reach = 0.5 * WidestBox + 3.0;
}

SeenReceivers::SeenReceivers(const std::vector<Box>& receivers, const View& eye)
{
  if (eye.width < 1 || eye.height < 1)
  {
    return;
  }
  this->Eye = pieceOf(eye, eye.tNear, eye.tFar);
  const CommonPart seen({ this->Eye });
  for (const Box& box : receivers)
  {
    const glm::dvec3 wider(WiderBy * glm::length(box.high - box.low));
    const glm::dvec3 low = box.low - wider, high = box.high + wider;
    Part part;
    for (int i = 0; i < 8; ++i)
    {
      part.box[i] = { i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z };
    }
    seen.add(part.box, part.points);
    if (!part.points.empty())
    {
      this->Parts.push_back(std::move(part));
    }
  }
}

std::vector<PixelRect> SeenReceivers::in(const View& map) const
{
  std::vector<PixelRect> rects;
  const glm::dmat4 toClip = map.viewToClip * map.worldToView;
  const glm::dvec2 size(map.width, map.height);
  std::vector<glm::dvec3> cut;
  for (const Part& part : this->Parts)
  {
    const auto isBehind = [&](const glm::dvec3& point)
    { return !((toClip * glm::dvec4(point, 1.0)).w > 0.0); };
    const std::vector<glm::dvec3>* points = &part.points;
    if (std::any_of(points->begin(), points->end(), isBehind))
    {
      cut.clear();
      CommonPart({ this->Eye, pieceOf(map, map.tNear, map.tFar) }).add(part.box, cut);
      points = &cut;
    }
    constexpr double Infinity = std::numeric_limits<double>::infinity();
    glm::dvec2 low(Infinity), high(-Infinity);
    for (const glm::dvec3& point : *points)
    {
      const glm::dvec4 clip = toClip * glm::dvec4(point, 1.0);
      low = glm::min(low, glm::dvec2(clip) / clip.w);
      high = glm::max(high, glm::dvec2(clip) / clip.w);
    }
    const auto texel = [](double at, int texels)
    { return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(texels))); };
    const glm::dvec2 first = (0.5 * low + 0.5) * size - Reach;
    const glm::dvec2 last = (0.5 * high + 0.5) * size + (Reach + 1.0);
    const PixelRect rect{ texel(first.x, map.width), texel(first.y, map.height),
      texel(last.x, map.width), texel(last.y, map.height) };
    if (!points->empty() && !rect.empty())
    {
      rects.push_back(rect);
    }
  }
  return rects;
}
}
