// Block queries against the scalar walk, bit for bit, on every instruction set of this machine.
#include "svoIntersect.h"
#include "svoTestScenes.h"

#include <gtest/gtest.h>

#define HWY_WANT_AVX3_DL 1 // as svoIntersectBlock.cxx does
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace
{
using namespace svo;

constexpr LeafGeometry Geometries[] = { LeafGeometry::Voxel, LeafGeometry::Plane,
  LeafGeometry::Triangle, LeafGeometry::Automatic };

/// Calls f once for each instruction set that was compiled and that the machine has.
template <class F>
void onEveryInstructionSet(F&& f)
{
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
  {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    SCOPED_TRACE(hwy::TargetName(target));
    ASSERT_STREQ(instructionSet(), hwy::TargetName(target));
    f();
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

void setRay(RayBlock& block, int i, const Ray& ray)
{
  block.aim(i, ray.origin, ray.direction);
  block.tMin[i] = static_cast<float>(ray.tMin);
  block.tMax[i] = static_cast<float>(ray.tMax);
}

std::vector<RayBlock> randomBlocks(const Octree& octree, int count, unsigned seed)
{
  svotest::RandomRays rays(octree, seed);
  std::vector<RayBlock> blocks(count);
  for (RayBlock& block : blocks)
  {
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      Ray ray = rays.next();
      if (rays.unit() < 0.2)
      {
        ray.tMin = rays.unit();
        ray.tMax = 0.2 + rays.unit();
      }
      setRay(block, i, ray);
    }
  }
  return blocks;
}

/// Rays that are parallel to axes or diagonals and lie on faces, edges and corners of cells.
std::vector<RayBlock> alignedBlocks(const Octree& octree, int count, unsigned seed)
{
  svotest::RandomRays rays(octree, seed);
  std::vector<RayBlock> blocks(count);
  for (RayBlock& block : blocks)
  {
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      Ray ray = rays.next();
      const double grid = std::ldexp(1.0, 1 + static_cast<int>(rays.unit() * octree.level()));
      for (int a = 0; a < 3; ++a)
      {
        if (rays.unit() < 0.7)
        {
          ray.origin[a] = std::round(ray.origin[a] * grid) / grid;
        }
        const double choice = rays.unit();
        if (choice < 0.7)
        {
          ray.direction[a] = choice < 0.3 ? 0.0 : choice < 0.5 ? 0.5 : -0.5;
        }
        if (choice > 0.95)
        {
          ray.direction[a] = -0.0;
        }
      }
      ray.tMax = 100.0;
      setRay(block, i, ray);
    }
  }
  return blocks;
}

/// Tiles of 8x8 neighbouring pixels of a camera that sees all of the cube.
std::vector<RayBlock> cameraBlocks(const Octree& octree, int tiles)
{
  const double edge = octree.level() % 2 == 0 ? 1.0 : 0.5;
  std::vector<RayBlock> blocks(tiles * tiles);
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      const double n = 8.0 * tiles;
      const double x = (8.0 * (b % tiles) + i % 8 + 0.5) / n;
      const double y = (8.0 * (b / tiles) + i / 8 + 0.5) / n;
      Ray ray;
      ray.origin = 1.0 + edge * glm::dvec3(0.4, 0.7, 2.5);
      ray.direction = 1.0 + edge * glm::dvec3(x, y, 0.5) - ray.origin;
      ray.tMax = 100.0;
      setRay(blocks[b], i, ray);
    }
  }
  return blocks;
}

int countDifferences(const Octree& octree, const std::vector<RayBlock>& blocks,
  const TraceOptions& options, std::size_t& hitCount)
{
  int differences = 0;
  for (const RayBlock& block : blocks)
  {
    HitBlock expected, found;
    intersectBlockScalar(octree, block, options, expected);
    intersect(octree, block, options, found);
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      const bool hit = expected.primitive[i] != NoPrimitive;
      hitCount += hit;
      const bool same = expected.primitive[i] == found.primitive[i] &&
        (!hit || std::memcmp(&expected.t[i], &found.t[i], sizeof(float)) == 0);
      differences += !same;
    }
  }
  return differences;
}

