// Watertight intersection of a ray and a triangle: S. Woop, C. Benthin, I. Wald, "Watertight
// Ray/Triangle Intersection", JCGT 2(1), 2013.
//
// The ray is sheared so that it becomes the positive z axis; then the signs of three edge functions
// decide, and two triangles that share an edge compute the same sign for it. Where rounding makes
// an edge function zero its exact sign is found by two fused multiply-adds. A ray exactly through
// an edge or a vertex hits every triangle that has it.
#ifndef svoTriangle_h
#define svoTriangle_h

#include <cassert>
#include <cmath>
#include <utility>

#include <glm/vec3.hpp>

namespace svo
{
/// A ray made ready for many triangles. The direction must be finite and not zero.
template <class Real>
struct ShearedRay
{
  using Vector = glm::vec<3, Real>;

  ShearedRay(const Vector& rayOrigin, const Vector& direction)
    : origin(rayOrigin)
  {
    const Vector size =
      glm::vec<3, Real>(std::abs(direction.x), std::abs(direction.y), std::abs(direction.z));
    z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    x = (z + 1) % 3;
    y = (x + 1) % 3;
    if (direction[z] < Real(0)) // keep the winding
    {
      std::swap(x, y);
    }
    assert(direction[z] != Real(0) && std::isfinite(direction[z]));
    shear = { direction[x] / direction[z], direction[y] / direction[z], Real(1) / direction[z] };
  }

  Vector origin;
  Vector shear;
  int x, y, z;
};

/// a b - c d with the right sign, zero only if it is zero.
template <class Real>
Real differenceOfProducts(Real a, Real b, Real c, Real d)
{
  const Real ab = a * b;
  const Real cd = c * d;
  if (ab != cd)
  {
    return ab - cd;
  }
  return std::fma(a, b, -ab) - std::fma(c, d, -cd);
}

/// True if the line of the ray hits the triangle, from either side; then t is where. The caller
/// compares t with the ray's ends. Degenerate triangles and triangles seen edge-on are missed.
template <class Real>
bool intersectTriangle(
  const ShearedRay<Real>& ray, const glm::vec3& p, const glm::vec3& q, const glm::vec3& r, Real& t)
{
  using Vector = glm::vec<3, Real>;
  const Vector a = Vector(p) - ray.origin;
  const Vector b = Vector(q) - ray.origin;
  const Vector c = Vector(r) - ray.origin;
  const Real ax = a[ray.x] - ray.shear.x * a[ray.z];
  const Real ay = a[ray.y] - ray.shear.y * a[ray.z];
  const Real bx = b[ray.x] - ray.shear.x * b[ray.z];
  const Real by = b[ray.y] - ray.shear.y * b[ray.z];
  const Real cx = c[ray.x] - ray.shear.x * c[ray.z];
  const Real cy = c[ray.y] - ray.shear.y * c[ray.z];
  const Real u = differenceOfProducts(cx, by, cy, bx);
  const Real v = differenceOfProducts(ax, cy, ay, cx);
  const Real w = differenceOfProducts(bx, ay, by, ax);
  if ((u < Real(0) || v < Real(0) || w < Real(0)) && (u > Real(0) || v > Real(0) || w > Real(0)))
  {
    return false;
  }
  const Real determinant = u + v + w;
  if (determinant == Real(0))
  {
    return false;
  }
  t = (u * a[ray.z] + v * b[ray.z] + w * c[ray.z]) * ray.shear.z / determinant;
  return true;
}
}

#endif
