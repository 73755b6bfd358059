// Voxel and plane leaves, the automatic choice, and rays that stop above the bricks.
#include "svoIntersect.h"
#include "svoLeafGeometry.h"
#include "svoTestScenes.h"

#include <gtest/gtest.h>

using namespace svotest;
using svo::LeafGeometry;

namespace
{
constexpr LeafGeometry AllGeometries[] = { LeafGeometry::Voxel, LeafGeometry::Plane,
  LeafGeometry::Triangle, LeafGeometry::Automatic };

double voxelEdge(const svo::Octree& octree)
{
  return 1.0 / double(1 << octree.rootBits(octree.level()));
}

std::vector<svo::Ray> randomRays(const svo::Octree& octree, int count, unsigned seed)
{
  RandomRays random(octree, seed);
  std::vector<svo::Ray> rays;
  for (int i = 0; i < count; ++i)
  {
    rays.push_back(random.next());
  }
  return rays;
}
}

TEST(PlaneLeaves, LieWithinAVoxelOfTheTriangles)
{
  const svo::Octree octree = makeOctree(torus(60, 40), 9);
  const double voxel = voxelEdge(octree);
  std::vector<double> errors;
  for (const svo::Ray& ray : randomRays(octree, 20000, 9))
  {
    const svo::Hit exact = svo::intersect(octree, ray, { LeafGeometry::Triangle });
    const svo::Hit plane = svo::intersect(octree, ray, { LeafGeometry::Plane });
    if (exact && plane)
    {
      errors.push_back(std::abs(exact.t - plane.t) * glm::length(ray.direction) / voxel);
    }
  }
  std::sort(errors.begin(), errors.end());
  ASSERT_GT(errors.size(), 5000u);
  EXPECT_LT(errors[errors.size() / 2], 0.01);
  EXPECT_LT(errors[errors.size() * 99 / 100], 2.0);
}

