// Hits of float rays are moved to where rays in double meet the same triangles.
#include "svoPlaceOnTriangles.h"

#include "svoIntersectTile.h"
#include "svoLayeredView.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

using namespace svotest;

namespace
{
double trueDepth(
  const svo::Surface& surface, const svo::LocalView& local, svo::Primitive id, double x, double y)
{
  const glm::uvec3 triangle = surface.triangles[id];
  const glm::dvec3 p(surface.points[triangle.x]), q(surface.points[triangle.y]),
    r(surface.points[triangle.z]);
  const glm::dvec3 origin = local.origin + y * local.originY + x * local.originX;
  const glm::dvec3 direction = local.direction + y * local.directionY + x * local.directionX;
  const glm::dvec3 normal = glm::cross(q - p, r - p);
  return glm::dot(normal, p - origin) / glm::dot(normal, direction);
}
}

TEST(PlaceOnTriangles, APicturesDepthsAreThoseOfRaysInDouble)
{
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(sphere(24, 36), 10), 1) };
  for (const svo::View& view :
    { lookAt({ 2.1, -1.7, 1.3 }, 160, 120), lookAtParallel({ 2.1, -1.7, 1.3 }, 160, 120, 1.1) })
  {
    svo::LayeredView layers;
    svo::LayerBudget budget{ 0, 0 };
    layers.prepare(
      scene, view, [](const svo::Instance&) { return true; },
      [](const svo::Instance& i, const svo::LocalView&) { return i.body->octree.level(); }, false,
      budget);
    layers.trace(svo::serialFor, nullptr);
    ASSERT_TRUE(svo::worthTiles(scene.instances[0],
      svo::makeLocalView(scene.instances[0].body->octree, scene.instances[0].localToWorld, view),
      view, true));
    const svo::LocalView local =
      svo::makeLocalView(scene.instances[0].body->octree, scene.instances[0].localToWorld, view);
    const svo::DepthBuffer& depth = layers.hits().depth;
    int hits = 0;
    for (int y = 0; y < view.height; ++y)
    {
      for (int x = 0; x < view.width; ++x)
      {
        const std::size_t at = depth.at(x, y);
        if (!depth.hit[at >> 6] || depth.instance[at] == svo::NoInstance)
        {
          continue;
        }
        ++hits;
        const double expected = trueDepth(
          *scene.instances[0].body->octree.surface(), local, depth.primitive[at], x + 0.5, y + 0.5);
        // The rounding of the float that it is stored in, and no more.
        ASSERT_NEAR(depth.t[at], expected, 1.2e-7 * local.tMax) << x << ", " << y;
      }
    }
    EXPECT_GT(hits, 4000);
  }
}

TEST(PlaceOnTriangles, HitsOnLongAndThinTrianglesAsWell)
{
  // A prism, 2000 times as long as it is wide, seen along from one side.
  Mesh mesh;
  const glm::dvec3 corners[3] = { { 0, 0.02, 0 }, { 0, -0.02, 0.02 }, { 0, -0.02, -0.02 } };
  const glm::dvec3 half(40.0, 0, 0);
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec3 a = corners[i], b = corners[(i + 1) % 3];
    mesh.add(a - half, a + half, b + half);
    mesh.add(a - half, b + half, b - half);
  }
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(mesh, 10), 1) };
  const svo::View view = lookAt({ -8, 9, 4 }, 320, 240);
  const svo::LocalView local =
    svo::makeLocalView(scene.instances[0].body->octree, scene.instances[0].localToWorld, view);
  svo::LayeredView layers;
  svo::LayerBudget budget{ 0, 0 };
  layers.prepare(
    scene, view, [](const svo::Instance&) { return true; },
    [](const svo::Instance& i, const svo::LocalView&) { return i.body->octree.level(); }, false,
    budget);
  layers.trace(svo::serialFor, nullptr);
  const svo::DepthBuffer& depth = layers.hits().depth;
  int hits = 0;
  for (int y = 0; y < view.height; ++y)
  {
    for (int x = 0; x < view.width; ++x)
    {
      const std::size_t at = depth.at(x, y);
      if (depth.hit[at >> 6] && depth.instance[at] != svo::NoInstance)
      {
        ++hits;
        const double expected = trueDepth(
          *scene.instances[0].body->octree.surface(), local, depth.primitive[at], x + 0.5, y + 0.5);
        EXPECT_NEAR(depth.t[at], expected, 1.2e-7 * local.tMax) << x << ", " << y;
      }
    }
  }
  EXPECT_GT(hits, 100);
}

TEST(PlaceOnTriangles, HitsOnTrianglesSeenEdgeOnStayWhereTheyAre)
{
  const svo::Octree octree = makeOctree(square(1.0), 6); // z = 0
  const svo::View view = lookAtParallel({ 0, -5, 0 }, 8, 8, 1.0);
  const svo::LocalView local = svo::makeLocalView(octree, glm::dmat4(1.0), view);
  double x[64], y[64];
  svo::HitBlock hits;
  for (int k = 0; k < 64; ++k)
  {
    x[k] = 4.0;
    y[k] = 4.0 + 1e-9 * k; // in the square's plane, or next to it
    hits.t[k] = 0.25f * local.tMax;
    hits.primitive[k] = k % 2;
  }
  svo::placeOnTriangles(*octree.surface(), local, x, y, hits);
  for (int k = 0; k < 64; ++k)
  {
    EXPECT_NEAR(hits.t[k], 0.25f * local.tMax, 1.01 * svo::edgeOnReach(local)) << k;
  }
}
