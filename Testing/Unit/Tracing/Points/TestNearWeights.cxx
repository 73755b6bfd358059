// Barycentric coordinates in single precision, also of triangles that are long and thin.
#include "svoPointLane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include <glm/geometric.hpp>

TEST(NearWeights, AreOffByRoundingsTimesTheTrianglesSlenderness)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> direction;
  for (const double slenderness : { 1.0, 30.0, 1000.0, 30000.0 })
  {
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i)
    {
      // A triangle of length 1; where on it its far corner lies is arbitrary.
      const glm::dvec3 along =
        glm::normalize(glm::dvec3(direction(random), direction(random), direction(random)));
      const glm::dvec3 beside = glm::normalize(
        glm::cross(along, glm::dvec3(direction(random), direction(random), direction(random))));
      const glm::vec3 e1(along);
      const glm::vec3 e2(unit(random) * along + beside / slenderness);
      glm::dvec3 expected(0.0, unit(random), unit(random));
      if (expected.y + expected.z > 1.0)
      {
        expected.y = 1.0 - expected.y;
        expected.z = 1.0 - expected.z;
      }
      expected.x = 1.0 - expected.y - expected.z;
      const glm::vec3 p(expected.y * glm::dvec3(e1) + expected.z * glm::dvec3(e2));
      const glm::dvec3 difference = glm::dvec3(svo::nearWeights(p, e1, e2)) - expected;
      worst =
        std::max({ worst, std::abs(difference.x), std::abs(difference.y), std::abs(difference.z) });
    }
    EXPECT_LT(worst, 1e-6 * slenderness) << slenderness;
  }
}

TEST(NearWeights, APointBesideTheTriangleTakesOneOnIt)
{
  const glm::vec3 e1(2, 0, 0), e2(0, 1, 0);
  EXPECT_EQ(svo::nearWeights({ -1, -1, 0.5 }, e1, e2), glm::vec3(1, 0, 0));
  EXPECT_EQ(svo::nearWeights({ 5, -1, 0.5 }, e1, e2), glm::vec3(0, 1, 0));
  EXPECT_EQ(svo::nearWeights({ -1, 5, 0.5 }, e1, e2), glm::vec3(0, 0, 1));
}

TEST(NearWeights, ATriangleWithoutAreaIsItsFirstCorner)
{
  const glm::vec3 e(1, 2, 3);
  EXPECT_EQ(svo::nearWeights({ 0.5f, 1, 1.5f }, e, e), glm::vec3(1, 0, 0));
}
