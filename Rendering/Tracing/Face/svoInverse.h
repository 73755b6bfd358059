// The inverse of a matrix with all digits of a double.
#ifndef svoInverse_h
#define svoInverse_h

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>

namespace svo
{
/// True if all numbers of a matrix of doubles are.
template <class Matrix>
bool isFinite(const Matrix& m)
{
  const double* const first = &m[0][0];
  return std::all_of(
    first, first + sizeof m / sizeof *first, [](double v) { return std::isfinite(v); });
}

namespace detail
{
/// (1 - m x)[row, column] with the precision of products and sums of twice as many digits: Dot2 of
/// Ogita, Rump and Oishi, "Accurate Sum and Dot Product", SIAM J. Sci. Comput. 26 (2005).
inline double residual(const glm::dmat3& m, const glm::dmat3& x, int row, int column)
{
  double sum = row == column ? 1.0 : 0.0;
  double lost = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const double product = m[k][row] * x[column][k];
    const double next = sum - product;
    const double part = next - sum;
    lost += (sum - (next - part)) + (-product - part); // of the sum
    lost -= std::fma(m[k][row], x[column][k], -product);
    sum = next;
  }
  return sum + lost;
}

inline glm::dmat3 residual(const glm::dmat3& m, const glm::dmat3& x)
{
  glm::dmat3 error;
  for (int c = 0; c < 3; ++c)
  {
    for (int r = 0; r < 3; ++r)
    {
      error[c][r] = residual(m, x, r, c);
    }
  }
  return error;
}

/// The inverse by elimination with complete pivoting: several digits at a condition of 1e12.
inline glm::dmat3 eliminated(const glm::dmat3& m)
{
  double a[3][6]; // rows of [ m | 1 ]
  int column[3] = { 0, 1, 2 };
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c)
    {
      a[r][c] = m[c][r];
      a[r][3 + c] = r == c ? 1.0 : 0.0;
    }
  }
  for (int k = 0; k < 3; ++k)
  {
    int row = k;
    int best = k;
    for (int r = k; r < 3; ++r)
    {
      for (int c = k; c < 3; ++c)
      {
        if (std::abs(a[r][c]) > std::abs(a[row][best]))
        {
          row = r;
          best = c;
        }
      }
    }
    std::swap_ranges(a[k], a[k] + 6, a[row]);
    for (int r = 0; r < 3 && best != k; ++r)
    {
      std::swap(a[r][k], a[r][best]);
    }
    std::swap(column[k], column[best]);
    for (int r = 0; r < 3; ++r)
    {
      if (r == k)
      {
        continue;
      }
      const double factor = a[r][k] / a[k][k];
      for (int c = k; c < 6; ++c)
      {
        a[r][c] -= factor * a[k][c];
      }
    }
  }
  glm::dmat3 inverse;
  for (int k = 0; k < 3; ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      inverse[c][column[k]] = a[k][3 + c] / a[k][k];
    }
  }
  return inverse;
}

/// The inverse by cofactors: as many digits as the condition leaves of a double's, a quarter of the
/// time. Not finite where products of three numbers are not.
inline glm::dmat3 byCofactors(const glm::dmat3& m)
{
  const glm::dvec3 x = glm::cross(m[1], m[2]), y = glm::cross(m[2], m[0]);
  const glm::dvec3 z = glm::cross(m[0], m[1]);
  return glm::transpose(glm::dmat3(x, y, z)) * (1.0 / glm::dot(m[0], x));
}

/// True of residuals from which two steps of Newton's iteration lead to all digits.
inline bool isSmall(const glm::dmat3& error)
{
  const double* const first = &error[0][0];
  return std::all_of(first, first + 9, [](double v) { return std::abs(v) <= 0x1p-20; });
}
}

/// The inverse of a 3x3 matrix with all the digits of a double, up to a condition of about 1e12:
/// cofactors over the determinant or, where that is not near enough, elimination, then Newton's
/// iteration x += x (1 - m x) (Schulz, 1933) with exact residuals. A ray passes
/// through two rounded products, of the eye and of the direction, and only if each is right by
/// itself is the ray right where it meets the object. (With glm::inverse, cofactors over the
/// determinant, rays missed a needle of condition 1e6 by hundredths of its voxels and one of
/// condition 1e9 altogether.) Not finite for a singular or not finite matrix.
inline glm::dmat3 stableInverse(const glm::dmat3& m)
{
  glm::dmat3 inverse = detail::byCofactors(m);
  glm::dmat3 error = detail::residual(m, inverse);
  if (!detail::isSmall(error))
  {
    inverse = detail::eliminated(m);
    error = detail::residual(m, inverse);
  }
  inverse += inverse * error;
  inverse += inverse * detail::residual(m, inverse);
  return inverse;
}

/// True if a matrix is finite and can be inverted. An instance with any other matrix is neither
/// seen nor casts.
inline bool placesSomething(const glm::dmat4& m)
{
  const glm::dmat3 linear(m);
  const bool inverted = detail::isSmall(glm::dmat3(1.0) - linear * detail::byCofactors(linear)) ||
    isFinite(stableInverse(linear));
  return inverted && isFinite(glm::dmat4x3(m));
}
}

#endif
