// Rays that stop at coarse nodes meet the side of a body that faces them, also where the body
// touches its octree's cube.
#include "svoLayeredView.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

using namespace svotest;

TEST(NearSide, IsWhatEveryRayThroughABallMeets)
{
  svo::Scene scene;
  scene.instances = { instanceOf(
    makeOctree(sphere(90, 120), 8), 1, glm::dmat4(1.0), svo::LeafGeometry::Plane) };
  const glm::dvec3 eyes[] = { { 5, 0, 0 }, { -5, 0, 0 }, { 0, 5, 0.01 }, { 0, -5, 0.01 },
    { 0.01, 0, 5 }, { 0.01, 0, -5 }, { 3, 3, 3 }, { 1, -4, 2 } };
  int hits = 0;
  int onBack[6] = {};
  for (const glm::dvec3& eye : eyes)
  {
    for (const svo::View& view :
      { lookAt(eye, 200, 200, 30.0), lookAtParallel(eye, 200, 200, 1.1) })
    {
      for (int level : { 2, 3, 4, 5 })
      {
        svo::LayeredView layers;
        svo::LayerBudget budget{ 0, 0 };
        layers.prepare(
          scene, view, [](const svo::Instance&) { return true; },
          [&](const svo::Instance&, const svo::LocalView&) { return level; }, false, budget);
        layers.trace(svo::serialFor, nullptr);
        ASSERT_EQ(layers.hits().instances.level(0), level);
        const svo::DepthBuffer& depth = layers.hits().depth;
        const double centre = glm::length(eye);
        for (int y = 0; y < view.height; ++y)
        {
          for (int x = 0; x < view.width; ++x)
          {
            const std::size_t at = depth.at(x, y);
            const glm::dvec3 origin = view.rayOrigin(x + 0.5, y + 0.5);
            const glm::dvec3 direction = view.rayDirection(x + 0.5, y + 0.5);
            const double nearest = -glm::dot(origin, direction) / glm::dot(direction, direction);
            // Where a ray passes well inside the ball.
            if (glm::length(origin + nearest * direction) > 0.6)
            {
              continue;
            }
            ASSERT_TRUE(depth.hit[at >> 6] && depth.instance[at] != svo::NoInstance);
            ++hits;
            onBack[level] += layers.hits().base(0) + depth.t[at] > centre;
          }
        }
      }
    }
  }
  EXPECT_GT(hits, 100000);
  for (int level : { 2, 3, 4, 5 })
  {
    EXPECT_EQ(onBack[level], 0) << "level " << level;
  }
}
