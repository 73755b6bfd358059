// Tile queries against every triangle of the mesh, bit for bit, on every instruction set of this
// machine; and against the walk.
#include "svoInstructionSets.h"
#include "svoIntersect.h"
#include "svoIntersectTile.h"
#include "svoLocalView.h"
#include "svoNode.h"
#include "svoProjection.h"
#include "svoRayMeetsTriangle.h"
#include "svoReadyRay.h"
#include "svoTestScenes.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace
{
using namespace svo;
using svotest::onEveryInstructionSet;

/// The hit of one ray among all triangles.
void bruteForce(const Octree& octree, const RayBlock& rays, int i, float& t, Primitive& primitive)
{
  const Surface& surface = *octree.surface();
  const svotest::ReadyRay ray({ rays.originX[i], rays.originY[i], rays.originZ[i] },
    { rays.directionX[i], rays.directionY[i], rays.directionZ[i] });
  primitive = NoPrimitive;
  for (std::uint32_t id = 0; id < surface.triangles.size(); ++id)
  {
    float found;
    if (ray.meets(surface, id, found) && found >= rays.tMin[i] && found <= rays.tMax[i] &&
      (primitive == NoPrimitive || found <= t))
    {
      t = found;
      primitive = id;
    }
  }
}

/// Rays through the centres of a tile's pixels.
void fillTile(const LocalView& local, int tileX, int tileY, RayBlock& rays)
{
  for (int k = 0; k < 64; ++k)
  {
    const double x = 8 * tileX + (k & 7) + 0.5, y = 8 * tileY + (k >> 3) + 0.5;
    rays.aim(k, local.originAt(x, y), local.directionAt(x, y));
  }
}

/// A tile's rays and what they hit.
struct Task
{
  std::string name;
  RayBlock rays;
  TilePyramid pyramid;
  float tMax;
  HitBlock expected;
};

/// Random tiles of a view. Part of the rays end early.
void addTiles(const Octree& octree, const glm::dmat4& localToWorld, const View& view, int tiles,
  unsigned seed, std::vector<Task>& tasks)
{
  const LocalView local = makeLocalView(octree, localToWorld, view);
  if (local.rect.empty())
  {
    return;
  }
  const Projection projection = makeProjection(octree, localToWorld, view, local.base);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> tileX(local.rect.x0 / 8, (local.rect.x1 - 1) / 8);
  std::uniform_int_distribution<int> tileY(local.rect.y0 / 8, (local.rect.y1 - 1) / 8);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  for (int k = 0; k < tiles; ++k)
  {
    const int x = tileX(random), y = tileY(random);
    Task task;
    task.name = "seed " + std::to_string(seed) + ", tile " + std::to_string(k) + " at " +
      std::to_string(x) + ", " + std::to_string(y);
    fillTile(local, x, y, task.rays);
    task.pyramid = makePyramid(projection, view, x, y);
    task.tMax = local.tMax;
    const bool cut = k % 3 == 0;
    for (int i = 0; i < 64; ++i)
    {
      task.rays.tMin[i] = cut ? 0.3f * unit(random) * local.tMax : 0.0f;
      task.rays.tMax[i] = cut ? unit(random) * local.tMax : local.tMax;
      bruteForce(octree, task.rays, i, task.expected.t[i], task.expected.primitive[i]);
    }
    tasks.push_back(task);
  }
}

/// Returns the number of hits.
int compare(const Octree& octree, const Task& task)
{
  SCOPED_TRACE(task.name);
  std::vector<TileNode> nodes;
  EXPECT_TRUE(findTileNodes(octree, task.pyramid, 0.0f, task.tMax, 1 << 20, nodes));
  HitBlock hits;
  intersectTile(octree, task.pyramid, nodes, task.rays, hits);
  // Each ray alone meets what it is known to meet, at the same depth.
  HitBlock again;
  std::copy(hits.primitive, hits.primitive + 64, again.primitive);
  depthsOnTriangles(octree, task.rays, again);
  for (int i = 0; i < 64; ++i)
  {
    if (hits.primitive[i] != NoPrimitive)
    {
      float t = -1.0f;
      EXPECT_TRUE(rayMeetsTriangle(*octree.surface(),
        { task.rays.originX[i], task.rays.originY[i], task.rays.originZ[i] },
        { task.rays.directionX[i], task.rays.directionY[i], task.rays.directionZ[i] },
        hits.primitive[i], t));
      EXPECT_EQ(t, hits.t[i]) << "ray " << i;
      EXPECT_EQ(again.t[i], hits.t[i]) << "ray " << i;
    }
  }
  int count = 0;
  for (int i = 0; i < 64; ++i)
  {
    const Primitive expected = task.expected.primitive[i];
    EXPECT_EQ(hits.primitive[i], expected) << "ray " << i;
    if (expected != NoPrimitive && hits.primitive[i] == expected)
    {
      ++count;
      EXPECT_EQ(std::memcmp(&hits.t[i], &task.expected.t[i], sizeof(float)), 0)
        << "ray " << i << ": " << hits.t[i] << ", " << task.expected.t[i];
    }
  }
  return count;
}

svotest::Mesh box()
{
  svotest::Mesh mesh;
  for (int i = 0; i < 8; ++i)
  {
    mesh.points.push_back({ i & 1, i >> 1 & 1, i >> 2 });
  }
  const unsigned faces[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 },
    { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
  for (const auto& f : faces)
  {
    mesh.triangles.push_back({ f[0], f[1], f[2] });
    mesh.triangles.push_back({ f[0], f[2], f[3] });
  }
  return mesh;
}

struct Case
{
  const char* name;
  svotest::Mesh mesh;
  int level;
};

std::vector<Case> cases()
{
  return { { "square", svotest::square(1.0), 9 }, { "box", box(), 8 },
    { "sphere", svotest::sphere(30, 40), 8 }, { "torus", svotest::torus(40, 30), 9 },
    { "a coarse octree", svotest::torus(40, 30), 3 }, { "one level", svotest::sphere(4, 6), 1 },
    { "an octree of two depths", svotest::sphere(12, 16), 4 },
    { "soup", svotest::soup(600, 0.3, 5), 7 }, { "small soup", svotest::soup(1500, 0.05, 6), 9 } };
}

TEST(IntersectTile, FindsTheNearestOfAllTriangles)
{
  for (const Case& c : cases())
  {
    SCOPED_TRACE(c.name);
    const Octree octree = svotest::makeOctree(c.mesh, c.level);
    ASSERT_TRUE(octree);
    const glm::dmat4 one(1.0);
    const glm::dmat4 sheared(glm::dvec4(1.0, 0.3, 0.0, 0.0), glm::dvec4(0.0, -0.7, 0.2, 0.0),
      glm::dvec4(0.4, 0.0, 1.5, 0.0), glm::dvec4(0.2, 0.1, -0.3, 1.0));
    std::vector<Task> tasks;
    addTiles(octree, one, svotest::lookAt({ 3.0, -2.0, 2.5 }, 256, 192), 40, 1, tasks);
    addTiles(octree, one, svotest::lookAt({ 0.4, 0.9, 1.3 }, 256, 192), 40, 2, tasks);
    // So wide that rays of a tile are longest along different axes.
    addTiles(octree, one, svotest::lookAt({ 1.0, 1.1, 0.9 }, 64, 64, 150.0), 64, 3, tasks);
    // From inside.
    addTiles(octree, one, svotest::lookAt({ 0.02, 0.03, 0.05 }, 64, 64, 120.0), 40, 4, tasks);
    addTiles(octree, one, svotest::lookAtParallel({ 2.0, 1.0, 3.0 }, 200, 160, 1.2), 40, 5, tasks);
    // Along an axis: through vertices, along edges and faces.
    addTiles(octree, one, svotest::lookAtParallel({ 3.0, 0.0, 0.0 }, 128, 128, 1.0), 40, 6, tasks);
    addTiles(octree, sheared, svotest::lookAt({ 3.0, -2.0, 2.5 }, 256, 192), 40, 7, tasks);
    onEveryInstructionSet(
      [&]
      {
        int hits = 0;
        for (const Task& task : tasks)
        {
          hits += compare(octree, task);
          if (HasFailure()) // of one tile is enough
          {
            return;
          }
        }
        EXPECT_GT(hits, 500) << "too few to say anything";
      });
  }
}

TEST(IntersectTile, FindsWhatTheWalkFinds)
{
  for (const Case& c : cases())
  {
    SCOPED_TRACE(c.name);
    const Octree octree = svotest::makeOctree(c.mesh, c.level);
    const View view = svotest::lookAt({ 2.0, -1.5, 1.7 }, 320, 240);
    const LocalView local = makeLocalView(octree, glm::dmat4(1.0), view);
    const Projection projection = makeProjection(octree, glm::dmat4(1.0), view, local.base);
    std::vector<TileNode> nodes;
    int rays = 0, others = 0;
    for (int y = local.rect.y0 / 8; 8 * y < local.rect.y1; ++y)
    {
      for (int x = local.rect.x0 / 8; 8 * x < local.rect.x1; ++x)
      {
        RayBlock block;
        fillTile(local, x, y, block);
        std::fill(block.tMin, block.tMin + 64, 0.0f);
        std::fill(block.tMax, block.tMax + 64, local.tMax);
        HitBlock tile, walk;
        const TilePyramid pyramid = makePyramid(projection, view, x, y);
        ASSERT_TRUE(findTileNodes(octree, pyramid, 0.0f, local.tMax, 1 << 20, nodes));
        intersectTile(octree, pyramid, nodes, block, tile);
        intersect(octree, block, { LeafGeometry::Triangle, octree.level() }, walk);
        for (int i = 0; i < 64; ++i)
        {
          ++rays;
          const bool same = tile.primitive[i] == walk.primitive[i] &&
            (tile.primitive[i] == NoPrimitive || tile.t[i] == walk.t[i]);
          others += !same;
        }
      }
    }
    EXPECT_GT(rays, 10000);
    // The walk goes by cells, whose borders round.
    EXPECT_LE(others, rays / 100000) << rays;
  }
}

TEST(IntersectTile, RaysThatAreNotRaysHitNothing)
{
  const Octree octree = svotest::makeOctree(svotest::sphere(30, 40), 7);
  const View view = svotest::lookAt({ 5.0, 0.0, 0.0 }, 64, 64, 10.0);
  const LocalView local = makeLocalView(octree, glm::dmat4(1.0), view);
  const Projection projection = makeProjection(octree, glm::dmat4(1.0), view, local.base);
  const TilePyramid pyramid = makePyramid(projection, view, 4, 4);
  std::vector<TileNode> nodes;
  ASSERT_TRUE(findTileNodes(octree, pyramid, 0.0f, local.tMax, 1 << 20, nodes));
  RayBlock block;
  fillTile(local, 4, 4, block);
  std::fill(block.tMin, block.tMin + 64, 0.0f);
  std::fill(block.tMax, block.tMax + 64, local.tMax);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  block.originX[0] = nan;
  block.directionY[1] = nan;
  block.tMin[2] = nan;
  block.tMax[3] = nan;
  block.originZ[4] = infinity;
  block.directionX[5] = -infinity;
  block.directionX[6] = block.directionY[6] = block.directionZ[6] = 0.0f;
  block.tMin[7] = 1.0f;
  block.tMax[7] = 0.0f;
  onEveryInstructionSet(
    [&]
    {
      HitBlock hits;
      intersectTile(octree, pyramid, nodes, block, hits);
      for (int i = 0; i < 64; ++i)
      {
        EXPECT_EQ(hits.primitive[i] == NoPrimitive, i < 8) << i;
      }
    });
}

TEST(IntersectTile, StopsWhereThereIsTooMuch)
{
  const Octree octree = svotest::makeOctree(svotest::torus(200, 150), 9);
  const View view = svotest::lookAt({ 30.0, 0.0, 0.0 }, 8, 8, 10.0);
  const LocalView local = makeLocalView(octree, glm::dmat4(1.0), view);
  const Projection projection = makeProjection(octree, glm::dmat4(1.0), view, local.base);
  const TilePyramid pyramid = makePyramid(projection, view, 0, 0);
  std::vector<TileNode> nodes;
  EXPECT_FALSE(findTileNodes(octree, pyramid, 0.0f, local.tMax, 100, nodes));
  EXPECT_TRUE(findTileNodes(octree, pyramid, 0.0f, local.tMax, 1 << 20, nodes));
  EXPECT_GT(nodes.size(), 100u);
  for (std::size_t k = 1; k < nodes.size(); ++k)
  {
    EXPECT_LE(nodes[k - 1].tNear, nodes[k].tNear);
  }
}

TEST(ShortLists, HoldTheTrianglesBelow)
{
  for (const Case& c : cases())
  {
    SCOPED_TRACE(c.name);
    const Octree octree = svotest::makeOctree(c.mesh, c.level);
    const ShortLists& lists = octree.shortLists();
    ASSERT_EQ(lists.begin.size(), octree.brickBegin());
    // From the root down: the triangles of every subtree, from its bricks.
    const auto below = [&](auto&& self, std::uint32_t node, std::set<std::uint32_t>& ids) -> void
    {
      if (node >= octree.brickBegin())
      {
        std::uint32_t count, inlineId;
        const std::uint32_t* list = octree.brickTriangles(node, count, inlineId);
        ids.insert(list, list + count);
        return;
      }
      const Node& inner = octree.nodes()[node];
      for (int k = 0; k < childCount(inner); ++k)
      {
        self(self, inner.first + k, ids);
      }
    };
    const auto check = [&](auto&& self, std::uint32_t node) -> void
    {
      if (node >= octree.brickBegin())
      {
        return;
      }
      std::set<std::uint32_t> ids;
      below(below, node, ids);
      const std::uint32_t begin = lists.begin[node];
      ASSERT_EQ(begin != ShortLists::None, ids.size() <= ShortLists::Most);
      if (begin != ShortLists::None)
      {
        const std::uint32_t* list = lists.words.data() + begin;
        ASSERT_EQ(std::vector<std::uint32_t>(list + 1, list + 1 + list[0]),
          std::vector<std::uint32_t>(ids.begin(), ids.end()));
        return; // nothing is written below
      }
      const Node& inner = octree.nodes()[node];
      for (int k = 0; k < childCount(inner); ++k)
      {
        self(self, inner.first + k);
      }
    };
    check(check, 0);
  }
}
}
