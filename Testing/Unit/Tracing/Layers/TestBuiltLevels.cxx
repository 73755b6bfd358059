// Octrees of the levels that a picture needs keep the promise of the pixel error: no visible point
// is displaced on the screen by more than sqrt(3) times as many pixels. Deeper ones look the same.
#include "svoTracerScenes.h"

#include "svoNeededLevels.h"
#include "svoSelectLevel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <vector>

using namespace svotest;

namespace
{
constexpr int Deepest = 12;

/// The point of a triangle that is nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
glm::dvec3 nearestPoint(
  const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0)
  {
    return a;
  }
  const glm::dvec3 bp = p - b;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3)
  {
    return b;
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
  {
    return a + d1 / (d1 - d3) * ab;
  }
  const glm::dvec3 cp = p - c;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6)
  {
    return c;
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
  {
    return a + d2 / (d2 - d6) * ac;
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
  {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

struct Displaced
{
  std::size_t points = 0;
  std::size_t beyond = 0; // the promise
  double worst = 0.0;     // pixels
};

/// Between each hit pixel's centre and where the mesh's point nearest to its hit is seen.
Displaced displaced(
  const Mesh& mesh, const svo::View& view, const svo::Frame& frame, double promised)
{
  Displaced result;
  const glm::dmat4 toClip = view.viewToClip * view.worldToView;
  for (int y = 0; y < view.height; ++y)
  {
    for (int x = 0; x < view.width; ++x)
    {
      const std::size_t i = static_cast<std::size_t>(y) * view.width + x;
      if (frame.instance[i] == ~0u)
      {
        continue;
      }
      // Window depth back to linear depth: z/w = 2 depth - 1 = (a t - b) / t.
      const double a = -view.viewToClip[2][2], b = -view.viewToClip[3][2];
      const double t = b / (a - (2.0 * frame.depth[i] - 1.0));
      const glm::dvec3 hit =
        view.rayOrigin(x + 0.5, y + 0.5) + t * view.rayDirection(x + 0.5, y + 0.5);
      glm::dvec3 nearest(0.0);
      double least = 1e300;
      for (const glm::uvec3& k : mesh.triangles)
      {
        const glm::dvec3 q =
          nearestPoint(hit, mesh.points[k.x], mesh.points[k.y], mesh.points[k.z]);
        const double distance = glm::dot(q - hit, q - hit);
        nearest = distance < least ? q : nearest;
        least = std::min(least, distance);
      }
      const glm::dvec4 clip = toClip * glm::dvec4(nearest, 1.0);
      const double moved = std::hypot((clip.x / clip.w + 1.0) * 0.5 * view.width - (x + 0.5),
        (clip.y / clip.w + 1.0) * 0.5 * view.height - (y + 0.5));
      ++result.points;
      result.beyond += moved > promised;
      result.worst = std::max(result.worst, moved);
    }
  }
  return result;
}

Displaced measure(svo::LeafGeometry leaves, double pixelError, double distance)
{
  const Mesh mesh = torus(48, 24);
  svo::Scene unbuilt;
  unbuilt.instances.resize(1);
  unbuilt.instances[0].body.own().box = { { -1.4, -1.4, -0.4 }, { 1.4, 1.4, 0.4 } };
  unbuilt.instances[0].body.own().triangles = mesh.triangles.size();
  unbuilt.instances[0].body.own().deepestLevel = Deepest;
  svo::FrameSettings settings;
  settings.shadowTechnique = svo::ShadowTechnique::None;
  settings.pixelError = pixelError;
  const svo::View view = lookAt(distance * glm::normalize(glm::dvec3(0.3, -1.0, 0.7)), 96, 96);
  const int level = svo::neededLevels(unbuilt, view, settings)[0].eye;
  EXPECT_LT(level, Deepest);
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(mesh, level), 1, glm::dmat4(1.0), leaves) };
  const Displaced result =
    displaced(mesh, view, rendered(scene, view, settings), std::sqrt(3.0) * pixelError);
  std::cout << "error " << pixelError << " from " << distance << ", level " << level << ": worst "
            << result.worst << " of " << std::sqrt(3.0) * pixelError << " pixels, beyond "
            << result.beyond << " of " << result.points << '\n';
  EXPECT_GT(result.points, 50u);
  return result;
}

void expectPromise(svo::LeafGeometry leaves)
{
  for (const double pixelError : { 0.5, 1.0, 2.0, 4.0 })
  {
    for (const double distance : { 4.0, 9.0, 25.0 })
    {
      EXPECT_EQ(measure(leaves, pixelError, distance).beyond, 0u);
    }
  }
}
}

TEST(BuiltLevels, CubesKeepThePromise)
{
  expectPromise(svo::LeafGeometry::Voxel);
}

TEST(BuiltLevels, PlanesKeepThePromise)
{
  expectPromise(svo::LeafGeometry::Plane);
}

TEST(BuiltLevels, AutomaticLeavesKeepThePromise)
{
  expectPromise(svo::LeafGeometry::Automatic);
}

TEST(BuiltLevels, WhereTrianglesAreFewADeeperOctreeChangesNoOutline)
{
  const Mesh mesh = torus(96, 64);
  svo::FrameSettings settings;
  settings.shadowTechnique = svo::ShadowTechnique::None;
  for (const double distance : { 8.0, 25.0 })
  {
    const svo::View view = lookAt(distance * glm::normalize(glm::dvec3(0.3, -1.0, 0.7)), 96, 96);
    const auto seen = [&](int level)
    {
      svo::Scene scene;
      scene.instances = { instanceOf(
        makeOctree(mesh, level), 1, glm::dmat4(1.0), svo::LeafGeometry::Automatic) };
      return rendered(scene, view, settings).instance;
    };
    const std::vector<std::uint32_t> coarse = seen(7);
    EXPECT_GT(std::count(coarse.begin(), coarse.end(), 0u), 50);
    for (const int level : { 8, 9, 10, 11 })
    {
      const std::vector<std::uint32_t> deep = seen(level);
      int different = 0;
      for (std::size_t i = 0; i < deep.size(); ++i)
      {
        different += deep[i] != coarse[i];
      }
      EXPECT_LE(different, 2) << "level " << level << " from " << distance; // rays on an edge
    }
  }
}

TEST(BuiltLevels, WhereTrianglesAreManyRaysStopAtNodes)
{
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(torus(300, 200), 9), 1) };
  scene.instances[0].body.own().leafGeometry = svo::LeafGeometry::Automatic;
  const svo::Instance& instance = scene.instances[0];
  const auto levelFrom = [&](double distance)
  {
    const svo::View view = lookAt({ 0.0, -distance, 0.0 }, 96, 96);
    const svo::LocalView local =
      svo::makeLocalView(instance.body->octree, instance.localToWorld, view);
    const int level = svo::selectEyeLevel(instance, local, view, 1.0);
    EXPECT_TRUE(level == 9 || level == svo::selectLevel(instance, local, view, 1.0));
    return level;
  };
  EXPECT_EQ(levelFrom(12.0), 9); // level 5: about 32 triangles a node
  EXPECT_LT(levelFrom(100.0), 5);
  scene.instances[0].body.own().leafGeometry = svo::LeafGeometry::Plane;
  EXPECT_LT(levelFrom(12.0), 9);
}
