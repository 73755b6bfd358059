// Which instance each pixel shows, and how deep it is, against rays that are traced one by one: by
// depths alone, and with offsets of coincident topology, of units and of slopes.
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace svotest;

namespace
{
const svo::View Eye = lookAt({ 1, -6, 4 }, 100, 76);

svo::FrameSettings smallBuffers()
{
  svo::FrameSettings settings;
  settings.shadowResolution = 128;
  return settings;
}

/// Of the facet that a ray has hit: how much its window depth changes from pixel to pixel, by the
/// depths at which the rays of two other points of the image meet its plane.
double steepnessOf(
  const svo::Instance& instance, const svo::View& view, int x, int y, const svo::Hit& hit)
{
  const svo::Surface& surface = *instance.body->octree.surface();
  glm::dvec3 p[3];
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec4 local(glm::dvec3(surface.points[surface.triangles[hit.primitive][k]]), 1.0);
    p[k] = glm::dvec3(
      instance.localToWorld * glm::inverse(instance.body->octree.localToOctree()) * local);
  }
  const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
  const auto depth = [&](double atX, double atY)
  {
    return view.windowDepth(glm::dot(normal, p[0] - view.rayOrigin(atX, atY)) /
      glm::dot(normal, view.rayDirection(atX, atY)));
  };
  constexpr double Step = 1e-4; // pixels: planes may end at the horizon nearby
  const double here = depth(x + 0.5, y + 0.5);
  return std::hypot(depth(x + 0.5 + Step, y + 0.5) - here, depth(x + 0.5, y + 0.5 + Step) - here) /
    Step;
}

/// Every pixel of the merged picture against rays traced one by one, in double. `offsets`: of the
/// instances' window depths; `factors`: of the slopes of these.
void expectNearest(const float (&offsets)[3], const float (&factors)[3] = { 0.0f, 0.0f, 0.0f })
{
  svo::Scene scene = ballRingAndGround(svo::LeafGeometry::Triangle);
  scene.instances[1].localToWorld =
    movedTo(-0.5, 0.2, 1.0) * glm::scale(glm::dmat4(1.0), { -1.0, 0.7, 1.2 });
  scene.instances[2].localToWorld[1] = { 0.4, 1.0, 0.2, 0.0 }; // sheared
  svo::FrameSettings settings = smallBuffers();
  settings.pixelError = 0.0;
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    scene.instances[i].depthOffset.units = offsets[i];
    scene.instances[i].depthOffset.factor = factors[i];
  }
  for (const svo::View& view : { Eye, lookAtParallel({ 1, -6, 4 }, 100, 76, 2.5) })
  {
    svo::CPUTracer tracer;
    const svo::Frame frame = rendered(tracer, scene, view, settings);
    EXPECT_TRUE(identical(frame, rendered(tracer, scene, view, settings))) << "with kept layers";
    svo::FrameSettings cutting = settings;
    cutting.frameCoherence = false;
    EXPECT_TRUE(identical(frame, rendered(scene, view, cutting))) << "with rays that are cut";
    int differ = 0;
    int hits = 0;
    for (int y = 0; y < view.height; ++y)
    {
      for (int x = 0; x < view.width; ++x)
      {
        double nearest = std::numeric_limits<double>::infinity();
        std::uint32_t winner = ~0u;
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        {
          const svo::Instance& instance = scene.instances[i];
          const svo::Hit hit = hitAlone(instance, view, x, y);
          const double slopes =
            hit && factors[i] != 0.0f ? factors[i] * steepnessOf(instance, view, x, y, hit) : 0.0;
          const double depth = view.windowDepth(hit.t) + offsets[i] + slopes;
          if (hit && depth < nearest)
          {
            nearest = depth;
            winner = i;
          }
        }
        const std::size_t at = std::size_t(y) * view.width + x;
        hits += winner != ~0u;
        if (frame.instance[at] != winner)
        {
          ++differ; // silhouettes, where a float decides otherwise
        }
        else if (winner != ~0u)
        {
          EXPECT_NEAR(frame.depth[at], std::clamp(nearest, 0.0, 1.0), 2e-6) << x << ", " << y;
          EXPECT_EQ(frame.color[4 * at + 3], 255);
        }
        else
        {
          EXPECT_EQ(frame.depth[at], 1.0f);
          EXPECT_EQ(frame.color[4 * at + 3], 0);
        }
      }
    }
    EXPECT_GT(hits, 1500);
    EXPECT_LE(differ, 3);
  }
}
}

TEST(NearestInstance, OfEveryPixelIsSeen)
{
  expectNearest({ 0.0f, 0.0f, 0.0f });
}

TEST(NearestInstance, WindowDepthsAreComparedWithTheirOffsets)
{
  expectNearest({ 0.0f, 0.003f, -0.002f });
  expectNearest({ -0.002f, 0.0f, 0.0f });
}

TEST(NearestInstance, OffsetsGrowWithTheSlope)
{
  expectNearest({ 0.0f, 0.0f, 0.0f }, { 0.0f, 2.0f, -3.0f });
  expectNearest({ 0.001f, 0.0f, 0.0f }, { -5.0f, -5.0f, -5.0f });
}

TEST(NearestInstance, TheSameDepthIsTheLastInstances)
{
  svo::Scene scene = ballRingAndGround();
  scene.instances = { scene.instances[1], scene.instances[1], scene.instances[1] };
  scene.instances[0].id = 9;
  scene.instances[2].id = 10;
  const svo::Frame frame = rendered(scene, Eye, smallBuffers());
  for (std::uint32_t instance : frame.instance)
  {
    EXPECT_TRUE(instance == 2 || instance == ~0u);
  }
}
