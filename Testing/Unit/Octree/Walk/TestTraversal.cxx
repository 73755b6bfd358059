// The walk of rays through the octree, against the reference and against loops over all voxels.
#include "svoTestTracers.h"

#include <gtest/gtest.h>

using namespace svotest;

namespace
{
const double NaN = std::numeric_limits<double>::quiet_NaN();
const double Infinity = std::numeric_limits<double>::infinity();
}

TEST(RayTraversal, RaysStopAtEveryOctreeLevel)
{
  for (int octreeLevel = 1; octreeLevel <= 8; ++octreeLevel)
  {
    const svo::Octree octree =
      makeOctree(noise(octreeLevel, 1 << std::max(1, octreeLevel), 20), octreeLevel);
    ASSERT_TRUE(octree);
    for (int level = 1; level <= octreeLevel; ++level)
    {
      Agreement a;
      compare(
        octree, svo::makeReference(octree, level), 3000, 100 * octreeLevel + level, traceDouble, a);
      EXPECT_GT(a.hits, 10);
      EXPECT_EQ(a.wrong + a.ties + a.missTies, 0) << octreeLevel << " at " << level;
    }
  }
}

TEST(RayTraversal, LevelZeroIsTheCubeItself)
{
  for (int octreeLevel = 1; octreeLevel <= 6; ++octreeLevel)
  {
    const svo::Octree octree = makeOctree({ { 0, 0, 0 } }, octreeLevel);
    const double edge = cellEdge(octree, 0);
    svo::Ray ray{ { 1.0 + 0.9 * edge, 1.0 + 0.8 * edge, 3.0 }, { 0.0, 0.0, -1.0 } };
    const svo::Hit hit = svo::intersect(octree, ray, { svo::LeafGeometry::Voxel, 0 });
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit.t, 2.0 - edge);
    EXPECT_EQ(hit.cell, glm::ivec3(0));
    ray.origin.x = 1.0 + 1.1 * edge;
    EXPECT_FALSE(svo::intersect(octree, ray, { svo::LeafGeometry::Voxel, 0 }));
  }
}

TEST(RayTraversal, VisitsEveryVoxelOnTheRayOnceFrontToBack)
{
  for (int level : { 3, 4, 5 })
  {
    const std::vector<glm::ivec3> voxels = noise(level, 400, level);
    const svo::Octree octree = makeOctree(voxels, level);
    const double edge = cellEdge(octree, level);
    const auto less = [](const glm::ivec3& a, const glm::ivec3& b)
    { return std::lexicographical_compare(&a.x, &a.x + 3, &b.x, &b.x + 3); };
    const std::set<glm::ivec3, decltype(less)> unique(voxels.begin(), voxels.end(), less);
    RandomRays random(octree, 31);
    for (int i = 0; i < 1000; ++i)
    {
      const svo::Ray ray = random.next();
      std::vector<glm::ivec3> expected;
      for (const glm::ivec3& voxel : unique)
      {
        double enter = ray.tMin, leave = ray.tMax;
        for (int a = 0; a < 3; ++a)
        {
          const double t0 = (1.0 + voxel[a] * edge - ray.origin[a]) / ray.direction[a];
          const double t1 = (1.0 + (voxel[a] + 1) * edge - ray.origin[a]) / ray.direction[a];
          enter = std::max(enter, std::min(t0, t1));
          leave = std::min(leave, std::max(t0, t1));
        }
        if (enter < leave)
        {
          expected.push_back(voxel);
        }
      }
      std::vector<glm::ivec3> visited;
      double last = 0.0;
      svo::ClippedRay<double> clipped;
      if (svo::clip(octree, ray.origin, ray.direction, ray.tMin, ray.tMax, clipped))
      {
        const svo::WalkEnd end = svo::walk(octree, clipped, level,
          [&](const svo::StopCell<double>& cell, double&)
          {
            EXPECT_GE(cell.tEnter, last);
            EXPECT_GE(cell.tExit, cell.tEnter);
            EXPECT_EQ(cell.above, 0);
            last = cell.tExit;
            visited.push_back(cell.cell);
            return svo::Visit::Continue;
          });
        EXPECT_EQ(end, svo::WalkEnd::Left);
      }
      std::sort(visited.begin(), visited.end(), less);
      ASSERT_EQ(visited, expected) << "level " << level << " ray " << i;
    }
  }
}

