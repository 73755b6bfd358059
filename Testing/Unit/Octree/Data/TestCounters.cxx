// What VTKSVO_COUNTERS counts; this test is built with it only.
#include "svoCounters.h"
#include "svoIntersect.h"
#include "svoTestScenes.h"

#include <gtest/gtest.h>

#include <thread>

namespace
{
using namespace svo;

std::uint64_t of(const Counts& counts, Counter counter)
{
  return counts[static_cast<std::size_t>(counter)];
}

/// 64 rays along z into the octree's cube, side by side.
RayBlock raysAlongZ()
{
  RayBlock rays;
  for (int i = 0; i < RayBlock::Size; ++i)
  {
    rays.originX[i] = 1.06f + 0.125f * (i % 8);
    rays.originY[i] = 1.06f + 0.125f * (i / 8);
    rays.originZ[i] = 0.5f;
    rays.directionX[i] = rays.directionY[i] = 0.0f;
    rays.directionZ[i] = 1.0f;
    rays.tMin[i] = 0.0f;
    rays.tMax[i] = 10.0f;
  }
  return rays;
}
}

TEST(Counters, AreThoseOfAllThreadsSinceTheLastCall)
{
  takeCounts();
  count(Counter::NodesVisited, 2);
  std::thread([] { count(Counter::NodesVisited, 40); }).join();
  EXPECT_EQ(of(takeCounts(), Counter::NodesVisited), 42u);
  EXPECT_EQ(takeCounts(), Counts{});
}

TEST(Counters, PacketsVisitTheNodesThatSingleRaysDo)
{
  const Octree octree = svotest::makeOctree(svotest::soup(40, 0.3, 5), 6);
  ASSERT_TRUE(octree);
  const RayBlock rays = raysAlongZ();
  HitBlock hits;
  takeCounts();
  intersectBlockScalar(octree, rays, { LeafGeometry::Triangle }, hits);
  const Counts scalar = takeCounts();
  intersect(octree, rays, { LeafGeometry::Triangle }, hits);
  const Counts packets = takeCounts();
  EXPECT_GE(of(scalar, Counter::NodesVisited), 64u);
  EXPECT_EQ(of(scalar, Counter::IdleLanes), 0u);
  EXPECT_GT(of(packets, Counter::NodesVisited), 0u);
  // The packets' tables replace the way down from the root, or back to it.
  EXPECT_LE(of(packets, Counter::NodesVisited), of(scalar, Counter::NodesVisited));
  EXPECT_EQ(of(packets, Counter::TrianglesTested), of(scalar, Counter::TrianglesTested));
}
