#include "svoBodies.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/mat4x3.hpp>

namespace svo
{
namespace
{
/// Of a rod's length, at least: its matrix stays far from singular.
constexpr double LeastRadius = 1e-8;

/// Radii at places in the world.
class Radii
{
public:
  Radii(const Bodies& bodies, const View& eye)
    : One(bodies.radius)
    , Each(bodies.radii.empty() ? nullptr : bodies.radii.data())
  {
    if (bodies.width == Bodies::Width::Pixels && eye.width > 0)
    {
      // A length in clip space is a share of w.
      const double pixel = 2.0 / (eye.width * std::abs(eye.viewToClip[0][0]));
      const glm::dvec4 depth = glm::transpose(eye.worldToView)[2];
      this->Row = pixel * eye.viewToClip[2][3] * depth;
      this->Row.w += pixel * eye.viewToClip[3][3];
      this->Least = eye.parallel ? 0.0 : pixel * std::max(eye.tNear, 0.0);
    }
  }

  double at(std::size_t body, const glm::dvec3& place) const
  {
    // Behind the eye as large as before it: shadows of what lies there fall into the picture.
    const double length = std::abs(glm::dot(glm::dvec3(this->Row), place) + this->Row.w);
    return (this->Each ? this->Each[body] : this->One) * std::max(length, this->Least);
  }

private:
  glm::dvec4 Row{ 0.0, 0.0, 0.0, 1.0 }; // a place -> the length that a radius is counted in
  double Least = 0.0;
  double One;
  const double* Each;
};

/// Two unit vectors that are perpendicular to a unit vector and to each other (Duff et al.,
/// "Building an Orthonormal Basis, Revisited", JCGT 2017).
void perpendicular(const glm::dvec3& n, glm::dvec3& u, glm::dvec3& v)
{
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  u = glm::dvec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
  v = glm::dvec3(b, sign + n.y * n.y * a, -n.y);
}
}

void placeBodies(
  const Bodies& bodies, const glm::dmat4& localToWorld, const View& eye, GlyphSet& copies)
{
  constexpr double Tiny = std::numeric_limits<float>::min();
  const Radii radii(bodies, eye);
  const glm::dmat4x3 world(localToWorld);
  copies.copies.resize(bodies.count());
  for (std::size_t i = 0; i < copies.copies.size(); ++i)
  {
    GlyphCopy& copy = copies.copies[i];
    copy.point = static_cast<std::int64_t>(i);
    if (bodies.shape == Bodies::Shape::Ball)
    {
      const glm::dvec3 centre = world * glm::dvec4(bodies.ends[i], 1.0);
      const double radius = std::max(radii.at(i, centre), Tiny);
      copy.place = glm::dmat4x3(radius);
      copy.place[3] = centre;
      continue;
    }
    const glm::dvec3 from = world * glm::dvec4(bodies.ends[2 * i], 1.0);
    const glm::dvec3 to = world * glm::dvec4(bodies.ends[2 * i + 1], 1.0);
    const glm::dvec3 along = to - from;
    const double length = std::max(glm::length(along), Tiny);
    const double radius =
      std::max(0.5 * (radii.at(i, from) + radii.at(i, to)), LeastRadius * length);
    glm::dvec3 u, v;
    perpendicular(along / length, u, v);
    copy.place = glm::dmat4x3(radius * u, radius * v, along, from);
  }
}
}