TEST(RayTraversal, ASkippedBrickIsNotVisitedAgain)
{
  const int level = 5;
  const svo::Octree octree = makeOctree(noise(level, 8000, 8), level);
  for (int stop : { level, level - 1, level - 2 })
  {
    RandomRays random(octree, 41);
    for (int i = 0; i < 2000; ++i)
    {
      const svo::Ray ray = random.next();
      svo::ClippedRay<double> clipped;
      if (!svo::clip(octree, ray.origin, ray.direction, ray.tMin, ray.tMax, clipped))
      {
        continue;
      }
      std::vector<std::uint32_t> all, skipping;
      svo::walk(octree, clipped, stop,
        [&](const svo::StopCell<double>& cell, double&)
        {
          if (all.empty() || all.back() != cell.node)
          {
            all.push_back(cell.node);
          }
          return svo::Visit::Continue;
        });
      svo::walk(octree, clipped, stop,
        [&](const svo::StopCell<double>& cell, double&)
        {
          skipping.push_back(cell.node);
          return svo::Visit::SkipBrick;
        });
      ASSERT_EQ(all, skipping);
    }
  }
}

TEST(RayTraversal, ALoweredEndStopsTheWalk)
{
  const svo::Octree octree = makeOctree({ { 0, 0, 0 }, { 5, 0, 0 }, { 9, 0, 0 } }, 4);
  svo::ClippedRay<double> ray;
  const glm::dvec3 origin(0.0, 1.01, 1.01), direction(1.0, 0.0, 0.0);
  ASSERT_TRUE(svo::clip(octree, origin, direction, 0.0, 9.0, ray));
  std::vector<int> visited;
  svo::walk(octree, ray, 4,
    [&](const svo::StopCell<double>& cell, double& tMax)
    {
      visited.push_back(cell.cell.x);
      tMax = 1.4; // between the second and the third
      return svo::Visit::Continue;
    });
  EXPECT_EQ(visited, (std::vector<int>{ 0, 5 }));
}

// All coordinates below are exact in float and in double, so that every tracer must agree with the
// reference without any tie: faces, edges, corners and diagonals.
TEST(RayTraversal, RaysOnFacesEdgesAndCornersHitTheReferencesVoxelExactly)
{
  for (int level : { 3, 4, 5 })
  {
    const svo::Octree octree = makeOctree(noise(level, 60, 50 + level), level);
    const svo::ReferenceOctree reference = svo::makeReference(octree, level);
    const double edge = cellEdge(octree, level);
    std::mt19937 random(60);
    std::uniform_int_distribution<int> coordinate(-8, 2 * (1 << level) + 8); // in half voxels
    std::uniform_int_distribution<int> sign(-1, 1);
    int hits = 0;
    for (int i = 0; i < 30000; ++i)
    {
      svo::Ray ray;
      for (int a = 0; a < 3; ++a)
      {
        ray.origin[a] = 1.0 + 0.5 * edge * coordinate(random);
        ray.direction[a] = sign(random);
      }
      ray.tMax = 4.0;
      if (ray.direction == glm::dvec3(0.0))
      {
        continue;
      }
      const svo::ReferenceHit expected = trace(octree, reference, ray);
      hits += expected.hit;
      for (const FoundCell& found :
        { traceDouble(octree, ray, level), traceFloat(octree, ray, level) })
      {
        ASSERT_EQ(found.hit, expected.hit) << "ray " << i;
        if (expected.hit)
        {
          ASSERT_EQ(found.cell, expected.voxel) << "ray " << i;
          ASSERT_EQ(found.t, expected.t) << "ray " << i;
        }
      }
    }
    EXPECT_GT(hits, 300);
  }
}

