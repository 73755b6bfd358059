#include "svoPlacedShapes.h"

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
constexpr double Tiny = std::numeric_limits<float>::min();

/// Radii at places in the world.
class Radii
{
public:
  Radii(const RoundShapes& shapes, const View& eye)
    : One(shapes.radius)
    , Each(shapes.radii.empty() ? nullptr : shapes.radii.data())
  {
    if (shapes.width == RoundShapes::Width::Pixels && eye.width > 0)
    {
      // A length in clip space is a share of w.
      const double pixel = 2.0 / (eye.width * std::abs(eye.viewToClip[0][0]));
      const glm::dvec4 depth = glm::transpose(eye.worldToView)[2];
      this->Row = pixel * eye.viewToClip[2][3] * depth;
      this->Row.w += pixel * eye.viewToClip[3][3];
      this->Least = eye.parallel ? 0.0 : pixel * std::max(eye.tNear, 0.0);
    }
  }

  /// The length that a radius is counted in, negative behind the eye.
  double unit(const glm::dvec3& place) const
  {
    return glm::dot(glm::dvec3(this->Row), place) + this->Row.w;
  }

  /// Behind the eye as large as before it: shadows of what lies there fall into the picture.
  double at(std::size_t number, const glm::dvec3& place) const
  {
    return (this->Each ? this->Each[number] : this->One) *
      std::max(std::abs(this->unit(place)), this->Least);
  }

private:
  glm::dvec4 Row{ 0.0, 0.0, 0.0, 1.0 }; // a place -> the length that a radius is counted in
  double Least = 0.0;
  double One;
  const double* Each;
};

/// A segment in pieces whose ends are nearly equally far from the eye.
class Pieces
{
public:
  /// By the units of both ends.
  Pieces(double a, double b)
    : A(a)
    , B(b)
  {
    constexpr double MostRatio = 1.25;
    constexpr double Most = 32.0;
    const double ratio = b / a; // below 0: the eye's plane is between them
    if (!(ratio > 0.0) || !std::isfinite(ratio))
    {
      this->Count = a == b ? 1 : static_cast<int>(Most);
      return;
    }
    if (ratio > MostRatio || ratio < 1.0 / MostRatio)
    {
      const double ratios = std::abs(std::log(ratio)) / std::log(MostRatio);
      this->Count = static_cast<int>(std::min(std::ceil(ratios), Most));
    }
    this->Ratio = ratio;
  }

  int count() const { return this->Count; }

  /// Where piece 1, 2, ... ends, 0..1 along the segment.
  double end(int piece) const
  {
    const double share = static_cast<double>(piece) / this->Count;
    return this->Ratio > 0.0
      ? (this->A * std::pow(this->Ratio, share) - this->A) / (this->B - this->A)
      : share;
  }

private:
  double A, B;
  double Ratio = 0.0; // 0: pieces are equally long
  int Count = 1;
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

GlyphCopy rod(
  const glm::dvec3& from, const glm::dvec3& to, double radius, std::int64_t number, int piece)
{
  const glm::dvec3 along = to - from;
  const double length = std::max(glm::length(along), Tiny);
  const double own = std::max(radius, LeastRadius * length);
  glm::dvec3 u, v;
  perpendicular(along / length, u, v);
  GlyphCopy copy;
  copy.place = glm::dmat4x3(own * u, own * v, along, from);
  // What else is a rod keeps its name when another one has more pieces.
  constexpr std::int64_t Most = std::int64_t(1) << 40;
  copy.point = number + Most * (piece - 1);
  return copy;
}
}

void placeShapes(
  const RoundShapes& shapes, const glm::dmat4& localToWorld, const View& eye, GlyphSet& copies)
{
  const Radii radii(shapes, eye);
  const glm::dmat4x3 world(localToWorld);
  copies.copies.clear();
  copies.copies.reserve(shapes.count());
  for (std::size_t i = 0; i < shapes.count(); ++i)
  {
    if (shapes.shape == RoundShapes::Shape::Ball)
    {
      GlyphCopy copy;
      copy.point = static_cast<std::int64_t>(i);
      const glm::dvec3 centre = world * glm::dvec4(shapes.ends[i], 1.0);
      const double radius = std::max(radii.at(i, centre), Tiny);
      copy.place = glm::dmat4x3(radius);
      copy.place[3] = centre;
      copies.copies.push_back(copy);
      continue;
    }
    const glm::dvec3 from = world * glm::dvec4(shapes.ends[2 * i], 1.0);
    const glm::dvec3 to = world * glm::dvec4(shapes.ends[2 * i + 1], 1.0);
    const Pieces pieces(radii.unit(from), radii.unit(to));
    glm::dvec3 begin = from;
    for (int k = 1; k <= pieces.count(); ++k)
    {
      const glm::dvec3 end = k < pieces.count() ? glm::mix(from, to, pieces.end(k)) : to;
      const double radius = 0.5 * (radii.at(i, begin) + radii.at(i, end));
      copies.copies.push_back(rod(begin, end, radius, static_cast<std::int64_t>(i), k));
      begin = end;
    }
  }
}
}
