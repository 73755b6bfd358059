// What is shaded where rays stop at nodes above the bricks: faces that the viewer sees.
#include "svoLayeredView.h"
#include "svoReferencePoint.h"
#include "svoTileLook.h"
#include "svoTracerScenes.h"
#include "svoWorldSize.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <vector>

using namespace svotest;

namespace
{
constexpr int Level = 8;
constexpr int Coarse[] = { 2, 3, 4, 5 }; // levels above the bricks

/// Traces an instance to a coarse level, in views from several sides, and calls f(point, view) for
/// what is seen, which has to be on nodes and the same side by side as one by one.
void eachSeenPoint(const svo::Instance& instance, int level, const std::vector<glm::dvec3>& eyes,
  const std::function<void(const svo::SurfacePoint&, const glm::dvec3&)>& f)
{
  svo::Scene scene;
  scene.instances = { instance };
  const std::vector<svo::SurfaceMatrices> frames{ svo::SurfaceMatrices(scene.instances[0]) };
  for (const glm::dvec3& eye : eyes)
  {
    const svo::View view = lookAt(eye, 96, 96);
    svo::LayeredView layers;
    svo::LayerBudget budget{ 0, 0 };
    layers.prepare(
      scene, view, [](const svo::Instance&) { return true; },
      [&](const svo::Instance&, const svo::LocalView&) { return level; }, false, budget);
    layers.trace(svo::serialFor, nullptr);
    const svo::DepthBuffer& depth = layers.hits().depth;
    svo::TilePatch patch{};
    svo::TileTriangles triangles{};
    const auto look = [&](const svo::View& from, std::size_t tile, const auto& g)
    {
      svo::eachPatch(
        from,
        svo::hitsOfTile(depth, from, static_cast<int>(tile % depth.grid.tilesX),
          static_cast<int>(tile / depth.grid.tilesX)),
        [](std::uint32_t) { return true; }, [&](std::uint32_t i) { return layers.hits().base(i); },
        patch,
        [&](svo::TilePatch& seen)
        {
          svo::lookAtPatch(frames[0], seen, triangles);
          svo::eachBit(seen.mask, g);
        });
    };
    for (std::size_t tile = 0; tile < depth.tiles(); ++tile)
    {
      if (!depth.hit[tile])
      {
        continue;
      }
      glm::vec3 normals[svo::TilePatch::Most];
      look(view, tile,
        [&](int i)
        {
          const svo::Primitive primitive = patch.hits->primitive[i];
          ASSERT_TRUE(primitive & svo::NodePrimitive);
          const svo::SurfacePoint point =
            svo::surfacePoint(frames[0], view, patch.x(i), patch.y(i), patch.t(i), primitive);
          const svo::SurfacePoint other = patch.point(i);
          ASSERT_EQ(std::memcmp(&point.position, &other.position, sizeof(glm::dvec3)), 0);
          ASSERT_EQ(std::memcmp(&point.facet, &other.facet, sizeof(glm::vec3)), 0);
          ASSERT_EQ(std::memcmp(&point.normal, &other.normal, sizeof(glm::vec3)), 0);
          normals[i] = point.normal;
          f(point, view.rayDirection(patch.x(i), patch.y(i)));
        });
      // A mirrored projection turns front faces into back ones.
      svo::View mirrored = view;
      mirrored.plain = false;
      mirrored.mirrored = true;
      look(mirrored, tile, [&](int i) { ASSERT_EQ(patch.normal(i), -normals[i]); });
    }
  }
}

const std::vector<glm::dvec3> Around = { { 4, 0, 0.1 }, { -2, 3, 2 }, { 1, -3, -3 }, { -3, -2, 1 },
  { 0.3, 0.2, 4 } };
}

// Of a ball one sees the side that is turned here, up to its silhouette and a little beyond, where
// nodes hold nothing but what lies behind it. The ray meets a node in the cube of three cells
// around it, so at most 2 sqrt(3) cells beside any of the node's triangles.
TEST(NodeShading, OfABallTheSideThatIsTurnedHereIsSeen)
{
  constexpr unsigned Rows = 80;
  const Mesh mesh = sphere(Rows, Rows);
  const svo::Octree octree = makeOctree(mesh, Level);
  const std::vector<float> normals = radialNormals(mesh);
  svo::Instance instance = instanceOf(octree, 1, glm::dmat4(1.0), svo::LeafGeometry::Plane);
  instance.body.own().attributes.normals = normals.data();
  instance.body.own().attributes.normalAssociation = svo::Association::Point;
  for (int level : Coarse)
  {
    const double beside = 2.0 * std::sqrt(3.0) * svo::worldVoxel(instance, level);
    int seen = 0;
    eachSeenPoint(instance, level, Around,
      [&](const svo::SurfacePoint& point, const glm::dvec3& direction)
      {
        ++seen;
        // The normal of the point that is shaded is that point.
        const glm::dvec3 x(point.normal);
        const glm::dvec3 along = glm::normalize(direction);
        EXPECT_LT(glm::length(glm::cross(x - point.position, along)), beside) << "level " << level;
        // A facet that faces the viewer may have corners that do not.
        EXPECT_LT(glm::dot(x, along), 2.0 * Pi / Rows) << "level " << level;
        EXPECT_LT(glm::dot(glm::dvec3(point.facet), along), 0.0);
      });
    EXPECT_GT(seen, 5000);
  }
}

// A sheet has its other side to be seen.
TEST(NodeShading, OfASheetSeenFromBehindTheBackIsSeen)
{
  Mesh mesh;
  constexpr unsigned N = 40;
  for (unsigned i = 0; i <= N; ++i)
  {
    for (unsigned j = 0; j <= N; ++j)
    {
      mesh.points.push_back({ 2.0 * i / N - 1.0, 2.0 * j / N - 1.0, 0.0 });
    }
  }
  for (unsigned i = 0; i < N; ++i)
  {
    for (unsigned j = 0; j < N; ++j)
    {
      const unsigned a = i * (N + 1) + j, b = a + N + 1;
      mesh.triangles.push_back({ a, b, b + 1 });
      mesh.triangles.push_back({ a, b + 1, a + 1 });
    }
  }
  const svo::Octree octree = makeOctree(mesh, Level);
  std::vector<float> normals;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    normals.insert(normals.end(), { 0.0f, 0.6f, 0.8f });
  }
  svo::Instance instance = instanceOf(octree, 1, glm::dmat4(1.0), svo::LeafGeometry::Plane);
  instance.body.own().attributes.normals = normals.data();
  instance.body.own().attributes.normalAssociation = svo::Association::Point;
  for (int level : Coarse)
  {
    for (const float side : { 1.0f, -1.0f })
    {
      int seen = 0;
      eachSeenPoint(instance, level, { { 0.5, -1.0, 3.0 * side } },
        [&](const svo::SurfacePoint& point, const glm::dvec3&)
        {
          ++seen;
          EXPECT_LT(glm::length(point.facet - glm::vec3(0, 0, side)), 1e-5f);
          EXPECT_LT(glm::length(point.normal - side * glm::vec3(0, 0.6f, 0.8f)), 1e-5f);
        });
      EXPECT_GT(seen, 1000);
    }
  }
}