void expectScalarResults(const Octree& octree, const std::vector<RayBlock>& blocks, int level)
{
  for (const LeafGeometry geometry : Geometries)
  {
    TraceOptions options;
    options.leafGeometry = geometry;
    options.level = level;
    std::size_t hits = 0;
    EXPECT_EQ(countDifferences(octree, blocks, options, hits), 0)
      << "leaf geometry " << static_cast<int>(geometry) << ", level " << level;
    EXPECT_GT(hits, 0u);
  }
}

TEST(IntersectBlock, NamesAnInstructionSetAndItsLanes)
{
  onEveryInstructionSet(
    []
    {
      const std::string name = instructionSet();
      const int lanes = vectorLanes();
      EXPECT_EQ(RayBlock::Size % lanes, 0);
      if (name == "AVX2")
      {
        EXPECT_EQ(lanes, 8);
      }
      if (name == "AVX3" || name == "AVX3_DL")
      {
        EXPECT_EQ(lanes, 16);
      }
    });
#if defined(__x86_64__) && defined(__GNUC__)
  // Were the file compiled for one plain instruction set only, this would be the first to notice.
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    EXPECT_GE(vectorLanes(), 8);
  }
#endif
}

TEST(IntersectBlock, RandomRaysHitWhatTheScalarWalkHitsAtEveryLevel)
{
  const Octree even = svotest::makeOctree(svotest::torus(40, 24), 8);
  const Octree odd = svotest::makeOctree(svotest::soup(300, 0.2, 7), 7);
  onEveryInstructionSet(
    [&]
    {
      for (const Octree& octree : { even, odd })
      {
        const std::vector<RayBlock> blocks = randomBlocks(octree, 8, 11);
        for (int level = 0; level <= octree.level() + 1; ++level)
        {
          expectScalarResults(octree, blocks, level);
        }
      }
    });
}

TEST(IntersectBlock, CoherentRaysHitWhatTheScalarWalkHits)
{
  // Large enough for the finest table of upper levels.
  const Octree octree = svotest::makeOctree(svotest::torus(120, 60), 10);
  ASSERT_EQ(octree.upperLevels().tableCount, UpperLevels::MaximumTables);
  const std::vector<RayBlock> blocks = cameraBlocks(octree, 4);
  onEveryInstructionSet(
    [&]
    {
      for (const int level : { 6, 7, 8, 9, 10 })
      {
        expectScalarResults(octree, blocks, level);
      }
    });
}

TEST(IntersectBlock, RaysOnFacesEdgesAndCornersHitWhatTheScalarWalkHits)
{
  const Octree octree = svotest::makeOctree(svotest::soup(200, 0.3, 5), 6);
  const std::vector<RayBlock> blocks = alignedBlocks(octree, 24, 3);
  onEveryInstructionSet(
    [&]
    {
      for (const int level : { 2, 3, 5, 6 })
      {
        expectScalarResults(octree, blocks, level);
      }
    });
}

TEST(IntersectBlock, DeepOctreesOfSingleVoxelsAreFound)
{
  const int edge = 1 << 20;
  const Octree octree = svotest::makeOctree(
    { glm::ivec3(0), glm::ivec3(edge - 1), glm::ivec3(12345, 654321, 777777) }, 20);
  ASSERT_TRUE(octree);
  RayBlock block;
  for (int i = 0; i < RayBlock::Size; ++i)
  {
    // The float nearest to the centre of the voxel, along an axis.
    Ray ray;
    ray.origin = 1.0 + (glm::dvec3(12345, 654321, 777777) + 0.5) / double(edge);
    ray.direction = glm::dvec3(0.0);
    ray.direction[i % 3] = i % 2 == 0 ? 1.0 : -1.0;
    ray.origin[i % 3] = i % 2 == 0 ? 0.5 : 2.5;
    ray.tMax = i < 32 ? 10.0 : 0.1;
    setRay(block, i, ray);
  }
  onEveryInstructionSet(
    [&]
    {
      std::size_t hits = 0;
      EXPECT_EQ(countDifferences(octree, { block }, TraceOptions{}, hits), 0);
      EXPECT_EQ(hits, 32u);
    });
}

