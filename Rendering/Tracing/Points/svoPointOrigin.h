// Visible points in single precision: as ways from an origin nearby that is known in double.
//
// A view's rays are affine in the pixel, and their points in the depth:
//
//   point(x, y, t) = origin(x, y) + t direction(x, y)
//
// So from the point O of pixel corner (X, Y) and depth T, which is computed in double, it is
//
//   way(dx, dy, dt) = dx alongX + dy alongY + dt (ray + dx rayX + dy rayY)
//
// to another point, all in floats: where the origin of the world lies, how far the eye is and how
// deep the scene, has no part in it. A patch (svoTilePatch.h) is made so that its points are
// within a few hundred pixels' widths of O.
//
// With u = 2^-24, dx and dy exact and at most 8, and dt the rounded difference of two floats, a
// component of the way is off by at most WayError = 8 u of
//
//   extent = 8 |alongX| + 8 |alongY| + dt (|ray| + 8 |rayX| + 8 |rayY|)
//
// : the coefficients' own rounding, a product and two sums are 4 u of the first two terms; of the
// last one dt, the sum in brackets (a coefficient, a product, two sums), a product and a sum are 7.
#ifndef svoPointOrigin_h
#define svoPointOrigin_h

#include "svoView.h"

#include <cassert>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// A rounding of single precision.
constexpr float FloatRounding = 1.0f / (1 << 24);
constexpr float WayError = 8.0f * FloatRounding;

struct PointOrigin
{
  glm::dvec3 position{ 0.0 };               // world
  glm::vec3 alongX{ 0 }, alongY{ 0 };       // world: a pixel, at this depth
  glm::vec3 ray{ 0 }, rayX{ 0 }, rayY{ 0 }; // world: linear depth grows by 1

  PointOrigin() = default;
  /// The point of (x, y) on the image with linear depth t.
  PointOrigin(const View& view, double x, double y, double t)
    : position(view.rayOrigin(x, y) + t * view.rayDirection(x, y))
    , alongX(view.originX + t * view.directionX)
    , alongY(view.originY + t * view.directionY)
    , ray(view.rayDirection(x, y))
    , rayX(view.directionX)
    , rayY(view.directionY)
  {
  }

  /// The ray of a point, dx and dy pixels from here.
  glm::vec3 rayTo(float dx, float dy) const { return ray + dx * rayX + dy * rayY; }
  glm::vec3 wayTo(float dx, float dy, float dt) const
  {
    return dx * alongX + dy * alongY + dt * this->rayTo(dx, dy);
  }
  /// What the ways to points of this tile, at most `dt` deeper or less deep, are off by WayError
  /// of.
  glm::vec3 extent(float dt) const
  {
    assert(!(dt < 0.0f));
    return 8.0f * (glm::abs(alongX) + glm::abs(alongY)) +
      dt * (glm::abs(ray) + 8.0f * (glm::abs(rayX) + glm::abs(rayY)));
  }
};
}

#endif
