// The window depth that a traced surface is shown at, among what VTK's rasteriser draws.
//
// The rasteriser has vertices, matrices and depths in floats, and a depth buffer of 24 bits. The
// depths of a surface that both draw differ by a few of the buffer's steps, up and down: seen
// together, the surfaces are torn. So a traced surface that is to be covered by what the rasteriser
// draws on the same vertices steps back by as much, and one that is to cover it steps forward.
#ifndef svoShownDepth_h
#define svoShownDepth_h

#include "svoInstance.h"
#include "svoView.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace svo
{
/// How far the rasteriser's window depths of a mesh are off, nearly everywhere: two steps of the
/// depth buffer for the interpolation and the buffer itself, and the rounding of one of the numbers
/// that are added up to a vertex in clip coordinates as if all of them were that large. Far from
/// the origin that grows; it ends at the smallest step of VTK's own offsets, 1 / 65000.
inline double rasterError(const Instance& instance, const View& view)
{
  constexpr double Step = 1.0 / (1 << 24);
  constexpr double Most = 256.0;
  const double* b = instance.body->octree.header().meshBounds;
  const glm::dvec3 low(b[0], b[2], b[4]), high(b[1], b[3], b[5]);
  // -linear depth of a point of the mesh.
  glm::dvec4 z;
  for (int k = 0; k < 4; ++k)
  {
    z[k] = k == 3 ? view.worldToView[3][2] : 0.0;
    for (int j = 0; j < 3; ++j)
    {
      z[k] += view.worldToView[j][2] * instance.localToWorld[k][j];
    }
  }
  const glm::dvec3 centre = 0.5 * (low + high);
  const double depth = std::max(-(glm::dot(glm::dvec3(z), centre) + z.w), view.tNear);
  const glm::dmat4& p = view.viewToClip;
  const double w = p[3][3] - p[2][3] * depth;
  const double products =
    glm::dot(glm::abs(glm::dvec3(z)), glm::max(glm::abs(low), glm::abs(high)));
  const double sums = (std::abs(p[2][2]) + std::abs(p[2][3])) * products +
    std::abs(p[2][2] * z.w + p[3][2]) + std::abs(p[2][3] * z.w + p[3][3]);
  const double steps = 2.0 + 0.5 * sums / w;
  return Step * (steps < Most ? steps : Most);
}

/// To be added to the window depths of an instance's hits before they are shown, beside
/// Instance::depthOffset.factor times their slopes.
inline double shownOffset(const Instance& instance, const View& view)
{
  return instance.coincidentOrder == 0
    ? instance.depthOffset.units
    : instance.depthOffset.units + instance.coincidentOrder * rasterError(instance, view);
}
}

#endif
