// What the property suites share: sizes that can be raised, random matrices, exact local rays.
//
// Every suite has fixed seeds and a size for the default run. VTKSVO_EXTREMES=n in the environment
// multiplies the sizes; a failure prints the numbers that make the case again.
#ifndef svoExtremes_h
#define svoExtremes_h

#include "svoLocalView.h"
#include "svoTestTracers.h"
#include "svoTracerScenes.h"

#include <cmath>
#include <cstdlib>
#include <random>
#include <sstream>
#include <string>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

namespace svotest
{
/// `size`, times VTKSVO_EXTREMES if that is set.
inline long scaled(long size)
{
  const char* factor = std::getenv("VTKSVO_EXTREMES");
  const double f = factor ? std::atof(factor) : 1.0;
  return f > 0.0 ? static_cast<long>(std::ceil(static_cast<double>(size) * f)) : size;
}

/// Columns of a matrix with all digits: what a failure prints.
inline std::string text(const glm::dmat4& m)
{
  std::ostringstream out;
  out.precision(17);
  for (int c = 0; c < 4; ++c)
  {
    out << (c ? "  " : "") << m[c].x << " " << m[c].y << " " << m[c].z << " " << m[c].w;
  }
  return out.str();
}

/// A source of everything random in a suite.
class Chance
{
public:
  explicit Chance(std::uint64_t seed)
    : Random(seed)
  {
  }
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(this->Random); }
  double between(double low, double high) { return low + (high - low) * this->unit(); }
  int below(int n) { return static_cast<int>(this->Random() % static_cast<std::uint64_t>(n)); }
  glm::dvec3 direction()
  {
    std::normal_distribution<double> normal;
    return glm::normalize(
      glm::dvec3(normal(this->Random), normal(this->Random), normal(this->Random)));
  }
  glm::dmat3 rotation()
  {
    return glm::mat3_cast(glm::angleAxis(this->between(0.0, 2.0 * Pi), this->direction()));
  }
  /// A linear map with singular values from 1 / condition to 1, mirrored half of the time: scales,
  /// shears and all between them.
  glm::dmat3 linear(double condition)
  {
    glm::dmat3 stretch(1.0);
    stretch[0][0] = this->unit() < 0.5 ? -1.0 : 1.0;
    stretch[1][1] = std::pow(condition, -this->unit());
    stretch[2][2] = 1.0 / condition;
    return this->rotation() * stretch * this->rotation();
  }

private:
  std::mt19937_64 Random;
};

inline glm::dmat4 affine(const glm::dmat3& linear, const glm::dvec3& translation)
{
  glm::dmat4 m(linear);
  m[3] = glm::dvec4(translation, 1.0);
  return m;
}

using Exact = long double; // 11 bits more than a double: the reference of what doubles lose
using ExactMat4 = glm::mat<4, 4, Exact>;
using ExactVec3 = glm::vec<3, Exact>;
using ExactVec4 = glm::vec<4, Exact>;

/// The inverse of an affine matrix, for any condition: cofactors lose digits as the square of the
/// condition number, and Newton's iteration gives back all but as its first power.
inline ExactMat4 inverseAffine(const ExactMat4& m)
{
  using ExactMat3 = glm::mat<3, 3, Exact>;
  const ExactMat3 linear(m);
  ExactMat3 inverted = glm::inverse(linear);
  for (int i = 0; i < 4; ++i)
  {
    inverted = inverted * (ExactMat3(Exact(2)) - linear * inverted);
  }
  ExactMat4 inverse(inverted);
  inverse[3] = ExactVec4(-(inverted * ExactVec3(m[3])), Exact(1));
  return inverse;
}

/// The local ray of a point of the image, in double.
inline svo::Ray localRay(const svo::LocalView& view, const glm::dvec2& image)
{
  svo::Ray ray;
  ray.origin = view.origin + image.y * view.originY + image.x * view.originX;
  ray.direction = view.direction + image.y * view.directionY + image.x * view.directionX;
  ray.tMax = view.tMax;
  return ray;
}

/// The same in floats, as it is traced in a block.
inline svo::Ray blockRay(
  const svo::Octree& octree, const svo::LocalView& view, const glm::dvec2& image)
{
  svo::RayBlock block;
  svo::HitBlock hits;
  double x[64], y[64];
  std::fill_n(x, 64, image.x);
  std::fill_n(y, 64, image.y);
  std::fill_n(block.tMin, 64, 0.0f);
  std::fill_n(block.tMax, 64, view.tMax);
  if (view.stretched)
  {
    svo::intersectStretched(octree, view, x, y, block, {}, hits);
  }
  else
  {
    block.aim(0, view.originAt(image.x, image.y), view.directionAt(image.x, image.y));
  }
  svo::Ray ray;
  ray.origin = { block.originX[0], block.originY[0], block.originZ[0] };
  ray.direction = { block.directionX[0], block.directionY[0], block.directionZ[0] };
  ray.tMin = block.tMin[0];
  ray.tMax = block.tMax[0];
  return ray;
}

/// True if the ray passes the border of the cell within `slack` (octree coordinates).
inline bool isTie(
  const svo::Octree& octree, const svo::Ray& ray, const glm::ivec3& cell, double slack)
{
  const double edge = cellEdge(octree, octree.level());
  const glm::dvec3 low = 1.0 + glm::dvec3(cell) * edge;
  if (2.0 * slack < edge)
  {
    return grazes(ray, low, low + edge, slack);
  }
  // All of the cell is border: the ray has to come near it.
  const glm::dvec3 middle = low + 0.5 * edge;
  const double reach = slack + 0.5 * edge;
  return grazes(ray, middle, middle, reach) || grazes(ray, middle - reach, middle + reach, 1e-300);
}

/// How far floats may be from the ray, in octree coordinates: three roundings of the farthest
/// number in the sum origin + t direction at the cube.
inline double floatSlack(const svo::Ray& ray)
{
  return 3.0 * std::ldexp(1.0, -23) * (2.0 + glm::length(ray.origin - 1.5));
}
}

#endif
