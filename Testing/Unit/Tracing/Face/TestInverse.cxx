#include "svoInverse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace
{
/// Multiples of rows are added to each other, and rows multiplied: nothing is rounded but what the
/// inverse is divided by in the end.
struct MatrixAndInverse
{
  glm::dmat3 matrix{ 1.0 }, inverse{ 1.0 };

  void add(int from, int to, double times)
  {
    glm::dmat3 step(1.0), back(1.0);
    step[from][to] = times;
    back[from][to] = -times;
    this->matrix = step * this->matrix;
    this->inverse = this->inverse * back;
  }
  void multiply(int row, double by)
  {
    for (int column = 0; column < 3; ++column)
    {
      this->matrix[column][row] *= by;
    }
    this->inverse[row] /= by;
  }
};

double largest(const glm::dmat3& m)
{
  double most = 0.0;
  for (int i = 0; i < 9; ++i)
  {
    const double size = std::abs(m[i / 3][i % 3]);
    most = size <= most ? most : size; // also what is no number
  }
  return most;
}
}

TEST(Inverse, HasAllDigits)
{
  std::mt19937 random(5);
  std::uniform_int_distribution<int> axis(0, 2), times(-9, 9), exponent(-300, 300);
  std::uniform_int_distribution<int> factor(1 << 28, 1 << 29);
  int easy = 0, hard = 0;
  for (int n = 0; n < 40000; ++n)
  {
    MatrixAndInverse both;
    const int steps = n % 12;
    for (int i = 0; i < steps; ++i)
    {
      const int from = axis(random);
      both.add(from, (from + 1 + axis(random) % 2) % 3, times(random));
    }
    const double condition = largest(both.matrix) * largest(both.inverse);
    if (condition > 1e12)
    {
      continue;
    }
    easy += condition < 100.0;
    hard += condition > 1e8;
    // Products of three of these rows have more digits than a double.
    for (int row = 0; row < 3; ++row)
    {
      both.multiply(row, factor(random));
    }
    const int scale = n % 3 == 0 ? exponent(random) : 0;
    const glm::dmat3 inverse = svo::stableInverse(std::ldexp(1.0, scale) * both.matrix);
    const glm::dmat3 error = std::ldexp(1.0, scale) * inverse - both.inverse;
    ASSERT_LE(largest(error), std::ldexp(largest(both.inverse), -51))
      << "condition " << condition << ", 2^" << scale;
  }
  EXPECT_GT(easy, 1000);
  EXPECT_GT(hard, 1000);
}

TEST(Inverse, IsNotFiniteWhereThereIsNone)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const glm::dmat3 flat(1, 2, 3, 4, 5, 6, 0, 0, 0), zero(0.0);
  for (const glm::dmat3& m :
    { flat, zero, glm::dmat3(1, 0, 0, 0, nan, 0, 0, 0, 1), glm::dmat3(infinity) })
  {
    EXPECT_FALSE(std::isfinite(largest(svo::stableInverse(m)))) << glm::dvec3(m[0]).x;
    EXPECT_FALSE(svo::placesSomething(glm::dmat4(m)));
  }
  EXPECT_TRUE(svo::placesSomething(glm::dmat4(1e-200)));
  EXPECT_TRUE(svo::placesSomething(glm::dmat4(1e200)));
}
