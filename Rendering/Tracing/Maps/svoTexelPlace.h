// Where a point is looked up in a shadow map, and how large texels are there. Whole tiles of points
// and single points call the same function, so that they get the same bits; it has no branches, so
// that a loop becomes vectors.
#ifndef svoTexelPlace_h
#define svoTexelPlace_h

#include "svoShadowRules.h"
#include "svoView.h"
#include "svoWorldSize.h"

#include <cmath>

#include <glm/mat4x4.hpp>
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

struct TexelPlace
{
  double x, y;   // texels, within the map
  double t;      // linear depth from the light
  double inside; // of the map: 1, or 0
};

/// `worldToClip`: of the map's view.
inline TexelPlace texelPlace(
  const View& map, const glm::dmat4& worldToClip, const glm::dvec3& position)
{
  const glm::dvec4 clip = worldToClip * glm::dvec4(position, 1.0);
  const double border = MapBorder * clip.w;
  const double insideX = std::abs(clip.x) < border ? 1.0 : 0.0;
  const double insideY = std::abs(clip.y) < border ? insideX : 0.0;
  const double x = (clip.x / clip.w + 1.0) * 0.5 * map.width;
  const double y = (clip.y / clip.w + 1.0) * 0.5 * map.height;
  const double lastX = map.width - 1e-9, lastY = map.height - 1e-9;
  const double x0 = x < 0.0 ? 0.0 : x, y0 = y < 0.0 ? 0.0 : y;
  const glm::dmat4& m = map.worldToView;
  return { lastX < x0 ? lastX : x0, lastY < y0 ? lastY : y0,
    -(m[0][2] * position.x + m[1][2] * position.y + m[2][2] * position.z + m[3][2]),
    clip.w > 0.0 ? insideY : 0.0 };
}
}

#endif