TEST(VoxelLeaves, NameATriangleNearTheCell)
{
  const svo::Octree octree = makeOctree(torus(60, 40), 8);
  const double voxel = voxelEdge(octree);
  const svo::Surface& surface = *octree.surface();
  int hits = 0;
  for (const svo::Ray& ray : randomRays(octree, 5000, 10))
  {
    const svo::Hit hit = svo::intersect(octree, ray, { LeafGeometry::Voxel });
    if (!hit)
    {
      continue;
    }
    ++hits;
    ASSERT_LT(hit.primitive, surface.triangles.size());
    const glm::uvec3 t = surface.triangles[hit.primitive];
    const glm::vec3 low =
      glm::min(surface.points[t.x], glm::min(surface.points[t.y], surface.points[t.z]));
    const glm::vec3 high =
      glm::max(surface.points[t.x], glm::max(surface.points[t.y], surface.points[t.z]));
    for (int a = 0; a < 3; ++a) // with the builder's lattice around it
    {
      ASSERT_LE(low[a], 1.0 + (hit.cell[a] + 1.02) * voxel);
      ASSERT_GE(high[a], 1.0 + (hit.cell[a] - 0.02) * voxel);
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(AutomaticLeaves, AreTrianglesWhereListsAreShort)
{
  const svo::Octree octree = makeOctree(sphere(8, 8), 8);
  std::uint32_t longest = 0;
  for (std::uint32_t b = octree.brickBegin(); b < octree.header().nodeCount; ++b)
  {
    std::uint32_t count = 0, id = 0;
    octree.brickTriangles(b, count, id);
    longest = std::max(longest, count);
  }
  ASSERT_LE(longest, svo::ShortList);
  for (const svo::Ray& ray : randomRays(octree, 5000, 11))
  {
    const svo::Hit a = svo::intersect(octree, ray, { LeafGeometry::Triangle });
    const svo::Hit b = svo::intersect(octree, ray, { LeafGeometry::Automatic });
    ASSERT_EQ(a.primitive, b.primitive);
    ASSERT_EQ(a.t, b.t);
  }
}

TEST(AutomaticLeaves, ArePlanesWhereListsAreLong)
{
  const svo::Octree octree = makeOctree(sphere(120, 120), 4); // hundreds of triangles a brick
  for (std::uint32_t b = octree.brickBegin(); b < octree.header().nodeCount; ++b)
  {
    std::uint32_t count = 0, id = 0;
    octree.brickTriangles(b, count, id);
    ASSERT_GT(count, svo::ShortList);
  }
  for (const svo::Ray& ray : randomRays(octree, 2000, 12))
  {
    const svo::Hit a = svo::intersect(octree, ray, { LeafGeometry::Plane });
    const svo::Hit b = svo::intersect(octree, ray, { LeafGeometry::Automatic });
    ASSERT_EQ(a.primitive, b.primitive);
    ASSERT_EQ(a.t, b.t);
  }
}

namespace
{
/// One horizontal triangle at z = 0 in local coordinates, as an octree of level 5.
svo::Octree oneTriangle()
{
  Mesh mesh;
  mesh.points = { { -1.0, -1.0, 0.0 }, { 1.0, -1.0, 0.0 }, { 0.0, 1.0, 0.0 } };
  mesh.triangles = { { 0, 1, 2 } };
  return makeOctree(mesh, 5);
}

svo::Ray localRay(const svo::Octree& octree, glm::dvec3 origin, glm::dvec3 direction)
{
  return { glm::dvec3(octree.localToOctree() * glm::dvec4(origin, 1.0)),
    glm::dvec3(octree.localToOctree() * glm::dvec4(direction, 0.0)) };
}
}

TEST(PlaneLeaves, ARefusedRayGetsTheEntryOfTheFirstVoxelThatRefusedIt)
{
  const svo::Octree octree = oneTriangle();
  // Parallel to the plane, just above it, inside its voxels.
  const svo::Ray ray = localRay(octree, { -3.0, -0.5, 0.01 }, { 1.0, 0.0, 0.0 });
  const svo::Hit cube = svo::intersect(octree, ray, { LeafGeometry::Voxel });
  const svo::Hit plane = svo::intersect(octree, ray, { LeafGeometry::Plane });
  ASSERT_TRUE(cube);
  ASSERT_TRUE(plane);
  EXPECT_EQ(plane.t, cube.t);
  EXPECT_EQ(plane.cell, cube.cell);
  EXPECT_TRUE(svo::occluded(octree, ray, { LeafGeometry::Plane }));
  EXPECT_FALSE(svo::intersect(octree, ray, { LeafGeometry::Triangle }));
}

TEST(PlaneLeaves, ARayThatLeavesTheSurfaceDoesNotHitIt)
{
  const svo::Octree octree = oneTriangle();
  const svo::Ray up = localRay(octree, { 0.0, 0.0, 0.01 }, { 0.1, 0.0, 1.0 });
  EXPECT_TRUE(svo::intersect(octree, up, { LeafGeometry::Voxel }));
  EXPECT_FALSE(svo::intersect(octree, up, { LeafGeometry::Plane }));
  EXPECT_FALSE(svo::occluded(octree, up, { LeafGeometry::Plane }));
  EXPECT_FALSE(svo::intersect(octree, up, { LeafGeometry::Triangle }));
  const svo::Ray down = localRay(octree, { 0.0, 0.0, 0.01 }, { 0.1, 0.0, -1.0 });
  EXPECT_NEAR(svo::intersect(octree, down, { LeafGeometry::Plane }).t, 0.01, 1e-6);
  EXPECT_NEAR(svo::intersect(octree, down, { LeafGeometry::Triangle }).t, 0.01, 1e-6);
}

TEST(LevelOfDetail, RaysStopOnTheMeanPlaneOfTheNode)
{
  for (int level : { 8, 9 })
  {
    const svo::Octree octree = makeOctree(torus(60, 40), level);
    for (int stop = 1; stop < level - 2; ++stop)
    {
      const double cell = 1.0 / double(1 << octree.rootBits(stop));
      int hits = 0;
      for (const svo::Ray& ray : randomRays(octree, 500, 13))
      {
        for (LeafGeometry geometry : AllGeometries)
        {
          const svo::Hit hit = svo::intersect(octree, ray, { geometry, stop });
          if (!hit)
          {
            continue;
          }
          ++hits;
          ASSERT_EQ(hit.level, stop);
          ASSERT_TRUE(octree.occupied(hit.cell, stop));
          ASSERT_TRUE(hit.primitive & svo::NodePrimitive);
          // The node has the depth that the level asks for.
          const std::uint32_t node = hit.primitive & ~svo::NodePrimitive;
          const int depth = (octree.rootBits(stop) + 1) / 2;
          ASSERT_GE(node, octree.header().depthBegin[depth]);
          ASSERT_LT(node, octree.header().depthBegin[depth + 1]);
          const glm::dvec3 x = ray.origin + hit.t * ray.direction;
          const glm::dvec3 away = glm::abs(x - (1.0 + (glm::dvec3(hit.cell) + 0.5) * cell));
          ASSERT_LE(std::max({ away.x, away.y, away.z }), 1.5 * cell + 1e-9);
        }
      }
      EXPECT_GT(hits, 100);
    }
  }
}

TEST(LeafGeometry, AnOctreeWithoutItsSurfaceIsTracedAsVoxels)
{
  const svo::Octree octree = makeOctree(std::vector<glm::ivec3>{ { 1, 1, 1 } }, 3);
  const svo::Ray ray{ { 0.0, 1.1, 1.1 }, { 1.0, 0.0, 0.0 } };
  for (LeafGeometry geometry : AllGeometries)
  {
    const svo::Hit hit = svo::intersect(octree, ray, { geometry });
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit.primitive, 0u);
    EXPECT_EQ(hit.t, 1.0 + 1.0 / 16);
  }
}
