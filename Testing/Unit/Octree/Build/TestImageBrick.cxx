// Voxels no larger than the cells of an image, and their planes, beside the trilinear field itself.
#include "svoImageBrick.h"
#include "svoImageSource.h"
#include "svoMorton.h"
#include "svoNode.h"
#include "svoParallel.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace
{
constexpr int Points = 12;
constexpr double Value = 40.0;

struct TestImage
{
  svo::ImageGrid grid;
  std::vector<float> values;
  explicit TestImage(const glm::dvec3& scale)
    : values(Points * Points * Points)
  {
    grid.points = glm::ivec3(Points);
    grid.toIndex = glm::dmat4(1.0);
    for (int a = 0; a < 3; ++a)
    {
      grid.toIndex[a][a] = scale[a];
      grid.toIndex[3][a] = scale[a] < 0.0 ? Points - 1.0 : 0.0;
    }
    std::mt19937 random(3);
    for (float& v : values)
    {
      v = static_cast<float>(random() % 81); // some are the value
    }
  }
};

/// Of the points that have a part in it: those with a weight of 0 may be NaN.
double valueAt(const TestImage& image, const glm::dvec3& local)
{
  glm::ivec3 cell;
  glm::dvec3 in;
  image.grid.locate(local, cell, in);
  double sum = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    const glm::ivec3 upper(i & 1, i >> 1 & 1, i >> 2), c = cell + upper;
    const glm::dvec3 w = glm::mix(1.0 - in, in, glm::dvec3(upper));
    const double weight = w.x * w.y * w.z;
    sum += weight > 1e-6 ? weight * image.values[image.grid.index(c.x, c.y, c.z)] : 0.0;
  }
  return sum;
}

/// From the definition: the extremes are at corners, and where borders of cells cut the voxel.
bool passes(const TestImage& image, const glm::dvec3& low, double edge)
{
  const svo::ImageGrid& grid = image.grid;
  std::vector<double> at[3];
  for (int a = 0; a < 3; ++a)
  {
    const double scale = grid.toIndex[a][a], first = grid.toIndex[3][a];
    const double ends[2] = { (0.0 - first) / scale, (Points - 1.0 - first) / scale };
    const double begin = std::min(ends[0], ends[1]), end = std::max(ends[0], ends[1]);
    at[a] = { std::max(low[a], begin), std::min(low[a] + edge, end) };
    for (int i = 0; i < Points; ++i)
    {
      const double border = (i - first) / scale;
      if (border > at[a][0] + 1e-5 && border < at[a][1] - 1e-5)
      {
        at[a].push_back(border);
      }
    }
  }
  bool above = false, below = false;
  for (const double x : at[0])
  {
    for (const double y : at[1])
    {
      for (const double z : at[2])
      {
        const double v = valueAt(image, { x, y, z });
        (v >= Value ? above : below) = true;
        if (!std::isfinite(v))
        {
          return false;
        }
      }
    }
  }
  return above && below;
}
}

TEST(ImageBrick, HasTheVoxelsThatTheFieldPasses)
{
  // Voxels as large as cells, parts of them, cut by their borders, and against the axes.
  const glm::dvec3 scales[] = { { 1.0, 1.0, 1.0 }, { 0.5, 0.5, 0.5 }, { 1.0, 0.7, 0.4 },
    { 0.93, 0.93, 0.93 }, { -1.0, 0.6, -0.81 } };
  for (const glm::dvec3& scale : scales)
  {
    TestImage image(scale);
    image.values[5 * Points * Points + 6 * Points + 7] = std::numeric_limits<float>::quiet_NaN();
    const svo::ImageField<float> field(image.grid, image.values.data());
    const svo::ValuePyramid pyramid(image.grid, field, svo::serialFor);
    const svo::ImageSource source(field, image.grid, pyramid, { Value });
    ASSERT_TRUE(svo::ImageBrick::ready(image.grid, 0.5));
    std::size_t occupied = 0, differ = 0, planesOff = 0;
    for (int b = 0; b < 8 * 8 * 8; ++b)
    {
      const svo::SourceBrick brick{ 4.0 * glm::dvec3(b % 8, b / 8 % 8, b / 64), 0.5, ~0ull };
      svo::SourcePlane planes[64];
      const std::uint64_t mask = source.planesIn(brick, planes);
      for (int i = 0; i < 64; ++i)
      {
        const glm::dvec3 low = brick.low + glm::dvec3(svo::cellOfIndex(i));
        glm::ivec3 cell;
        glm::dvec3 in;
        const bool inside = image.grid.locate(low + 0.5, cell, in);
        const bool occupiedHere = (mask & svo::cellBit(i)) != 0;
        occupied += occupiedHere;
        differ += occupiedHere != (inside && passes(image, low, 1.0));
        if (occupiedHere)
        {
          // The plane is through the voxel.
          const glm::dvec3 n = glm::abs(planes[i].normal);
          planesOff += !(std::abs(glm::length(planes[i].normal) - 1.0) < 1e-9) ||
            std::abs(planes[i].offset) > 0.5 * (n.x + n.y + n.z) * (1.0 + 1e-9);
        }
      }
    }
    EXPECT_GT(occupied, 1000u);
    EXPECT_EQ(differ, 0u);
    EXPECT_EQ(planesOff, 0u);
  }
  EXPECT_FALSE(svo::ImageBrick::ready(TestImage({ 1.0, 1.2, 1.0 }).grid, 0.5));
}

TEST(ImageBrick, OfALinearFieldTheSurfaceIsThePlane)
{
  TestImage image({ 0.8, -0.5, 0.97 });
  const glm::dvec3 slope(3.0, -1.5, 2.25);
  const auto at = [&](const glm::dvec3& local) { return Value + glm::dot(slope, local - 7.3); };
  for (int i = 0; i < Points * Points * Points; ++i)
  {
    const glm::dvec3 index(i % Points, i / Points % Points, i / (Points * Points));
    glm::dvec3 local;
    for (int a = 0; a < 3; ++a)
    {
      local[a] = (index[a] - image.grid.toIndex[3][a]) / image.grid.toIndex[a][a];
    }
    image.values[static_cast<std::size_t>(i)] = static_cast<float>(at(local));
  }
  const svo::ImageField<float> field(image.grid, image.values.data());
  const svo::ValuePyramid pyramid(image.grid, field, svo::serialFor);
  const svo::ImageSource source(field, image.grid, pyramid, { Value });
  const svo::SourceBrick brick{ glm::dvec3(5.1, 5.4, 5.6), 0.5, 0x00ffffffffffffffull };
  svo::SourcePlane planes[64];
  const std::uint64_t mask = source.planesIn(brick, planes);
  EXPECT_EQ(mask >> 56, 0u) << "not asked for";
  ASSERT_NE(mask, 0u);
  for (int i = 0; i < 64; ++i)
  {
    if (mask & svo::cellBit(i))
    {
      const glm::dvec3 centre = brick.low + 0.5 + glm::dvec3(svo::cellOfIndex(i));
      EXPECT_NEAR(glm::dot(planes[i].normal, glm::normalize(slope)), 1.0, 1e-5);
      EXPECT_NEAR(at(centre + planes[i].offset * planes[i].normal), Value, 1e-4);
    }
  }
}
