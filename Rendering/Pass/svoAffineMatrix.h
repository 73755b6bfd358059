// Is a matrix fit for tracing?
#ifndef svoAffineMatrix_h
#define svoAffineMatrix_h

#include "svoWorldToOctree.h"

#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace svo
{
enum class MatrixKind
{
  Affine,     // and invertible
  Projective, // its last row is not (0, 0, 0, 1)
  Singular    // or so nearly that nothing can be seen of what it places; or not finite
};

/// Condition number, in the Frobenius norm, from which a matrix counts as singular.
constexpr double MaximumCondition = 1e12;

inline double frobeniusNorm(const glm::dmat3& m)
{
  double sum = 0.0;
  for (int i = 0; i < 9; ++i)
  {
    sum += m[i / 3][i % 3] * m[i / 3][i % 3];
  }
  return std::sqrt(sum);
}

inline MatrixKind kindOf(const glm::dmat4& m)
{
  for (int i = 0; i < 16; ++i)
  {
    if (!std::isfinite(m[i / 4][i % 4]))
    {
      return MatrixKind::Singular;
    }
  }
  if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0)
  {
    return m[0][3] == 0.0 && m[1][3] == 0.0 && m[2][3] == 0.0 && m[3][3] == 0.0
      ? MatrixKind::Singular
      : MatrixKind::Projective;
  }
  // Scaled first: neither tiny nor huge worlds are singular.
  const glm::dmat3 linear(m);
  const double scale = frobeniusNorm(linear);
  if (!(scale > 0.0))
  {
    return MatrixKind::Singular;
  }
  const double condition = frobeniusNorm(stableInverse(linear / scale));
  return condition <= MaximumCondition ? MatrixKind::Affine : MatrixKind::Singular;
}
}

#endif
