#include "svoSeenDepths.h"

#include "svoLightView.h"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace svo
{
namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();
/// Bodies are larger by so much of themselves.
constexpr double Margin = 0.01;

ConvexBody bodyOf(const Outline& outline)
{
  ConvexBody body = worldCorners(outline, 0.0);
  const glm::dvec3 middle = 0.5 * (body.front() + body.back());
  for (glm::dvec3& corner : body)
  {
    corner += Margin * (corner - middle);
  }
  return body;
}

double depthOf(const View& view, const glm::dvec3& point)
{
  return glm::dot(view.axis, point - view.eye);
}
}

/// Where points lie in a view: its tiles, and their depths.
struct SeenDepths::Footprint
{
  PixelRect tiles{ Tiles, Tiles, 0, 0 };
  double first = Infinity, last = -Infinity;
};

SeenDepths::Footprint SeenDepths::footprintOf(
  const LightView& seen, const std::vector<glm::dvec3>& points)
{
  constexpr double Rounding = 1e-6; // tiles
  const glm::dmat4 toClip = seen.view.viewToClip * seen.view.worldToView;
  Footprint print;
  for (const glm::dvec3& point : points)
  {
    const double depth = depthOf(seen.view, point);
    print.first = std::min(print.first, depth);
    print.last = std::max(print.last, depth);
    const glm::dvec4 clip = toClip * glm::dvec4(point, 1.0);
    if (!(clip.w > 0.0)) // at the light
    {
      print.tiles = { 0, 0, Tiles, Tiles };
      continue;
    }
    const glm::dvec2 at = (0.5 * glm::dvec2(clip) / clip.w + 0.5) * static_cast<double>(Tiles);
    const glm::ivec2 low(glm::clamp(at - Rounding, 0.0, Tiles - 1.0));
    const glm::ivec2 high(glm::clamp(at + Rounding, 0.0, Tiles - 1.0));
    print.tiles = { std::min(print.tiles.x0, low.x), std::min(print.tiles.y0, low.y),
      std::max(print.tiles.x1, high.x + 1), std::max(print.tiles.y1, high.y + 1) };
  }
  return print;
}

SeenDepths::SeenDepths(const std::vector<Outline>& outlines,
  const std::vector<std::uint8_t>& casters, const Light& light, const View& eye)
  : Last(-Infinity)
{
  const std::vector<View> views = fitLight(outlines, casters, light, Tiles);
  std::vector<double> farthest; // of each
  farthest.reserve(views.size());
  for (const View& view : views)
  {
    farthest.push_back(view.tFar);
  }
  double deepest = eye.tNear; // that the eye may see
  std::vector<ConvexBody> receivers;
  for (const Outline& outline : outlines)
  {
    const ConvexBody body = bodyOf(outline);
    for (const glm::dvec3& corner : body)
    {
      deepest = std::max(deepest, depthOf(eye, corner));
      for (std::size_t i = 0; i < views.size(); ++i)
      {
        farthest[i] = std::max(farthest[i], depthOf(views[i], corner));
      }
    }
    if (outline.receives)
    {
      receivers.push_back(body);
    }
  }
  if (!(deepest < Infinity))
  {
    this->Last = Infinity;
    return;
  }
  const ConvexBody seen = pieceOf(eye, eye.tNear, std::min(eye.tFar, deepest));
  std::vector<glm::dvec3> points;
  const CommonPart ofEye({ seen });
  const auto hidden = [&](const ConvexBody& body)
  {
    points.clear();
    ofEye.add(body, points);
    for (const glm::dvec3& point : points)
    {
      this->Last = std::max(this->Last, glm::dot(light.direction, point));
    }
    return points.empty();
  };
  receivers.erase(std::remove_if(receivers.begin(), receivers.end(), hidden), receivers.end());
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    const ConvexBody piece =
      pieceOf(views[i], views[i].parallel ? views[i].tNear : 0.0, farthest[i]);
    this->Views.push_back(
      { views[i], CommonPart({ piece }), std::vector<double>(Tiles * Tiles, -Infinity) });
    LightView& one = this->Views.back();
    const CommonPart common({ seen, piece });
    for (const ConvexBody& body : receivers)
    {
      points.clear();
      common.add(body, points);
      const Footprint print = footprintOf(one, points);
      for (int y = print.tiles.y0; y < print.tiles.y1; ++y)
      {
        for (int x = print.tiles.x0; x < print.tiles.x1; ++x)
        {
          double& depth = one.depths[y * Tiles + x];
          depth = std::max(depth, print.last);
        }
      }
    }
  }
}

bool SeenDepths::behind(const Outline& caster) const
{
  const ConvexBody body = bodyOf(caster);
  std::vector<glm::dvec3> points;
  return this->Views.empty() ||
    std::any_of(this->Views.begin(), this->Views.end(),
      [&](const LightView& seen)
      {
        points.clear();
        seen.piece.add(body, points);
        const Footprint print = footprintOf(seen, points);
        for (int y = print.tiles.y0; y < print.tiles.y1; ++y)
        {
          for (int x = print.tiles.x0; x < print.tiles.x1; ++x)
          {
            if (seen.depths[y * Tiles + x] >= print.first)
            {
              return true;
            }
          }
        }
        return false;
      });
}
}
