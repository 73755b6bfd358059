// The oracle itself: small enough to be compared with a loop over all voxels.
#include "svoReference.h"
#include "svoTestScenes.h"

#include <gtest/gtest.h>

namespace
{
std::vector<glm::ivec3> noise(int level, double share, unsigned seed)
{
  std::mt19937 random(seed);
  std::bernoulli_distribution full(share);
  std::vector<glm::ivec3> voxels;
  const int edge = 1 << level;
  for (int i = 0; i < edge * edge * edge; ++i)
  {
    if (full(random))
    {
      voxels.push_back({ i % edge, i / edge % edge, i / (edge * edge) });
    }
  }
  return voxels;
}
}

TEST(Reference, AnOctreeWithoutVoxelsIsAnEmptyRoot)
{
  const svo::ReferenceOctree octree = svo::makeReference(std::vector<glm::ivec3>{}, 3);
  ASSERT_EQ(octree.nodes.size(), 1u);
  EXPECT_EQ(octree.nodes[0], (std::array<int, 8>{}));
  EXPECT_FALSE(svo::intersect(octree, { -1.0, 1.5, 1.5 }, { 1.0, 0.0, 0.0 }, 0.0, 100.0).hit);
}

TEST(Reference, ANodeIsEightIntegers)
{
  const svo::ReferenceOctree octree = svo::makeReference({ { 0, 0, 0 }, { 3, 3, 3 } }, 2);
  ASSERT_EQ(octree.nodes.size(), 3u);
  EXPECT_EQ(octree.nodes[0], (std::array<int, 8>{ 1, 0, 0, 0, 0, 0, 0, 2 }));
  EXPECT_EQ(octree.nodes[1], (std::array<int, 8>{ -1, 0, 0, 0, 0, 0, 0, 0 }));
  EXPECT_EQ(octree.nodes[2], (std::array<int, 8>{ 0, 0, 0, 0, 0, 0, 0, -1 }));
}

TEST(Reference, FirstVoxelOnTheRayIsTheNearestOfAllVoxels)
{
  const int level = 4;
  const std::vector<glm::ivec3> voxels = noise(level, 0.02, 1);
  const svo::ReferenceOctree octree = svo::makeReference(voxels, level);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0.0, 16.0);
  int hits = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const glm::dvec3 target(unit(random), unit(random), unit(random));
    const glm::dvec3 start(unit(random), unit(random), unit(random));
    const glm::dvec3 origin = i % 2 ? start : 3.0 * (start - 8.0) + 8.0;
    const glm::dvec3 direction = target - origin;
    double nearest = 10.0;
    for (const glm::ivec3& voxel : voxels)
    {
      double enter = 0.0, leave = nearest;
      for (int a = 0; a < 3; ++a)
      {
        const double t0 = (voxel[a] - origin[a]) / direction[a];
        const double t1 = (voxel[a] + 1 - origin[a]) / direction[a];
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
      }
      nearest = enter < leave ? enter : nearest;
    }
    const svo::ReferenceHit hit = svo::intersect(octree, origin, direction, 0.0, 10.0);
    ASSERT_EQ(hit.hit, nearest < 10.0) << "ray " << i;
    if (hit.hit)
    {
      ++hits;
      ASSERT_NEAR(hit.t, nearest, 1e-12) << "ray " << i;
    }
  }
  EXPECT_GT(hits, 5000);
}

TEST(Reference, HoldsTheVoxelsOfAnOctreeAtEveryLevel)
{
  for (int level = 1; level <= 5; ++level)
  {
    const svo::Octree octree = svotest::makeOctree(noise(level, 0.1, 3), level);
    ASSERT_TRUE(octree);
    for (int stop = 1; stop <= level; ++stop)
    {
      const svo::ReferenceOctree reference = svo::makeReference(octree, stop);
      const int edge = 1 << stop;
      for (int i = 0; i < edge * edge * edge; ++i)
      {
        const glm::ivec3 cell(i % edge, i / edge % edge, i / (edge * edge));
        const svo::ReferenceHit hit =
          svo::intersect(reference, glm::dvec3(cell) + 0.5, { 1.0, 0.0, 0.0 }, 0.0, 0.25);
        ASSERT_EQ(hit.hit, octree.occupied(cell, stop)) << level << ' ' << stop << ' ' << i;
      }
    }
  }
}

TEST(Reference, ARayBetweenTwoVoxelsBelongsToTheUpperOne)
{
  const svo::ReferenceOctree octree = svo::makeReference({ { 0, 0, 0 }, { 2, 1, 0 } }, 2);
  const svo::ReferenceHit hit =
    svo::intersect(octree, { -1.0, 1.0, 0.5 }, { 1.0, 0.0, 0.0 }, 0.0, 10.0);
  ASSERT_TRUE(hit.hit);
  EXPECT_EQ(hit.voxel, glm::ivec3(2, 1, 0));
  EXPECT_EQ(hit.t, 3.0);
}

TEST(Reference, ARayThroughACornerCrossesItDiagonally)
{
  const svo::ReferenceOctree octree = svo::makeReference({ { 1, 0, 0 }, { 2, 2, 2 } }, 2);
  const svo::ReferenceHit up =
    svo::intersect(octree, { -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 }, 0.0, 10.0);
  ASSERT_TRUE(up.hit);
  EXPECT_EQ(up.voxel, glm::ivec3(2, 2, 2));
  const svo::ReferenceHit down =
    svo::intersect(octree, { 5.0, 5.0, 5.0 }, { -1.0, -1.0, -1.0 }, 0.0, 10.0);
  ASSERT_TRUE(down.hit);
  EXPECT_EQ(down.voxel, glm::ivec3(2, 2, 2));
  EXPECT_EQ(down.t, 2.0);
}
