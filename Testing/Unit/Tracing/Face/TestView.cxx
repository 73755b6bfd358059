#include "svoTracerScenes.h"
#include "svoView.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{
const glm::dmat4 Camera =
  glm::lookAt(glm::dvec3(3, -5, 2), glm::dvec3(0.5, 0.25, -1), glm::dvec3(0, 0, 1));

/// A point at depth t of a pixel's ray projects back to the pixel and the depth.
void expectRoundTrip(const svo::View& view)
{
  for (double x : { 0.0, 0.5, 17.25, 64.0 })
  {
    for (double y : { 0.0, 11.5, 48.0 })
    {
      for (double t : { 0.6, 3.0, 19.0 })
      {
        const glm::dvec3 world = view.rayOrigin(x, y) + t * view.rayDirection(x, y);
        const glm::dvec4 eye = view.worldToView * glm::dvec4(world, 1.0);
        const glm::dvec4 clip = view.viewToClip * eye;
        EXPECT_NEAR(-eye.z, t, 1e-12 * (1 + t));
        EXPECT_NEAR((clip.x / clip.w + 1) / 2 * view.width, x, 1e-9);
        EXPECT_NEAR((clip.y / clip.w + 1) / 2 * view.height, y, 1e-9);
        EXPECT_NEAR(view.windowDepth(t), clip.z / clip.w / 2 + 0.5, 1e-12);
        EXPECT_NEAR(view.linearDepth(view.windowDepth(t)), t, 1e-9 * (1 + t));
      }
    }
  }
  EXPECT_NEAR(view.windowDepth(view.tNear), 0.0, 1e-9);
  EXPECT_NEAR(view.windowDepth(view.tFar), 1.0, 1e-9);
}
}

TEST(View, PerspectiveRaysProjectBackToTheirPixels)
{
  svo::View view;
  ASSERT_TRUE(svo::makeView(Camera, glm::perspective(0.7, 4.0 / 3.0, 0.5, 20.0), 64, 48, view));
  EXPECT_FALSE(view.parallel);
  EXPECT_NEAR(view.tNear, 0.5, 1e-9);
  EXPECT_NEAR(view.tFar, 20.0, 1e-9);
  expectRoundTrip(view);
}

TEST(View, ParallelRaysProjectBackToTheirPixels)
{
  svo::View view;
  ASSERT_TRUE(svo::makeView(Camera, glm::ortho(-4.0, 4.0, -3.0, 3.0, -2.0, 20.0), 64, 48, view));
  EXPECT_TRUE(view.parallel);
  EXPECT_NEAR(view.tNear, -2.0, 1e-9);
  expectRoundTrip(view);
}

TEST(View, OffAxisAndShearedProjectionsProjectBack)
{
  svo::View view;
  glm::dmat4 projection = glm::frustum(-0.1, 0.4, -0.3, 0.05, 0.5, 20.0);
  ASSERT_TRUE(svo::makeView(Camera, projection, 64, 48, view));
  expectRoundTrip(view);
  projection[1][0] = 0.2; // x depends on y
  projection[3][0] = 0.1;
  ASSERT_TRUE(svo::makeView(Camera, projection, 64, 48, view));
  expectRoundTrip(view);
}

TEST(View, RefusesWhatIsNoProjection)
{
  svo::View view;
  const glm::dmat4 good = glm::perspective(0.7, 1.0, 0.5, 20.0);
  EXPECT_FALSE(svo::makeView(Camera, good, 0, 48, view));
  glm::dmat4 bad = good;
  bad[0][0] = 0.0;
  EXPECT_FALSE(svo::makeView(Camera, bad, 64, 48, view));
  bad = good;
  bad[2][2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(svo::makeView(Camera, bad, 64, 48, view));
  bad = good;
  bad[0][3] = 0.1; // depth would depend on x
  EXPECT_FALSE(svo::makeView(Camera, bad, 64, 48, view));
}
