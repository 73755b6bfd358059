// Representative triangles that are kept: of voxels that were never asked for, asked for before,
// and asked for by several threads at once.
#include "svoInstructionSets.h"
#include "svoIntersect.h"
#include "svoTestScenes.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace
{
using namespace svo;

std::vector<RayBlock> makeBlocks(const Octree& octree, int count)
{
  svotest::RandomRays rays(octree, 17);
  std::vector<RayBlock> blocks(count);
  for (RayBlock& block : blocks)
  {
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      const Ray ray = rays.next();
      block.aim(i, ray.origin, ray.direction);
      block.tMin[i] = static_cast<float>(ray.tMin);
      block.tMax[i] = static_cast<float>(ray.tMax);
    }
  }
  return blocks;
}

/// Rays whose triangle is not the scalar walk's.
int countDifferences(
  const Octree& octree, const std::vector<RayBlock>& blocks, const TraceOptions& options)
{
  int count = 0;
  for (const RayBlock& block : blocks)
  {
    HitBlock expected, found;
    intersectBlockScalar(octree, block, options, expected);
    intersect(octree, block, options, found);
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      count += expected.primitive[i] != found.primitive[i];
    }
  }
  return count;
}

/// Voxels of which the triangle is known; all of them are found to be right.
int countKept(const Octree& octree)
{
  const BrickRepresentatives& kept = octree.representatives();
  int count = 0;
  for (std::uint32_t brick = octree.brickBegin(); brick < octree.header().nodeCount; ++brick)
  {
    std::uint32_t length = 0;
    std::uint32_t id = 0;
    octree.brickTriangles(brick, length, id);
    for (int i = 0; i < childCount(octree.nodes()[brick]); ++i)
    {
      const int place = kept.place(kept.voxel(brick, i));
      EXPECT_LT(place, static_cast<int>(length));
      count += place >= 0;
    }
  }
  return count;
}

TEST(BrickRepresentatives, AreTheScalarWalksBeforeAndAfterTheyAreKnown)
{
  svotest::onEveryInstructionSet(
    []
    {
      for (const LeafGeometry geometry : { LeafGeometry::Voxel, LeafGeometry::Plane })
      {
        TraceOptions options;
        options.leafGeometry = geometry;
        const Octree octree = svotest::makeOctree(svotest::soup(500, 0.2, 9), 6);
        const std::vector<RayBlock> blocks = makeBlocks(octree, 16);
        EXPECT_EQ(countKept(octree), 0);
        EXPECT_EQ(countDifferences(octree, blocks, options), 0);
        const int kept = countKept(octree);
        if (vectorLanes() >= 8)
        {
          EXPECT_GT(kept, 100);
        }
        EXPECT_EQ(countDifferences(octree, blocks, options), 0);
        EXPECT_EQ(countKept(octree), kept);
        // What is kept of voxels says nothing of the cells above them.
        options.level = 5;
        EXPECT_EQ(countDifferences(octree, blocks, options), 0);
        EXPECT_EQ(countKept(octree), kept);
      }
    });
}

TEST(BrickRepresentatives, AreTheSameForThreadsThatAskAtOnce)
{
  const Octree octree = svotest::makeOctree(svotest::soup(500, 0.2, 9), 6);
  const std::vector<RayBlock> blocks = makeBlocks(octree, 32);
  std::vector<int> differences(4, -1);
  std::vector<std::thread> threads;
  for (int& count : differences)
  {
    threads.emplace_back([&] { count = countDifferences(octree, blocks, TraceOptions{}); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(differences, std::vector<int>(4, 0));
}

TEST(BrickRepresentatives, NoneWithoutASurface)
{
  const Octree octree = svotest::makeOctree({ glm::ivec3(0), glm::ivec3(3, 2, 1) }, 4);
  ASSERT_TRUE(octree);
  EXPECT_FALSE(octree.representatives());
  EXPECT_EQ(octree.representatives().bytes(), 0u);
}
}
