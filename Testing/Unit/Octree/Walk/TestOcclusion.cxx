// Rays of which only is asked whether they meet anything: against single rays in double and against
// the block queries, on every instruction set of this machine.
#define HWY_WANT_AVX3_DL 1 // as svoOcclusion.cxx does
#include "svoInstructionSets.h"
#include "svoIntersect.h"
#include "svoLeafTraits.h"
#include "svoOcclusion.h"
#include "svoSurface.h"
#include "svoTestFields.h"
#include "svoTestScenes.h"
#include "svoTriangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iostream>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

namespace
{
using namespace svo;

using Words = std::array<std::uint64_t, OcclusionRays::Most / 64>;

void setRay(OcclusionRays& rays, int i, const Ray& ray)
{
  rays.originX[i] = static_cast<float>(ray.origin.x);
  rays.originY[i] = static_cast<float>(ray.origin.y);
  rays.originZ[i] = static_cast<float>(ray.origin.z);
  rays.directionX[i] = static_cast<float>(ray.direction.x);
  rays.directionY[i] = static_cast<float>(ray.direction.y);
  rays.directionZ[i] = static_cast<float>(ray.direction.z);
  rays.tMax[i] = static_cast<float>(ray.tMax);
}

Ray getRay(const OcclusionRays& rays, int i)
{
  Ray ray;
  ray.origin = { rays.originX[i], rays.originY[i], rays.originZ[i] };
  ray.direction = { rays.directionX[i], rays.directionY[i], rays.directionZ[i] };
  ray.tMax = rays.tMax[i];
  return ray;
}

bool metBy(const Words& words, int i)
{
  return words[i / 64] >> i % 64 & 1;
}

/// Of many lengths; a tenth along axes or diagonals.
std::unique_ptr<OcclusionRays> randomRays(const Octree& octree, int count, unsigned seed)
{
  svotest::RandomRays random(octree, seed);
  auto rays = std::make_unique<OcclusionRays>();
  rays->count = count;
  for (int i = 0; i < count; ++i)
  {
    Ray ray = random.next();
    ray.tMax = random.unit() < 0.5 ? std::numeric_limits<float>::max() : random.unit();
    for (int a = 0; a < 3 && i % 10 == 0; ++a)
    {
      ray.direction[a] = std::round(2.0 * random.unit() - 1.0);
    }
    setRay(*rays, i, ray);
  }
  return rays;
}

Words ask(const Octree& octree, const OcclusionRays& rays, const TraceOptions& options = {})
{
  Words words;
  words.fill(~std::uint64_t(0)); // whatever was there before
  occluded(octree, rays, options, words.data());
  return words;
}

/// The same by the block queries.
Words askBlocks(const Octree& octree, const OcclusionRays& rays, const TraceOptions& options = {})
{
  Words words{};
  for (int first = 0; first < rays.count; first += RayBlock::Size)
  {
    RayBlock block;
    HitBlock hits;
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      const Ray ray = getRay(rays, std::min(first + i, rays.count - 1));
      block.aim(i, ray.origin, ray.direction);
      block.tMin[i] = 0.0f;
      block.tMax[i] = first + i < rays.count ? static_cast<float>(ray.tMax) : -1.0f;
    }
    intersect(octree, block, options, hits);
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      words[first / 64] |= std::uint64_t(hits.primitive[i] != NoPrimitive) << i;
    }
  }
  return words;
}

void expectSame(const Words& expected, const Words& found, int count)
{
  int differing = 0;
  for (int i = 0; i < count; ++i)
  {
    differing += metBy(expected, i) != metBy(found, i);
  }
  EXPECT_EQ(differing, 0);
}

std::vector<Octree> meshes()
{
  return { svotest::makeOctree(svotest::torus(60, 40), 8),
    svotest::makeOctree(svotest::sphere(40, 200), 7), // its poles' lists are long
    svotest::makeOctree(svotest::soup(300, 0.2, 7), 7),
    svotest::makeOctree(svotest::soup(1500, 0.3, 5), 3) };
}

