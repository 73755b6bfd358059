// What boxes have in common with pieces of views, as corners: from which maps are fitted to what is
// seen.
#include "svoConvexParts.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace svotest;

namespace
{
const svo::View Eye = lookAt({ 0, -6, 4 }, 200, 150);

/// Corner i at the upper ends that its bits say.
svo::ConvexBody box(const glm::dvec3& low, const glm::dvec3& high)
{
  svo::ConvexBody body;
  for (int i = 0; i < 8; ++i)
  {
    body[i] = { i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z };
  }
  return body;
}
}

TEST(ConvexParts, WhatBoxesHaveInCommon)
{
  std::vector<glm::dvec3> points;
  svo::CommonPart({ box({ 1, 2, 3 }, { 9, 9, 9 }), box({ -9, -9, -9 }, { 3.5, 9, 9 }) })
    .add(box({ 0, 0, 0 }, { 4, 4, 4 }), points);
  ASSERT_FALSE(points.empty());
  glm::dvec3 low(1e9), high(-1e9);
  for (const glm::dvec3& p : points)
  {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  EXPECT_EQ(low, glm::dvec3(1, 2, 3));
  EXPECT_EQ(high, glm::dvec3(3.5, 4, 4));

  points.clear();
  svo::CommonPart({ box({ 0, 0, 0 }, { 1, 1, 1 }) }).add(box({ 2, 0, 0 }, { 3, 1, 1 }), points);
  EXPECT_TRUE(points.empty());
}

TEST(ConvexParts, AFlatBoxIsCutAsASurface)
{
  std::vector<glm::dvec3> points;
  const svo::ConvexBody flat = box({ -9, -9, 1 }, { 9, 9, 1 }),
                        cube = box({ 0, 0, 0 }, { 2, 3, 4 });
  svo::CommonPart({ cube }).add(flat, points);
  ASSERT_FALSE(points.empty());
  svo::CommonPart({ flat }).add(cube, points);
  svo::CommonPart({ flat }).add(box({ 0, 0, 1 }, { 2, 3, 1 }), points);
  for (const glm::dvec3& p : points)
  {
    EXPECT_EQ(p.z, 1.0);
    EXPECT_TRUE(p.x >= 0.0 && p.x <= 2.0 && p.y >= 0.0 && p.y <= 3.0);
  }
}

TEST(ConvexParts, APieceOfAViewHasWhatItSees)
{
  std::vector<glm::dvec3> points;
  const svo::ConvexBody piece = svo::pieceOf(Eye, 1.0, 100.0);
  svo::CommonPart({ piece }).add(box({ -1e6, -1e6, 0 }, { 1e6, 1e6, 0 }), points);
  ASSERT_FALSE(points.empty());
  for (const glm::dvec3& p : points)
  {
    const glm::dvec4 clip = Eye.viewToClip * Eye.worldToView * glm::dvec4(p, 1.0);
    EXPECT_LE(std::abs(clip.x), 1.000001 * clip.w);
    EXPECT_LE(std::abs(clip.y), 1.000001 * clip.w);
    EXPECT_NEAR(p.z, 0.0, 1e-9);
  }
}

// Of boxes within, across and beyond the piece.
TEST(ConvexParts, HaveAllThatAViewSeesOfABox)
{
  const double near = 2.0, far = 20.0;
  const svo::CommonPart seen({ svo::pieceOf(Eye, near, far) });
  const auto sees = [&](const glm::dvec3& p, double slack)
  {
    const glm::dvec4 clip = Eye.viewToClip * Eye.worldToView * glm::dvec4(p, 1.0);
    const double depth = -(Eye.worldToView * glm::dvec4(p, 1.0)).z;
    return depth >= near - slack && depth <= far + slack && std::abs(clip.x) <= clip.w + slack &&
      std::abs(clip.y) <= clip.w + slack;
  };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto anywhere = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  int within = 0, across = 0, beyond = 0;
  for (int n = 0; n < 2000; ++n)
  {
    const glm::dvec3 middle = 12.0 * anywhere();
    const double size = std::pow(10.0, unit(random));
    const glm::dvec3 x = size * anywhere(), y = size * anywhere(), z = size * anywhere();
    svo::ConvexBody body;
    for (int i = 0; i < 8; ++i)
    {
      body[i] = middle + (i & 1 ? x : -x) + (i & 2 ? y : -y) + (i & 4 ? z : -z);
    }
    std::vector<glm::dvec3> points;
    seen.add(body, points);
    glm::dvec3 low(1e9), high(-1e9);
    for (const glm::dvec3& p : points)
    {
      ASSERT_TRUE(sees(p, 1e-9));
      low = glm::min(low, p - 1e-9);
      high = glm::max(high, p + 1e-9);
    }
    int found = 0;
    for (int k = 0; k < 200; ++k)
    {
      const glm::dvec3 p = middle + unit(random) * x + unit(random) * y + unit(random) * z;
      if (sees(p, 0.0))
      {
        ++found;
        ASSERT_TRUE(glm::all(glm::lessThanEqual(low, p)) && glm::all(glm::lessThanEqual(p, high)));
      }
    }
    within += found == 200;
    across += found > 0 && found < 200;
    beyond += points.empty();
  }
  EXPECT_GT(within, 50);
  EXPECT_GT(across, 200);
  EXPECT_GT(beyond, 200);
}
