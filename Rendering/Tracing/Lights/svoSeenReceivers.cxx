#include "svoSeenReceivers.h"

#include "svoShadowRules.h"

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
/// Of a box, in its diagonals.
constexpr double WiderBy = 0.1;
/// Texels around a point that are looked up: half of the widest filter's window, and the next ones.
constexpr double Reach = 0.5 * WidestBox + 3.0;
/// Pixels along an edge of a part of the eye's picture.
constexpr int Block = 64;
/// So many pixels of flat receivers are looked at, in pictures of the eye; further ones are taken
/// whole.
constexpr double MostPictures = 4.0;
/// Of window depths of 24 bits, and of what is computed in float on the way to them.
constexpr double DepthError = 1.0 / (1 << 21);

/// The axis that a box is flat along; 3 if it is not.
int flatAxis(const Box& box)
{
  const glm::dvec3 size = box.high - box.low;
  int axis = 0;
  while (axis < 3 && !(size[axis] <= 1e-12 * glm::length(size)))
  {
    ++axis;
  }
  return axis;
}

/// Around the pixels of a block at which the eye sees past what was traced to where an axis has a
/// value, and around their neighbours: silhouettes are wider than what was traced.
PixelRect seenPlane(
  const View& eye, const Hits& traced, const PixelRect& block, int axis, double at)
{
  const DepthBuffer& depth = traced.depth;
  const auto clipOf = [&](double t) // z and w
  {
    const glm::dmat4& m = eye.viewToClip;
    return glm::dvec2(m[3][2] - t * m[2][2], m[3][3] - t * m[2][3]);
  };
  PixelRect seen{ block.x1, block.y1, block.x0, block.y0 };
  for (int y = block.y0; y < block.y1; ++y)
  {
    const double origin = eye.rayOrigin(0.0, y + 0.5)[axis];
    const double direction = eye.rayDirection(0.0, y + 0.5)[axis];
    for (int x = block.x0; x < block.x1; ++x)
    {
      if (x >= seen.x0 && x < seen.x1 && y < seen.y1)
      {
        continue;
      }
      const std::uint32_t instance = depth.instanceAt(x, y);
      if (instance != NoInstance)
      {
        const double t = (at - origin - (x + 0.5) * eye.originX[axis]) /
          (direction + (x + 0.5) * eye.directionX[axis]);
        const double hides = traced.base(instance) + depth.t[depth.at(x, y)];
        const glm::dvec2 there = clipOf(t), before = clipOf(hides);
        if (t > hides && there.x * before.y > (before.x + 2.0 * DepthError * before.y) * there.y)
        {
          continue;
        }
      }
      seen = { std::min(seen.x0, x), std::min(seen.y0, y), std::max(seen.x1, x + 1),
        std::max(seen.y1, y + 1) };
    }
  }
  return seen.empty() ? seen
                      : PixelRect{ std::max(seen.x0 - 1, 0), std::max(seen.y0 - 1, 0),
                          std::min(seen.x1 + 1, eye.width), std::min(seen.y1 + 1, eye.height) };
}

/// Of a view's pixels those around points within it, with a margin for rounding and silhouettes.
PixelRect pixelsAround(const std::vector<glm::dvec3>& points, const View& view)
{
  const glm::dmat4 toClip = view.viewToClip * view.worldToView;
  const glm::dvec2 size(view.width, view.height);
  glm::dvec2 low(size), high(0.0);
  for (const glm::dvec3& point : points)
  {
    const glm::dvec4 clip = toClip * glm::dvec4(point, 1.0);
    const glm::dvec2 at = (0.5 * glm::dvec2(clip) / clip.w + 0.5) * size;
    low = glm::min(low, glm::floor(at) - 2.0);
    high = glm::max(high, glm::ceil(at) + 2.0);
  }
  const glm::ivec2 first(glm::max(low, 0.0)), last(glm::min(high, size));
  return { first.x, first.y, last.x, last.y };
}
}

SeenReceivers::SeenReceivers(const std::vector<Box>& receivers, const View& eye, const Hits& traced)
{
  if (eye.width < 1 || eye.height < 1)
  {
    return;
  }
  const ConvexBody view = pieceOf(eye, eye.tNear, eye.tFar);
  const CommonPart seen({ view });
  const double most = MostPictures * static_cast<double>(eye.width) * eye.height;
  double searched = 0.0; // pixels
  for (const Box& box : receivers)
  {
    const int axis = flatAxis(box);
    const glm::dvec3 wider(axis < 3 ? 0.0 : WiderBy * glm::length(box.high - box.low));
    const Box around{ box.low - wider, box.high + wider };
    Part part;
    part.seen = view;
    for (int i = 0; i < 8; ++i)
    {
      part.box[i] = around.corner(i);
    }
    seen.add(part.box, part.points);
    if (part.points.empty())
    {
      continue;
    }
    const PixelRect rect = pixelsAround(part.points, eye);
    const double pixels =
      axis < 3 ? static_cast<double>(rect.x1 - rect.x0) * (rect.y1 - rect.y0) : most;
    if (searched + pixels < most)
    {
      searched += pixels;
      this->addSeen(part.box, axis, rect, eye, traced);
    }
    else
    {
      this->Parts.push_back(std::move(part));
    }
  }
}

void SeenReceivers::addSeen(
  const ConvexBody& box, int axis, const PixelRect& around, const View& eye, const Hits& traced)
{
  View seen = eye;
  for (int y = around.y0; y < around.y1; y += Block)
  {
    for (int x = around.x0; x < around.x1; x += Block)
    {
      const PixelRect block{ x, y, std::min(x + Block, around.x1), std::min(y + Block, around.y1) };
      seen.crop = seenPlane(eye, traced, block, axis, box[0][axis]);
      if (!seen.crop.empty())
      {
        Part part{ box, pieceOf(seen, eye.tNear, eye.tFar), {} };
        CommonPart({ part.seen }).add(box, part.points);
        if (!part.points.empty())
        {
          this->Parts.push_back(std::move(part));
        }
      }
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
      CommonPart({ part.seen, pieceOf(map, map.tNear, map.tFar) }).add(part.box, cut);
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
    const auto texel = [](double at, int first, int end)
    { return static_cast<int>(std::clamp<double>(at, first, end)); };
    const PixelRect& crop = map.crop;
    const glm::dvec2 first = (0.5 * low + 0.5) * size - Reach;
    const glm::dvec2 last = (0.5 * high + 0.5) * size + (Reach + 1.0);
    const PixelRect rect{ texel(first.x, crop.x0, crop.x1), texel(first.y, crop.y0, crop.y1),
      texel(last.x, crop.x0, crop.x1), texel(last.y, crop.y0, crop.y1) };
    if (!points->empty() && !rect.empty())
    {
      rects.push_back(rect);
    }
  }
  return rects;
}
}