TEST(RayTraversal, RayAlongACellFaceHitsExactlyOneCell)
{
  // Two voxels side by side; the ray runs in the plane between them and belongs to the upper one.
  const svo::Octree octree = makeOctree({ { 4, 3, 4 }, { 4, 4, 4 } }, 4);
  for (double zero : { 0.0, -0.0, 5e-324, -1e-300 })
  {
    const svo::Ray ray{ { 0.5, 1.25, 1.27 }, { 1.0, zero, 0.0 } };
    const svo::Hit hit = svo::intersect(octree, ray, { svo::LeafGeometry::Voxel });
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit.cell, glm::ivec3(4, 4, 4));
  }
}

TEST(RayTraversal, UpperFacesOfTheCubeAreOutside)
{
  const svo::Octree octree = makeOctree({ { 0, 0, 0 }, { 3, 3, 3 } }, 2);
  const svo::TraceOptions options{ svo::LeafGeometry::Voxel };
  EXPECT_TRUE(svo::intersect(octree, { { 0.0, 1.0, 1.0 }, { 1.0, 0.0, 0.0 } }, options));
  EXPECT_FALSE(svo::intersect(octree, { { 0.0, 2.0, 1.9 }, { 1.0, 0.0, 0.0 } }, options));
}

TEST(RayTraversal, ARayThatStartsInAnOccupiedCellHitsItAtItsStart)
{
  const svo::Octree octree = makeOctree(sphere(20, 20), 8);
  const svo::ReferenceOctree reference = svo::makeReference(octree, 8);
  RandomRays random(octree, 70);
  int tried = 0;
  for (int i = 0; i < 20000; ++i)
  {
    svo::Ray ray = random.next();
    const svo::ReferenceHit first = trace(octree, reference, ray);
    if (!first.hit)
    {
      continue;
    }
    // Start again from the middle of the voxel: by moving the origin, and by tMin.
    const glm::dvec3 middle = 1.0 + (glm::dvec3(first.voxel) + 0.5) * cellEdge(octree, 8);
    const svo::Ray moved{ middle, ray.direction };
    const svo::Hit a = svo::intersect(octree, moved, { svo::LeafGeometry::Voxel });
    ASSERT_EQ(a.cell, first.voxel);
    ASSERT_EQ(a.t, 0.0);
    const svo::Ray later{ middle - 3.0 * ray.direction, ray.direction, 3.0 };
    const svo::Hit b = svo::intersect(octree, later, { svo::LeafGeometry::Voxel });
    ASSERT_EQ(b.cell, first.voxel);
    ASSERT_EQ(b.t, 3.0);
    ++tried;
  }
  EXPECT_GT(tried, 1000);
}

TEST(RayTraversal, NothingIsHitBeforeTMinOrBehindTMax)
{
  const svo::Octree octree = makeOctree({ { 4, 4, 4 }, { 12, 4, 4 } }, 4);
  svo::Ray ray{ { 0.0, 1.27, 1.27 }, { 1.0, 0.0, 0.0 } };
  const svo::TraceOptions options{ svo::LeafGeometry::Voxel };
  EXPECT_EQ(svo::intersect(octree, ray, options).t, 1.25);
  ray.tMax = 1.24;
  EXPECT_FALSE(svo::intersect(octree, ray, options));
  EXPECT_FALSE(svo::occluded(octree, ray, options));
  ray.tMin = 1.4;
  ray.tMax = 2.0;
  EXPECT_EQ(svo::intersect(octree, ray, options).t, 1.75);
  EXPECT_TRUE(svo::occluded(octree, ray, options));
  ray.tMax = 1.3;
  EXPECT_FALSE(svo::intersect(octree, ray, options)) << "tMin > tMax";
}

