// Whether a matrix is fit for tracing: affine and invertible, flat, projective, or not finite.
#ifndef svoAffineMatrix_h
#define svoAffineMatrix_h

#include "svoInverse.h"
#include "svoOctree.h"

#include <limits>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace svo
{
enum class MatrixKind
{
  Affine,     // and invertible
  Flat,       // affine, but singular or nearly so: its surface is a sheet, a line or a point
  Projective, // its last row is not (0, 0, 0, 1)
  Nowhere     // its last row is 0, or it is not finite: its surface cannot be seen
};

/// Condition number, in the Frobenius norm, from which a matrix counts as singular.
constexpr double MaximumCondition = 1e12;

/// Condition number of the linear part, in the Frobenius norm; infinite or NaN where there is no
/// inverse. That of a product is at most the product of both.
inline double frobeniusCondition(const glm::dmat4& m)
{
  // Scaled first: neither tiny nor huge worlds are singular.
  const glm::dmat3 linear(m);
  const double scale = frobeniusNorm(linear);
  return scale > 0.0 ? frobeniusNorm(stableInverse(linear / scale))
                     : std::numeric_limits<double>::infinity();
}

inline MatrixKind kindOf(const glm::dmat4& m)
{
  if (!isFinite(m))
  {
    return MatrixKind::Nowhere;
  }
  if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0)
  {
    return m[0][3] == 0.0 && m[1][3] == 0.0 && m[2][3] == 0.0 && m[3][3] == 0.0
      ? MatrixKind::Nowhere
      : MatrixKind::Projective;
  }
  return frobeniusCondition(m) <= MaximumCondition ? MatrixKind::Affine : MatrixKind::Flat;
}

/// A flat matrix with a thickness of a millionth, so that the sheet can be traced by lights. False
/// if it places no sheet, but a line or a point, which casts no shadow.
inline bool thicken(glm::dmat4& m)
{
  constexpr double Thickness = 1e-6;
  const auto longestCross = [](const glm::dmat3& a)
  {
    glm::dvec3 longest(0.0);
    for (int i = 0; i < 3; ++i)
    {
      const glm::dvec3 cross = glm::cross(a[i], a[(i + 1) % 3]);
      longest = glm::length(cross) > glm::length(longest) ? cross : longest;
    }
    return longest;
  };
  const double scale = frobeniusNorm(glm::dmat3(m));
  if (!(scale > 0.0))
  {
    return false;
  }
  // Across the sheet, before and after it is flattened.
  const glm::dmat3 linear = glm::dmat3(m) / scale;
  const glm::dvec3 before = longestCross(glm::transpose(linear));
  const glm::dvec3 after = longestCross(linear);
  if (!(glm::length(before) > Thickness && glm::length(after) > Thickness))
  {
    return false;
  }
  const glm::dmat3 across = glm::outerProduct(glm::normalize(after), glm::normalize(before));
  for (int c = 0; c < 3; ++c)
  {
    m[c] += glm::dvec4(Thickness * scale * across[c], 0.0);
  }
  return true;
}
}

#endif
