// A view that looks at a part of its image: what it has kept while that part moves on is what is
// found anew, to the bit; and it sees what a view of the part alone sees.
#include "svoInstructionSets.h"
#include "svoLayeredView.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <vector>

using namespace svotest;

namespace
{
constexpr int Edge = 200; // pixels of a crop

/// A large image of what is around the origin.
svo::View imageOf(bool parallel, int size)
{
  svo::View view = parallel ? lookAtParallel({ 2.0, 1.0, 3.0 }, size, size, 1.7)
                            : lookAt({ 3.0, -2.0, 1.5 }, size, size);
  view.crop = { 0, 0, Edge, Edge };
  return view;
}

void moveTo(int x, int y, svo::View& view)
{
  const int most = (view.width - Edge) / 8;
  const int column = 8 * std::clamp(x / 8, 0, most), row = 8 * std::clamp(y / 8, 0, most);
  view.crop = { column, row, column + Edge, row + Edge };
}

/// To where a point of the world is in the middle.
void moveTo(const glm::dvec3& point, svo::View& view)
{
  const glm::dvec4 clip = view.viewToClip * view.worldToView * glm::dvec4(point, 1.0);
  const auto pixel = [&](double at, int size)
  { return static_cast<int>((at / clip.w + 1.0) * 0.5 * size) - Edge / 2; };
  moveTo(pixel(clip.x, view.width), pixel(clip.y, view.height), view);
}

svo::Scene sceneOf(svo::LeafGeometry geometry)
{
  svo::Scene scene = ballRingAndGround(geometry);
  scene.instances[1].localToWorld = movedTo(-0.6, 0.1, 0.2);
  scene.instances[2].localToWorld = movedTo(0.3, 0.0, 0.1);
  return scene;
}

bool prepare(svo::LayeredView& layers, const svo::Scene& scene, const svo::View& view, bool keep)
{
  static svo::LayerBudget budget{ std::size_t(1) << 28, 0 };
  return layers.prepare(
    scene, view, [](const svo::Instance&) { return true; },
    [](const svo::Instance& i, const svo::LocalView&) { return i.body->octree.level(); }, keep,
    budget);
}

/// By place of a tile: three of four, others in each frame.
std::vector<std::uint8_t> someTiles(const svo::TileGrid& grid, int frame)
{
  std::vector<std::uint8_t> wanted(grid.size(), 0);
  for (int y = grid.y0; y < grid.y0 + grid.tilesY; ++y)
  {
    for (int x = grid.x0; x < grid.x0 + grid.tilesX; ++x)
    {
      wanted[grid.index(x, y)] = (x + 3 * y + frame) % 4 != 0;
    }
  }
  return wanted;
}

struct Comparison
{
  int hits = 0, different = 0;
  std::set<std::uint32_t> seen; // instances
};

/// Tiles that were wanted of both.
Comparison compare(const svo::DepthBuffer& a, const svo::DepthBuffer& b, const svo::Hits& ofA,
  const svo::Hits& ofB, const std::vector<std::uint8_t>& wanted)
{
  Comparison found;
  const svo::TileGrid& grid = a.grid;
  for (int y = 8 * grid.y0; y < 8 * (grid.y0 + grid.tilesY); ++y)
  {
    for (int x = 8 * grid.x0; x < 8 * (grid.x0 + grid.tilesX); ++x)
    {
      if (!wanted[grid.index(x / 8, y / 8)])
      {
        continue;
      }
      const std::uint32_t instance = a.instanceAt(x, y);
      const bool same = instance == b.instanceAt(x, y) &&
        a.primitiveAt(x, y) == b.primitiveAt(x, y) &&
        (instance == svo::NoInstance ||
          ofA.base(instance) + a.t[a.at(x, y)] == ofB.base(instance) + b.t[b.at(x, y)]);
      found.hits += instance != svo::NoInstance;
      found.different += !same;
      found.seen.insert(instance);
    }
  }
  return found;
}

void walk(const svo::View& image, svo::LeafGeometry geometry)
{
  std::mt19937 random(image.width);
  std::uniform_int_distribution<int> step(-40, 60);
  svo::Scene scene = sceneOf(geometry);
  svo::View view = image;
  svo::LayeredView kept(false);
  std::uint64_t keptRays = 0, rays = 0;
  int hits = 0;
  std::set<std::uint32_t> seen;
  for (int frame = 0; frame < 12; ++frame)
  {
    if (frame % 6 == 0)
    {
      // Where the ball ends on the right, and on the ring.
      moveTo(frame == 6 ? glm::dvec3(0.3, 0.7, 0.1) : glm::dvec3(0.3, 0.1, 0.2), view);
    }
    else
    {
      moveTo(view.crop.x0 + step(random), view.crop.y0 + step(random), view);
    }
    if (frame % 5 == 4)
    {
      scene.instances[1].localToWorld[3][2] += 3.0 / view.width;
    }
    svo::LayeredView fresh(false);
    ASSERT_TRUE(prepare(kept, scene, view, true));
    ASSERT_TRUE(prepare(fresh, scene, view, true));
    const std::vector<std::uint8_t> wanted = someTiles(svo::TileGrid(view), frame);
    kept.trace(svo::serialFor, wanted.data());
    fresh.trace(svo::serialFor, wanted.data());
    const Comparison found =
      compare(kept.hits().depth, fresh.hits().depth, kept.hits(), fresh.hits(), wanted);
    ASSERT_EQ(found.different, 0) << "frame " << frame;
    hits += found.hits;
    seen.insert(found.seen.begin(), found.seen.end());
    keptRays += kept.rays();
    rays += fresh.rays();
  }
  EXPECT_GT(hits, 12 * Edge * Edge / 8);
  EXPECT_GE(seen.size(), 2u);
  EXPECT_LT(keptRays, rays * 2 / 3);
}
}