TEST(Occlusion, RaysMeetWhatSingleRaysInDoubleMeet)
{
  int rays = 0, met = 0, differing = 0;
  for (const Octree& octree : meshes())
  {
    for (const LeafGeometry geometry : { LeafGeometry::Triangle, LeafGeometry::Automatic })
    {
      TraceOptions options;
      options.leafGeometry = geometry;
      if (geometry == LeafGeometry::Automatic && octree.longestList() > ShortList)
      {
        continue; // of planes single rays in float say something else more often
      }
      for (unsigned seed = 0; seed < 100; ++seed)
      {
        const auto batch = randomRays(octree, OcclusionRays::Most, seed);
        const Words found = ask(octree, *batch, options);
        for (int i = 0; i < batch->count; ++i, ++rays)
        {
          const bool expected = occluded(octree, getRay(*batch, i), options);
          met += expected;
          differing += expected != metBy(found, i);
        }
      }
    }
  }
  std::cout << "of " << rays << " rays " << met << " met something, " << differing
            << " something else than in double\n";
  RecordProperty("differing", differing);
  EXPECT_GT(met, rays / 5);
  EXPECT_LT(met, rays * 4 / 5);
  EXPECT_LE(differing, rays / 100000); // that graze an edge, or end on a triangle
}

TEST(Occlusion, AnswersAreThoseOfTheBlockQueriesOnEveryInstructionSet)
{
  const std::vector<Octree> octrees = meshes();
  const auto forEach = [&](auto&& visit)
  {
    for (const Octree& octree : octrees)
    {
      for (const LeafGeometry geometry : { LeafGeometry::Voxel, LeafGeometry::Plane,
             LeafGeometry::Triangle, LeafGeometry::Automatic })
      {
        for (int level = octree.level() - 3; level <= octree.level(); ++level)
        {
          TraceOptions options;
          options.leafGeometry = geometry;
          options.level = level;
          for (const int count : { 1, 63, 64, 200, OcclusionRays::Most })
          {
            visit(octree, *randomRays(octree, count, 3 + count), options);
          }
        }
      }
    }
  };
  std::vector<Words> expected;
  forEach([&](const Octree& octree, const OcclusionRays& rays, const TraceOptions& options)
    { expected.push_back(askBlocks(octree, rays, options)); });
  svotest::onEveryInstructionSet(
    [&]
    {
      std::size_t k = 0;
      forEach([&](const Octree& octree, const OcclusionRays& rays, const TraceOptions& options)
        { expectSame(expected[k++], ask(octree, rays, options), rays.count); });
    });
}

TEST(Occlusion, WhatIsMetIsNamed)
{
  svotest::onEveryInstructionSet(
    [&]
    {
      int met = 0, others = 0;
      for (const Octree& octree : meshes())
      {
        const Surface& surface = *octree.surface();
        for (unsigned seed = 0; seed < 20; ++seed)
        {
          const auto rays = randomRays(octree, OcclusionRays::Most, seed);
          Words words;
          std::vector<Primitive> by(rays->count, NoPrimitive);
          occluded(
            octree, *rays, { LeafGeometry::Triangle, MaximumLevel }, words.data(), by.data());
          for (int i = 0; i < rays->count; ++i)
          {
            if (metBy(words, i))
            {
              const Ray ray = getRay(*rays, i);
              ASSERT_LT(by[i], surface.triangles.size());
              const glm::uvec3 t = surface.triangles[by[i]];
              double at;
              ++met;
              others += !(intersectTriangle(ShearedRay<double>(ray.origin, ray.direction),
                            surface.points[t.x], surface.points[t.y], surface.points[t.z], at) &&
                at >= 0.0 && at <= ray.tMax);
            }
          }
        }
      }
      EXPECT_GT(met, 10000);
      EXPECT_LE(others, met / 20000); // that graze an edge, or end on a triangle
    });
}

