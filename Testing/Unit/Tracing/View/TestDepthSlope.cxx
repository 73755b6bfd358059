// A plane's window depth is affine in the pixel: its slope leads from the depth of one pixel to
// those of all others, in any view; and frames have the slopes of the facets that they show.
#include "svoDepthSlope.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace svotest;

namespace
{
const svo::View Views[] = { lookAt({ 3, -4, 3 }, 80, 60), lookAtParallel({ 3, -4, 3 }, 80, 60, 2) };

/// Linear depth at which the ray of a point of the image meets the plane through the origin.
double depthAt(const svo::View& view, double x, double y, const glm::dvec3& normal)
{
  return -glm::dot(normal, view.rayOrigin(x, y)) / glm::dot(normal, view.rayDirection(x, y));
}
}

TEST(DepthSlope, LeadsFromPixelToPixel)
{
  for (const svo::View& view : Views)
  {
    for (const glm::dvec3& normal : { glm::dvec3(0, 0, 1), { 0.2, -3, 1 }, { -0.3, -0.4, 0.01 } })
    {
      const double x = 31.5, y = 22.5;
      const double t = depthAt(view, x, y, normal);
      const glm::dvec2 slope = svo::depthSlope(view, x, y, t, normal);
      EXPECT_GT(std::abs(slope.x) + std::abs(slope.y), 1e-5);
      for (const glm::dvec2& way : { glm::dvec2(1, 0), { 0, 1 }, { -0.4, 0.3 }, { 9, -7 } })
      {
        const double there = depthAt(view, x + way.x, y + way.y, normal);
        EXPECT_NEAR(view.windowDepth(t) + glm::dot(slope, way), view.windowDepth(there), 1e-12);
      }
    }
  }
}

TEST(DepthSlope, OfAPlaneSeenEdgeOnIsNone)
{
  const svo::View& view = Views[1];
  const glm::dvec3 normal = glm::cross(view.axis, glm::dvec3(0, 0, 1));
  const glm::dvec2 slope = svo::depthSlope(view, 40.5, 30.5, 5.0, normal);
  EXPECT_EQ(0.0, slope.x);
  EXPECT_EQ(0.0, slope.y);
}

TEST(DepthSlope, FramesHaveIt)
{
  const svo::Octree octree = makeOctree(square(1.0), 6);
  svo::Scene scene;
  scene.instances = { instanceOf(octree, 1) };
  svo::FrameSettings settings;
  settings.shadowTechnique = svo::ShadowTechnique::None;
  EXPECT_TRUE(rendered(scene, Views[0], settings).slopes.empty());
  settings.writeSlopes = true;
  for (const svo::View& view : Views)
  {
    const svo::Frame frame = rendered(scene, view, settings);
    int pairs = 0;
    for (std::size_t i = 0; i + frame.width < frame.depth.size(); ++i)
    {
      const float* slope = &frame.slopes[2 * i];
      const auto to = [&](std::size_t other, float by)
      {
        if (frame.depth[i] < 1.0f && frame.depth[other] < 1.0f)
        {
          ++pairs;
          EXPECT_NEAR(frame.depth[i] + by, frame.depth[other], 2e-7);
        }
      };
      if (frame.depth[i] == 1.0f)
      {
        EXPECT_EQ(0.0f, slope[0]);
        EXPECT_EQ(0.0f, slope[1]);
      }
      to(i + 1, slope[0]);
      to(i + frame.width, slope[1]);
    }
    EXPECT_GT(pairs, 500);
    // Where VTK's mappers write the depth of the pixel's centre.
    svo::Scene shifted = scene;
    shifted.instances[0].depthOffset.units = 1e-4f;
    for (float slope : rendered(shifted, view, settings).slopes)
    {
      EXPECT_EQ(0.0f, slope);
    }
  }
}