TEST(RayTraversal, NaNAndInfiniteRaysMiss)
{
  const svo::Octree octree = makeOctree(sphere(20, 20), 6);
  const double bad[] = { NaN, Infinity, -Infinity };
  for (svo::LeafGeometry geometry :
    { svo::LeafGeometry::Voxel, svo::LeafGeometry::Plane, svo::LeafGeometry::Triangle })
  {
    for (double value : bad)
    {
      for (int a = 0; a < 3; ++a)
      {
        svo::Ray ray{ { 0.0, 1.5, 1.5 }, { 1.0, 0.0, 0.0 } };
        ASSERT_TRUE(svo::intersect(octree, ray, { geometry }));
        ray.origin[a] = value;
        EXPECT_FALSE(svo::intersect(octree, ray, { geometry }));
        EXPECT_FALSE(svo::occluded(octree, ray, { geometry }));
        ray = { { 0.0, 1.5, 1.5 }, { 1.0, 0.0, 0.0 } };
        ray.direction[a] = value;
        EXPECT_FALSE(svo::intersect(octree, ray, { geometry }));
      }
    }
    const glm::dvec3 origin(0.0, 1.5, 1.5), direction(1.0, 0.0, 0.0);
    EXPECT_FALSE(svo::intersect(octree, { origin, direction, NaN, 9.0 }, { geometry }));
    EXPECT_FALSE(svo::intersect(octree, { origin, direction, 0.0, NaN }, { geometry }));
    EXPECT_FALSE(svo::intersect(octree, { origin, direction, Infinity, Infinity }, { geometry }));
    EXPECT_TRUE(svo::intersect(octree, { origin, direction, -Infinity, Infinity }, { geometry }));
    EXPECT_FALSE(svo::intersect(octree, { origin, glm::dvec3(0.0) }, { geometry }));
  }
}

TEST(RayTraversal, AnEmptyOctreeIsMissed)
{
  const svo::Octree empty = makeOctree(std::vector<glm::ivec3>{}, 5);
  ASSERT_TRUE(empty);
  const svo::Ray ray{ { 0.0, 1.1, 1.1 }, { 1.0, 0.0, 0.0 } };
  for (int level : { 0, 3, 20 })
  {
    EXPECT_FALSE(svo::intersect(empty, ray, { svo::LeafGeometry::Voxel, level }));
    EXPECT_FALSE(svo::occluded(empty, ray, { svo::LeafGeometry::Automatic, level }));
  }
  EXPECT_FALSE(svo::intersect(svo::Octree(), ray, {}));
}

TEST(RayTraversal, TheLengthOfTheDirectionDoesNotMatter)
{
  const svo::Octree octree = makeOctree(torus(20, 20), 9);
  RandomRays random(octree, 80);
  for (int i = 0; i < 2000; ++i)
  {
    svo::Ray ray = random.next();
    const svo::Hit unit = svo::intersect(octree, ray, { svo::LeafGeometry::Voxel });
    for (int exponent : { -1040, -900, -30, 30, 900 })
    {
      svo::Ray scaled = ray;
      scaled.direction *= std::ldexp(1.0, exponent);
      scaled.tMax = Infinity;
      const svo::Hit hit = svo::intersect(octree, scaled, { svo::LeafGeometry::Voxel });
      ASSERT_EQ(bool(hit), bool(unit));
      if (hit && exponent > -1000) // below, the direction has lost digits
      {
        ASSERT_EQ(hit.cell, unit.cell);
        ASSERT_EQ(hit.t, std::ldexp(unit.t, -exponent));
      }
    }
  }
}

TEST(RayTraversal, ARayFromFarAwayHitsTheSameVoxel)
{
  const svo::Octree octree = makeOctree(torus(40, 40), 10);
  RandomRays random(octree, 90);
  int differ = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const svo::Ray ray = random.next();
    svo::Ray far = ray;
    far.origin -= 1e6 * ray.direction;
    far.tMin = 1e6;
    far.tMax = 2e6;
    const FoundCell a = traceDouble(octree, ray, 10), b = traceDouble(octree, far, 10);
    differ += a.hit != b.hit || (a.hit && a.cell != b.cell);
  }
  EXPECT_LE(differ, 1);
}