TEST(TileGrid, TilesHaveAPlaceEachAndKeepIt)
{
  svo::View view = imageOf(true, 8000);
  moveTo(1000, 4000, view);
  const svo::TileGrid first(view);
  moveTo(1000 + 72, 4000 - 56, view);
  const svo::TileGrid second(view);
  for (const svo::TileGrid& grid : { first, second })
  {
    ASSERT_EQ(grid.tilesX, Edge / 8);
    std::set<std::size_t> places;
    for (int y = grid.y0; y < grid.y0 + grid.tilesY; ++y)
    {
      for (int x = grid.x0; x < grid.x0 + grid.tilesX; ++x)
      {
        const std::size_t place = grid.index(x, y);
        ASSERT_TRUE(place < grid.size() && places.insert(place).second);
        ASSERT_TRUE(grid.tileX(place) == x && grid.tileY(place) == y && grid.holds(x, y));
        ASSERT_EQ(place, first.index(x, y));
      }
    }
    const svo::PixelRect rect{ view.crop.x0 - 40, view.crop.y0 + 16, view.crop.x0 + 120,
      view.crop.y1 + 80 };
    std::set<std::size_t> expected, found;
    for (const std::size_t place : places)
    {
      const int x = 8 * grid.tileX(place), y = 8 * grid.tileY(place);
      if (rect.overlaps({ x, y, x + 8, y + 8 }))
      {
        expected.insert(place);
      }
    }
    grid.eachStretch(rect,
      [&](std::size_t from, std::size_t to)
      {
        for (std::size_t place = from; place < to; ++place)
        {
          EXPECT_TRUE(found.insert(place).second);
        }
      });
    EXPECT_EQ(found, expected);
  }
}

TEST(TileGrid, OfAWholeImageIsRowByRow)
{
  const svo::TileGrid grid(lookAt({ 3, 2, 1 }, 100, 50));
  EXPECT_EQ(grid.size(), 13u * 7u);
  EXPECT_EQ(grid.index(5, 3), 3u * 13u + 5u);
  EXPECT_EQ(grid.tileX(44), 5);
  EXPECT_EQ(grid.tileY(44), 3);
}

TEST(CroppedView, KeepsWhatItHasInCommonWithTheLastFrame)
{
  for (const bool parallel : { true, false })
  {
    for (const int size : { 1000, 1 << 20 })
    {
      for (const svo::LeafGeometry geometry :
        { svo::LeafGeometry::Triangle, svo::LeafGeometry::Voxel, svo::LeafGeometry::Plane })
      {
        SCOPED_TRACE(std::to_string(size) + (parallel ? " parallel " : " perspective ") +
          std::to_string(static_cast<int>(geometry)));
        walk(imageOf(parallel, size), geometry);
      }
    }
  }
}

TEST(CroppedView, OfEveryInstructionSetKeepsIt)
{
  for (const svo::LeafGeometry geometry :
    { svo::LeafGeometry::Triangle, svo::LeafGeometry::Voxel, svo::LeafGeometry::Plane })
  {
    SCOPED_TRACE(static_cast<int>(geometry));
    onEveryInstructionSet([geometry] { walk(imageOf(false, 1 << 20), geometry); });
  }
}

// Of the same rays but for rounding.
TEST(CroppedView, SeesWhatAViewOfTheCropAloneSees)
{
  for (const bool parallel : { true, false })
  {
    for (const int size : { 1000, 1 << 14, 1 << 20, 1 << 27 })
    {
      SCOPED_TRACE(std::to_string(size) + (parallel ? " parallel" : " perspective"));
      const svo::Scene scene = sceneOf(svo::LeafGeometry::Triangle);
      svo::View view = imageOf(parallel, size);
      moveTo(glm::dvec3(0.3, 0.1, 0.2), view);
      const svo::View alone = svo::cropped(view);
      ASSERT_EQ(alone.width, Edge);
      for (const double at : { 0.5, 100.5, 199.5 })
      {
        const double x = view.crop.x0 + at, y = view.crop.y0 + 0.5 * at;
        const glm::dvec3 expected = view.rayOrigin(x, y) + 3.0 * view.rayDirection(x, y);
        const glm::dvec3 found =
          alone.rayOrigin(at, 0.5 * at) + 3.0 * alone.rayDirection(at, 0.5 * at);
        EXPECT_LT(glm::length(found - expected), 1e-13 + 1e-3 * 4.0 / size);
      }
      svo::LayeredView a(false), b(false);
      ASSERT_TRUE(prepare(a, scene, view, true));
      ASSERT_TRUE(prepare(b, scene, alone, true));
      a.trace(svo::serialFor, nullptr);
      b.trace(svo::serialFor, nullptr);
      int hits = 0, different = 0;
      for (int y = 0; y < Edge; ++y)
      {
        for (int x = 0; x < Edge; ++x)
        {
          const std::uint32_t here = a.hits().depth.instanceAt(view.crop.x0 + x, view.crop.y0 + y);
          hits += here != svo::NoInstance;
          different += here != b.hits().depth.instanceAt(x, y);
        }
      }
      EXPECT_GT(hits, Edge * Edge / 8);
      EXPECT_LE(different, 4); // at edges
    }
  }
}