TEST(Occlusion, AnswersDoNotDependOnTheOtherRays)
{
  std::mt19937 random(4);
  svotest::onEveryInstructionSet(
    [&]
    {
      for (const Octree& octree : meshes())
      {
        const auto rays = randomRays(octree, OcclusionRays::Most, 8);
        const Words together = ask(octree, *rays);
        std::vector<int> order(rays->count);
        std::iota(order.begin(), order.end(), 0);
        std::shuffle(order.begin(), order.end(), random);
        for (int first = 0; first < rays->count;)
        {
          auto some = std::make_unique<OcclusionRays>();
          some->count = std::min(1 + static_cast<int>(random() % 100), rays->count - first);
          for (int i = 0; i < some->count; ++i)
          {
            setRay(*some, i, getRay(*rays, order[first + i]));
          }
          const Words apart = ask(octree, *some);
          for (int i = 0; i < some->count; ++i)
          {
            EXPECT_EQ(metBy(apart, i), metBy(together, order[first + i]));
          }
          first += some->count;
        }
      }
    });
}

TEST(Occlusion, RaysThatGoNowhereMeetNothingAndDoNotDisturbTheirNeighbours)
{
  const Octree octree = svotest::makeOctree(svotest::sphere(20, 20), 6);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  OcclusionRays rays;
  rays.count = 200;
  for (int i = 0; i < rays.count; ++i)
  {
    Ray ray;
    ray.origin = glm::dvec3(1.5);
    ray.direction = { std::cos(i), std::sin(i), 0.1 };
    ray.tMax = infinity;
    setRay(rays, i, ray);
  }
  const auto spoil = [&](int i)
  {
    switch (i / 2 % 8)
    {
      case 0:
        rays.originX[i] = nan;
        break;
      case 1:
        rays.directionY[i] = nan;
        break;
      case 2:
        rays.tMax[i] = nan;
        break;
      case 3:
        rays.tMax[i] = -1.0f;
        break;
      case 4:
        rays.directionZ[i] = infinity;
        break;
      case 5:
        rays.originZ[i] = -infinity;
        break;
      case 6:
        rays.originZ[i] = 1e30f;
        break;
      default:
        rays.directionX[i] = rays.directionY[i] = rays.directionZ[i] = 0.0f;
        break;
    }
  };
  for (int i = 0; i < rays.count; i += 2)
  {
    spoil(i);
  }
  svotest::onEveryInstructionSet(
    [&]
    {
      const Words found = ask(octree, rays);
      for (int i = 0; i < rays.count; ++i)
      {
        EXPECT_EQ(metBy(found, i), i % 2 == 1) << i;
      }
    });
}

TEST(Occlusion, EmptyOctreesAndNoRaysMeetNothing)
{
  const Octree empty = svotest::makeOctree(std::vector<glm::ivec3>{}, 4);
  const Octree full = svotest::makeOctree(svotest::torus(20, 20), 5);
  ASSERT_TRUE(empty);
  const auto rays = randomRays(full, 130, 1);
  svotest::onEveryInstructionSet(
    [&]
    {
      for (const Octree& octree : { Octree(), empty })
      {
        const Words found = ask(octree, *rays);
        EXPECT_EQ(found[0] | found[1] | found[2], 0u);
        EXPECT_EQ(found[3], ~std::uint64_t(0)); // nobody's
      }
      OcclusionRays none;
      EXPECT_EQ(ask(full, none)[0], ~std::uint64_t(0));
    });
}

TEST(Occlusion, OctreesOfPlanesAndOfCubesAreAskedAsBlocks)
{
  const Octree planes =
    svotest::octreeOfField(svotest::SphereField(0.7), svotest::boxOfInterest(6));
  const Octree cubes =
    svotest::makeOctree({ glm::ivec3(3), glm::ivec3(9, 4, 5), glm::ivec3(12, 13, 2) }, 4);
  svotest::onEveryInstructionSet(
    [&]
    {
      for (const Octree& octree : { planes, cubes })
      {
        const auto rays = randomRays(octree, OcclusionRays::Most, 6);
        const Words found = ask(octree, *rays);
        EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](std::uint64_t w) { return w; }));
        expectSame(askBlocks(octree, *rays), found, rays->count);
      }
    });
}
}
