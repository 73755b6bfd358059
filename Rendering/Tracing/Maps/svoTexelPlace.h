// Where a point is looked up in a shadow map, and how large texels are there. Whole tiles of points
// and single points call the same function, so that they get the same bits; it has no branches, so
// that a loop becomes vectors.
#ifndef svoTexelPlace_h
#define svoTexelPlace_h

#include "svoShadowRules.h"
#include "svoView.h"
#include "svoWorldSize.h"

#include <algorithm>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace svo
{
/// How large a map's texels are in the world.
struct TexelEdge
{
  TexelEdge() = default;
  explicit TexelEdge(const View& light)
    : constant(light.parallel ? worldPixel(light, 0.0) : 0.0)
    , perDepth(light.parallel ? 0.0 : worldPixel(light, 1.0))
    , aspect(widerWorldPixel(light, 1.0) / worldPixel(light, 1.0))
  {
  }
  /// The shorter edge, at linear depth t.
  double operator()(double t) const { return this->constant + t * this->perDepth; }

  double constant = 0.0;
  double perDepth = 0.0;
  double aspect = 1.0; // the longer edge, in shorter ones
};

/// A map as points are looked up in it.
struct MapGeometry
{
  MapGeometry() = default;
  explicit MapGeometry(const View& map)
    : view(map)
    , worldToClip(map.viewToClip * map.worldToView)
    , edge(map)
    , low(clipOf(map.crop.x0, map.width), clipOf(map.crop.y0, map.height))
    , high(clipOf(map.crop.x1, map.width), clipOf(map.crop.y1, map.height))
    , first(map.crop.x0, map.crop.y0)
    , last(beforeEnd(map.crop.x1), beforeEnd(map.crop.y1))
  {
  }

  View view;
  glm::dmat4 worldToClip{ 1.0 };
  TexelEdge edge;
  // The crop.
  glm::dvec2 low{ 0.0 }, high{ 0.0 };   // clip space; MapBorder where it is the image's
  glm::dvec2 first{ 0.0 }, last{ 0.0 }; // texels

  bool has(const glm::ivec2& texel) const
  {
    const PixelRect& crop = this->view.crop;
    return texel.x >= crop.x0 && texel.x < crop.x1 && texel.y >= crop.y0 && texel.y < crop.y1;
  }

private:
  static double clipOf(int texel, int size)
  {
    return texel == 0 ? -MapBorder : texel == size ? MapBorder : 2.0 * texel / size - 1.0;
  }
  static double beforeEnd(int texel) { return std::min(texel - 1e-9, texel * (1.0 - 0x1p-52)); }
};

struct TexelPlace
{
  double x, y;   // texels, within the map
  double t;      // linear depth from the light
  double inside; // of the map: 1, or 0
};

inline TexelPlace texelPlace(const MapGeometry& map, const glm::dvec3& position)
{
  const glm::dvec4 clip = map.worldToClip * glm::dvec4(position, 1.0);
  const double rightOf = map.low.x * clip.w < clip.x ? 1.0 : 0.0;
  const double insideX = clip.x < map.high.x * clip.w ? rightOf : 0.0;
  const double above = map.low.y * clip.w < clip.y ? insideX : 0.0;
  const double inside = clip.y < map.high.y * clip.w ? above : 0.0;
  const double x = (clip.x / clip.w + 1.0) * 0.5 * map.view.width;
  const double y = (clip.y / clip.w + 1.0) * 0.5 * map.view.height;
  const double x0 = x < map.first.x ? map.first.x : x, y0 = y < map.first.y ? map.first.y : y;
  const glm::dmat4& m = map.view.worldToView;
  return { map.last.x < x0 ? map.last.x : x0, map.last.y < y0 ? map.last.y : y0,
    -(m[0][2] * position.x + m[1][2] * position.y + m[2][2] * position.z + m[3][2]),
    clip.w > 0.0 ? inside : 0.0 };
}
}

#endif
