// Octree coordinates projected onto an image: pixels and depth as linear functions.
#ifndef svoProjection_h
#define svoProjection_h

#include "svoIntersectTile.h"
#include "svoOctree.h"
#include "svoView.h"

#include <cassert>

#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace svo
{
/// Homogeneous pixel coordinates, counted from the middle of the image, and depth, as functions of
/// octree coordinates.
struct Projection
{
  // Columns: of x, y, z and of the cube's lower corner, which has octree coordinates 1. Rows:
  // pixel x w, pixel y w, w, linear depth minus the caller's base.
  glm::dvec4 x, y, z, corner;

  /// A row as a function of octree coordinates.
  glm::dvec4 row(int r) const { return { x[r], y[r], z[r], corner[r] - x[r] - y[r] - z[r] }; }
};

inline Projection makeProjection(
  const Octree& octree, const glm::dmat4& localToWorld, const View& view, double base)
{
  const glm::dmat4 octreeToView =
    view.worldToView * localToWorld * glm::inverse(octree.localToOctree());
  const glm::dmat4 clip = view.viewToClip * octreeToView;
  Projection projection;
  glm::dvec4* columns[4] = { &projection.x, &projection.y, &projection.z, &projection.corner };
  for (int c = 0; c < 4; ++c)
  {
    *columns[c] = { 0.5 * view.width * clip[c][0], 0.5 * view.height * clip[c][1], clip[c][3],
      -octreeToView[c][2] };
  }
  projection.corner += projection.x + projection.y + projection.z; // octree coordinates begin at 1
  projection.corner[3] -= base;
  return projection;
}

/// The pyramid of all rays through n x n tiles of 8x8 pixels, at any points of their pixels;
/// (tileX, tileY) is the lower left tile.
inline TilePyramid makePyramid(
  const Projection& projection, const View& view, int tileX, int tileY, int n = 1)
{
  assert(n > 0);
  const glm::dvec4 x = projection.row(0), y = projection.row(1), w = projection.row(2);
  const double x0 = 8.0 * tileX - 0.5 * view.width, x1 = x0 + 8.0 * n;
  const double y0 = 8.0 * tileY - 0.5 * view.height, y1 = y0 + 8.0 * n;
  return { { x - x0 * w, x1 * w - x, y - y0 * w, y1 * w - y }, projection.row(3) };
}
}

#endif
