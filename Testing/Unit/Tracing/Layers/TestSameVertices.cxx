// Surfaces with the same vertices, of octrees that differ, are equally deep: the last one is seen.
#include "svoLayeredView.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace svotest;

namespace
{
/// The triangles of a mesh that have all corners above a height, with points of their own.
Mesh above(const Mesh& mesh, double height)
{
  Mesh part;
  for (const glm::uvec3& triangle : mesh.triangles)
  {
    const glm::dvec3 p[3] = { mesh.points[triangle.x], mesh.points[triangle.y],
      mesh.points[triangle.z] };
    if (std::min({ p[0].z, p[1].z, p[2].z }) > height)
    {
      // Another corner first: the plane must not depend on it.
      const auto first = static_cast<unsigned>(part.points.size());
      part.points.insert(part.points.end(), p, p + 3);
      part.triangles.push_back({ first + 1, first + 2, first });
    }
  }
  return part;
}

svo::Instance placed(const Mesh& mesh, int level, std::uint64_t id)
{
  svo::Instance instance = instanceOf(makeOctree(mesh, level), id, movedTo(0.3, 0.1, 0.2));
  instance.body.own().points.doubles = &mesh.points.data()->x;
  instance.body.own().points.count = mesh.points.size();
  return instance;
}

/// The instances that are seen. `coarser`: by how many levels rays end early.
std::vector<std::uint32_t> seen(
  svo::LayeredView& layers, const svo::Scene& scene, const svo::View& view, int coarser, bool keep)
{
  svo::LayerBudget budget{ std::size_t(1) << 28, 0 };
  layers.prepare(
    scene, view, [](const svo::Instance&) { return true; },
    [&](const svo::Instance& i, const svo::LocalView&) { return i.body->octree.level() - coarser; },
    keep, budget);
  layers.trace(svo::serialFor, nullptr);
  const svo::DepthBuffer& depth = layers.hits().depth;
  std::vector<std::uint32_t> instances;
  for (int y = 0; y < view.height; ++y)
  {
    for (int x = 0; x < view.width; ++x)
    {
      const std::size_t at = depth.at(x, y);
      instances.push_back(depth.hit[at >> 6] ? depth.instance[at] : svo::NoInstance);
    }
  }
  return instances;
}

/// Of the pixels where a part has triangles, at least this share shows it, or a later one.
void expectLastSeen(unsigned rows, int level, int coarser, double share)
{
  const Mesh whole = sphere(rows, 2 * rows), upper = above(whole, 0.1), top = above(whole, 0.5);
  svo::Scene scene;
  scene.instances = { placed(whole, level, 1), placed(upper, level, 2), placed(top, level, 3) };
  for (const svo::View& view :
    { lookAt({ 0.6, -0.5, 3.2 }, 160, 120), lookAtParallel({ 0.6, -0.5, 3.2 }, 160, 120, 1.1) })
  {
    svo::LayeredView cutting, keeping;
    const auto instances = seen(cutting, scene, view, coarser, false);
    EXPECT_EQ(instances, seen(keeping, scene, view, coarser, true));
    // The first layer is not kept any more: it is merged after the others.
    scene.instances[0].id += 10;
    svo::Scene moved = scene;
    moved.instances[0].localToWorld = movedTo(5.0, 5.0, 5.0);
    seen(keeping, moved, view, coarser, true);
    EXPECT_EQ(instances, seen(keeping, scene, view, coarser, true));
    for (std::uint32_t part : { 1u, 2u })
    {
      svo::Scene alone;
      alone.instances = { scene.instances[part] };
      svo::LayeredView layers;
      const auto own = seen(layers, alone, view, 0, false);
      std::size_t covered = 0, shown = 0;
      for (std::size_t i = 0; i < own.size(); ++i)
      {
        covered += own[i] == 0;
        shown += own[i] == 0 && instances[i] >= part && instances[i] != svo::NoInstance;
      }
      EXPECT_GT(covered, 100u);
      EXPECT_GE(shown, share * covered);
    }
  }
}
}

TEST(SameVertices, LargeTrianglesOfTheLastAreSeen)
{
  expectLastSeen(24, 9, 0, 1.0);
}

TEST(SameVertices, RaysThatEndOnNodesFindTheTriangles)
{
  expectLastSeen(300, 9, 4, 0.97);
}