TEST(IntersectBlock, DeadRaysMissAndDoNotDisturbTheirNeighbours)
{
  const Octree octree = svotest::makeOctree(svotest::sphere(20, 20), 6);
  RayBlock clean;
  for (int i = 0; i < RayBlock::Size; ++i)
  {
    Ray ray;
    ray.origin = { 1.0 + (i % 8 + 0.5) / 8.0, 1.0 + (i / 8 + 0.5) / 8.0, 3.0 };
    ray.direction = { 0.0, 0.0, -1.0 };
    ray.tMax = 10.0;
    setRay(clean, i, ray);
  }
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  RayBlock dirty = clean;
  for (int i = 0; i < RayBlock::Size; i += 2)
  {
    switch (i / 2 % 8)
    {
      case 0:
        dirty.originX[i] = nan;
        break;
      case 1:
        dirty.directionY[i] = nan;
        break;
      case 2:
        dirty.tMin[i] = nan;
        break;
      case 3:
        dirty.tMax[i] = nan;
        break;
      case 4:
        dirty.tMin[i] = 20.0f;
        break;
      case 5:
        dirty.directionZ[i] = infinity;
        break;
      case 6:
        dirty.originZ[i] = -infinity;
        break;
      default:
        dirty.directionZ[i] = 0.0f;
        break;
    }
  }
  onEveryInstructionSet(
    [&]
    {
      for (const LeafGeometry geometry : Geometries)
      {
        TraceOptions options;
        options.leafGeometry = geometry;
        HitBlock expected, found;
        intersect(octree, clean, options, expected);
        intersect(octree, dirty, options, found);
        for (int i = 0; i < RayBlock::Size; ++i)
        {
          if (i % 2 == 0)
          {
            EXPECT_EQ(found.primitive[i], NoPrimitive) << i;
          }
          else
          {
            EXPECT_EQ(found.primitive[i], expected.primitive[i]) << i;
            EXPECT_EQ(found.t[i], expected.t[i]) << i;
          }
        }
      }
    });
}

TEST(IntersectBlock, RaysFromInsideAClosedMeshNeverEscape)
{
  const Octree octree = svotest::makeOctree(svotest::sphere(40, 40), 9);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<RayBlock> blocks(200);
  for (RayBlock& block : blocks)
  {
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      Ray ray;
      ray.origin = glm::dvec3(1.25);
      ray.direction = { normal(random), normal(random), normal(random) };
      setRay(block, i, ray);
      block.tMax[i] = std::numeric_limits<float>::max();
    }
  }
  onEveryInstructionSet(
    [&]
    {
      for (const LeafGeometry geometry : Geometries)
      {
        TraceOptions options;
        options.leafGeometry = geometry;
        for (const RayBlock& block : blocks)
        {
          HitBlock hits;
          intersect(octree, block, options, hits);
          EXPECT_EQ(std::count(hits.primitive, hits.primitive + RayBlock::Size, NoPrimitive), 0);
        }
      }
    });
}

TEST(IntersectBlock, AnEmptyOctreeIsNeverHit)
{
  const Octree octree = svotest::makeOctree(std::vector<glm::ivec3>{}, 4);
  ASSERT_TRUE(octree);
  RayBlock block;
  for (int i = 0; i < RayBlock::Size; ++i)
  {
    Ray ray;
    ray.origin = { 1.1, 1.2, 0.5 };
    ray.direction = { 0.1, 0.2, 1.0 };
    ray.tMax = 10.0;
    setRay(block, i, ray);
  }
  HitBlock hits;
  intersect(octree, block, TraceOptions{}, hits);
  EXPECT_EQ(hits.primitive[0], NoPrimitive);
  hits.primitive[0] = 0;
  intersect(Octree(), block, TraceOptions{}, hits);
  EXPECT_EQ(hits.primitive[0], NoPrimitive);
}
}
