// What is known of the tiles of a shadow buffer's map, against a look at each of their texels.
#include "svoInstructionSets.h"
#include "svoLayeredView.h"
#include "svoTileOccluders.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>

using namespace svo;

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();

struct Expected
{
  double nearest = Infinity, farthest = -Infinity;
  std::uint32_t caster = NoInstance;
};

Expected lookAtEachTexel(const Hits& map, const MapTiles& tiles)
{
  const DepthBuffer& depth = map.depth;
  Expected expected;
  bool first = true;
  for (int y = 8 * tiles.y0; y < 8 * (tiles.y1 + 1); ++y)
  {
    for (int x = 8 * tiles.x0; x < 8 * (tiles.x1 + 1); ++x)
    {
      const std::size_t at = depth.at(x, y);
      const std::uint32_t caster = depth.hit[at >> 6] ? depth.instance[at] : NoInstance;
      expected.caster =
        first || caster == expected.caster ? caster : std::uint32_t(TileOccluders::Several);
      first = false;
      if (caster != NoInstance)
      {
        expected.nearest = std::min(expected.nearest, map.base(caster) + depth.t[at]);
        expected.farthest = std::max(expected.farthest, map.base(caster) + depth.t[at]);
      }
      else
      {
        expected.farthest = Infinity;
      }
    }
  }
  return expected;
}

struct Count
{
  int nobody = 0, one = 0, several = 0, full = 0;
};

/// Boxes of tiles all over the map.
Count compare(const Hits& map, const MapOccluders& occluders)
{
  const DepthBuffer& depth = map.depth;
  Count count;
  for (int y = 0; y < depth.grid.tilesY; ++y)
  {
    for (int x = 0; x < depth.grid.tilesX; ++x)
    {
      const MapTiles box{ x, y, std::min(x + (x + y) % 3, depth.grid.tilesX - 1),
        std::min(y + x % 4, depth.grid.tilesY - 1) };
      const Expected expected = lookAtEachTexel(map, box);
      const TileOccluders found = occluders.in(box, depth.grid);
      EXPECT_EQ(found.caster, expected.caster) << x << ", " << y;
      EXPECT_LE(static_cast<double>(found.nearest), expected.nearest);
      EXPECT_EQ(std::isinf(found.nearest), std::isinf(expected.nearest));
      if (!std::isinf(expected.nearest))
      {
        EXPECT_GT(found.nearest, expected.nearest - 1e-6 * std::abs(expected.nearest));
      }
      EXPECT_GE(static_cast<double>(found.farthest), expected.farthest);
      EXPECT_EQ(std::isinf(found.farthest), std::isinf(expected.farthest));
      if (!std::isinf(expected.farthest))
      {
        EXPECT_LT(found.farthest, expected.farthest + 1e-6 * std::abs(expected.farthest));
        ++count.full;
      }
      ++(found.caster == NoInstance                ? count.nobody
          : found.caster == TileOccluders::Several ? count.several
                                                   : count.one);
    }
  }
  return count;
}

Count compareFrame(const Scene& scene, const View& view, LayeredView& map, MapOccluders& occluders)
{
  LayerBudget budget{ 1 << 30, 0 };
  map.prepare(
    scene, view, [](const Instance&) { return true; },
    [](const Instance& instance, const LocalView&) { return instance.body->octree.level(); }, true,
    budget);
  map.trace(serialFor, nullptr);
  occluders.find(map.hits(), serialFor);
  return compare(map.hits(), occluders);
}

/// Frames in which objects move, and others.
void compareFrames()
{
  const svotest::Mesh ball = svotest::sphere(24, 24);
  const Octree octree = svotest::makeOctree(ball, 7);
  Scene scene;
  for (int i = 0; i < 3; ++i)
  {
    scene.instances.push_back(svotest::instanceOf(
      octree, i + 1, svotest::movedTo(1.2 * i - 1.2, 0.3 * i, 0.4 * i), LeafGeometry::Triangle));
  }
  const View view = svotest::lookAt({ 1, -7, 3 }, 396, 260);
  LayeredView map(false);
  MapOccluders occluders;
  EXPECT_FALSE(occluders.known());
  EXPECT_EQ(TileOccluders::Several, occluders.in({ 0, 0, 0, 0 }, svo::TileGrid(view)).caster);
  const Count first = compareFrame(scene, view, map, occluders);
  EXPECT_GT(first.nobody, 100);
  EXPECT_GT(first.one, 100);
  EXPECT_GT(first.several, 100);
  EXPECT_GT(first.full, 100);
  // Of the next frames only what has changed is looked at.
  for (int frame = 0; frame < 4; ++frame)
  {
    SCOPED_TRACE(frame);
    scene.instances[frame % 3].localToWorld[3].x += frame < 2 ? 0.2 : 9.0;
    compareFrame(scene, view, map, occluders);
    compareFrame(scene, view, map, occluders);
  }
  compareFrame(scene, svotest::lookAt({ 2, -7, 1 }, 200, 300), map, occluders);
  occluders.forget();
  compareFrame(scene, svotest::lookAt({ 2, -7, 1 }, 200, 300), map, occluders);
}
}

TEST(TileOccluders, AreThoseOfTheTexels)
{
  svotest::onEveryInstructionSet(compareFrames);
}
