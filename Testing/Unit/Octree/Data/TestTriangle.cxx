// The watertight intersection of a ray and a triangle.
#include "svoTriangle.h"

#include <gtest/gtest.h>

#include <glm/vec2.hpp>

TEST(TriangleIntersection, MeetsTheTriangleFromBothSides)
{
  const glm::vec3 a(0.0f, 0.0f, 2.0f), b(1.0f, 0.0f, 2.0f), c(0.0f, 1.0f, 2.0f);
  for (double side : { -1.0, 1.0 })
  {
    const svo::ShearedRay<double> ray({ 0.25, 0.25, 2.0 + 3.0 * side }, { 0.0, 0.0, -0.5 * side });
    double t = 0.0;
    ASSERT_TRUE(svo::intersectTriangle(ray, a, b, c, t));
    EXPECT_EQ(t, 6.0);
    ASSERT_TRUE(svo::intersectTriangle(ray, c, b, a, t));
    EXPECT_EQ(t, 6.0);
  }
  double t = 0.0;
  const svo::ShearedRay<double> past({ 0.75, 0.75, 0.0 }, { 0.0, 0.0, 1.0 });
  EXPECT_FALSE(svo::intersectTriangle(past, a, b, c, t));
}

TEST(TriangleIntersection, ARayThroughASharedEdgeOrVertexHitsEveryTriangleThatHasIt)
{
  const glm::vec3 a(0.0f, 0.0f, 1.0f), b(1.0f, 0.0f, 1.0f), c(0.0f, 1.0f, 1.0f),
    d(1.0f, 1.0f, 1.0f);
  for (const glm::vec2& p : { glm::vec2(0.5f, 0.5f), glm::vec2(1.0f, 0.0f), glm::vec2(0.0f, 1.0f) })
  {
    const svo::ShearedRay<float> ray({ p.x, p.y, 0.0f }, { 0.0f, 0.0f, 1.0f });
    float t = 0.0f;
    EXPECT_TRUE(svo::intersectTriangle(ray, a, b, c, t));
    EXPECT_TRUE(svo::intersectTriangle(ray, b, d, c, t));
  }
}

TEST(TriangleIntersection, EdgeOnAndDegenerateTrianglesAreMissed)
{
  const svo::ShearedRay<float> ray({ 0.0f, 0.0f, 0.0f }, { 0.0f, 0.0f, 1.0f });
  float t = 0.0f;
  EXPECT_FALSE(
    svo::intersectTriangle(ray, { 0, -1, 1 }, { 0, 1, 1 }, { 0, 0, 2 }, t)); // contains the ray
  EXPECT_FALSE(svo::intersectTriangle(ray, { -1, 0, 1 }, { 1, 0, 1 }, { 0, 0, 1 }, t));
  EXPECT_FALSE(svo::intersectTriangle(ray, { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 }, t));
}

TEST(TriangleIntersection, TheSignOfADifferenceOfProductsIsExact)
{
  const float a = 1.0f + 1.0f / (1 << 20), b = 1.0f - 1.0f / (1 << 20);
  EXPECT_EQ(a * b, 1.0f); // rounding hides that a b < 1
  EXPECT_LT(svo::differenceOfProducts(a, b, 1.0f, 1.0f), 0.0f);
  EXPECT_GT(svo::differenceOfProducts(1.0f, 1.0f, a, b), 0.0f);
  EXPECT_EQ(svo::differenceOfProducts(a, b, b, a), 0.0f);
}
