// The nearest triangles of a group's tiles against the float test of every ray: whatever is decided
// without it has to agree, and the bounds have to hold for each triangle at each pixel.
#include "svoInstructionSets.h"
#include "svoIntersectTile.h"
#include "svoPixelFunctions.h"
#include "svoProjection.h"
#include "svoRayMeetsTriangle.h"
#include "svoTestScenes.h"
#include "svoTracerScenes.h"
#include "svoTriangleGroup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace
{
using namespace svo;

/// A mesh that a view sees, and the functions of its pixels.
struct Stage
{
  Octree octree;
  View view;
  LocalView local;
  Projection projection;
  PixelFunctions functions;
  KeyBase keys;

  Stage(const Octree& of, const View& seenBy, const glm::dmat4& localToWorld, bool deep)
    : octree(of)
    , view(seenBy)
    , local(makeLocalView(of, localToWorld, seenBy))
  {
    if (local.rect.empty())
    {
      return;
    }
    projection = makeProjection(octree, localToWorld, view, local.base);
    functions = PixelFunctions(local, view);
    const double far = (view.parallel ? local.base : functions.wBase) + local.tMax;
    keys = { static_cast<float>(far), deep && !view.parallel };
  }
  /// False if the group cannot be made ready.
  bool makeReady(int tileX, int tileY, SmallTriangles small, TriangleGroup& group) const
  {
    std::vector<GroupNode> nodes;
    EXPECT_TRUE(functions.valid);
    EXPECT_TRUE(findGroupNodes(
      octree, makePyramid(projection, view, tileX, tileY, 4), 0.0f, local.tMax, 1 << 20, nodes));
    group.clear();
    return group.add(
      octree, nodes, makeGroupView(local, functions, keys, HitLimits(), tileX, tileY), small, 7);
  }
  bool meets(double x, double y, std::uint32_t triangle, float& t) const
  {
    return rayMeetsTriangle(*octree.surface(), glm::vec3(local.originAt(x, y)),
             glm::vec3(local.directionAt(x, y)), triangle, t) &&
      t >= 0.0f && t <= local.tMax;
  }
};

struct Tally
{
  int groups = 0, refused = 0;
  long rays = 0, hits = 0, doubtful = 0, small = 0;
  long points = 0, undecided = 0, hidden = 0;
  double worstKey = 0.0;  // of what is allowed
  double worstEdge = 0.0; // likewise, where a decision hung on it
};

void compareTile(const Stage& stage, const TriangleGroup& group, int tileX, int tileY, int column,
  int row, Tally& tally)
{
  std::vector<TileNode> nodes;
  const TilePyramid pyramid =
    makePyramid(stage.projection, stage.view, tileX + column, tileY + row);
  ASSERT_TRUE(findTileNodes(stage.octree, pyramid, 0.0f, stage.local.tMax, 1 << 20, nodes));
  RayBlock rays;
  HitBlock expected;
  double x[64], y[64];
  for (int i = 0; i < 64; ++i)
  {
    x[i] = 8 * (tileX + column) + (i & 7) + 0.5;
    y[i] = 8 * (tileY + row) + (i >> 3) + 0.5;
    rays.aim(i, stage.local.originAt(x[i], y[i]), stage.local.directionAt(x[i], y[i]));
    rays.tMin[i] = 0.0f;
    rays.tMax[i] = stage.local.tMax;
  }
  intersectTile(stage.octree, pyramid, nodes, rays, expected);
  NearestTriangles found;
  std::uint32_t triangles[64], owners[64];
  const bool any = group.nearest(column, row, found, triangles, owners);
  group.findCandidates(column, row, any ? found.doubtful : 0, found);
  for (int i = 0; i < 64; ++i)
  {
    ++tally.rays;
    tally.hits += expected.primitive[i] != NoPrimitive;
    if (!any)
    {
      ASSERT_EQ(expected.primitive[i], NoPrimitive) << x[i] << ", " << y[i];
      continue;
    }
    Primitive first = NoPrimitive;
    if (found.doubtful >> i & 1)
    {
      ++tally.doubtful;
      float t = 0.0f;
      for (const CandidateTriangle& candidate : found.candidates)
      {
        float other;
        ASSERT_EQ(candidate.owner, 7u);
        const std::uint32_t triangle = candidate.triangle;
        if ((candidate.pixels >> i & 1) && stage.meets(x[i], y[i], triangle, other) &&
          (first == NoPrimitive || other < t || (other == t && triangle > first)))
        {
          t = other;
          first = triangle;
        }
      }
    }
    else if (found.slot[i] != NearestTriangles::None)
    {
      first = triangles[i];
      ASSERT_EQ(owners[i], 7u);
      if (found.slot[i] == NearestTriangles::Small)
      {
        ++tally.small;
      }
      else
      {
        ASSERT_EQ(group.triangle(found.slot[i]), first);
        ASSERT_EQ(group.owner(found.slot[i]), 7u);
      }
    }
    ASSERT_TRUE((found.doubtful >> i & 1) || triangles[i] == first);
    ASSERT_EQ(first, expected.primitive[i])
      << x[i] << ", " << y[i] << (found.doubtful >> i & 1 ? ", doubtful" : "");
  }
}

/// What is said of each triangle at each pixel against its float test.
void checkBounds(const Stage& stage, const TriangleGroup& group, int tileX, int tileY, Tally& tally)
{
  const TriangleGroup::Slots& s = group.slots();
  for (std::size_t k = 0; k < s.count; ++k)
  {
    for (int row = 0; row < GroupView::Pixels; ++row)
    {
      for (int column = 0; column < GroupView::Pixels; ++column)
      {
        const double x = 8 * tileX + column + 0.5, y = 8 * tileY + row + 0.5;
        float t;
        const bool hit = stage.meets(x, y, s.id[k], t);
        const bool inBox =
          column >= s.x0[k] && column <= s.x1[k] && row >= s.y0[k] && row <= s.y1[k];
        ASSERT_TRUE(inBox || !hit) << "outside of the box";
        if (!inBox)
        {
          continue;
        }
        const float px = static_cast<float>(column) - 15.5f, py = static_cast<float>(row) - 15.5f;
        float least = std::numeric_limits<float>::infinity(), most = -least;
        for (int e = 0; e < 3; ++e)
        {
          const float edge = s.ex[e][k] * px + s.ey[e][k] * py + s.ec[e][k];
          least = std::min(least, edge);
          most = std::max(most, edge);
        }
        const double key = s.kx[k] * px + s.ky[k] * py + s.kc[k];
        const bool thin = (s.flags[k] & TriangleGroup::Thin) != 0;
        if (hit)
        {
          ASSERT_TRUE(least >= -1.0f || (thin && most <= 1.0f)) << least << ", " << most;
          const double off = (stage.functions.key(t, stage.keys) - key) / s.slack[k];
          ASSERT_TRUE(thin ? off >= -1.0 : std::abs(off) <= 1.0) << off;
          if (!thin)
          {
            tally.worstKey = std::max(tally.worstKey, std::abs(off));
            tally.worstEdge = std::max(tally.worstEdge, -double(least));
          }
        }
        else if (!thin && key - s.slack[k] >= s.kNear[k] && key + s.slack[k] <= s.kFar[k])
        {
          ASSERT_LE(least, 1.0f);
          tally.worstEdge = std::max(tally.worstEdge, double(least));
        }
      }
    }
  }
}

/// The same of triangles of a few pixels, at the pixels where they are said to be met.
void checkPoints(const Stage& stage, const TriangleGroup& group, int tileX, int tileY, Tally& tally)
{
  const TriangleGroup::Slots& slots = group.slots();
  const SeenPoints& points = group.small().points();
  const std::set<std::uint32_t> drawn(slots.id.begin(), slots.id.begin() + slots.count);
  std::map<std::uint32_t, std::map<int, std::size_t>> seen;
  for (std::size_t k = 0; k < points.count; ++k)
  {
    const std::uint32_t triangle = points.triangle[k] & ~SeenPoints::Steep;
    ASSERT_EQ(drawn.count(triangle), 0u) << "drawn twice";
    ASSERT_TRUE(seen[triangle].emplace(points.pixel[k], k).second) << "drawn twice";
  }
  for (std::uint32_t triangle = 0; triangle < stage.octree.surface()->triangles.size(); ++triangle)
  {
    if (drawn.count(triangle))
    {
      continue;
    }
    for (int pixel = 0; pixel < GroupPixels::Count; ++pixel)
    {
      const double x = 8 * tileX + pixel % GroupView::Pixels + 0.5;
      const double y = 8 * tileY + pixel / GroupView::Pixels + 0.5;
      float t;
      const bool hit = stage.meets(x, y, triangle, t);
      const auto known = seen.find(triangle);
      const bool maybe = known != seen.end() && known->second.count(pixel);
      if (!maybe)
      {
        // Not looked at, perhaps: then something else is certainly nearer.
        const bool hides = !group.small().empty() &&
          stage.functions.key(t, stage.keys) > group.small().upper()[pixel];
        ASSERT_TRUE(!hit || hides) << "not seen";
        tally.hidden += hit;
        continue;
      }
      const std::size_t k = known->second[pixel];
      const bool surely = std::isfinite(points.high[k]);
      ASSERT_TRUE(hit || !surely) << "not met";
      const double key = hit ? stage.functions.key(t, stage.keys) : points.low[k];
      ASSERT_LE(points.low[k], key);
      ASSERT_GE(points.high[k], key);
      ++tally.points;
      tally.undecided += !surely;
    }
  }
}

/// In every second group small triangles become slots, too.
void compareGroups(const Stage& stage, int groups, unsigned seed, bool bounds, Tally& tally)
{
  if (stage.local.rect.empty() || stage.local.stretched)
  {
    return;
  }
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> groupX(
    stage.local.rect.x0 / 32, (stage.local.rect.x1 - 1) / 32);
  std::uniform_int_distribution<int> groupY(
    stage.local.rect.y0 / 32, (stage.local.rect.y1 - 1) / 32);
  TriangleGroup group;
  for (int g = 0; g < groups && !testing::Test::HasFailure(); ++g)
  {
    const int tileX = 4 * groupX(random), tileY = 4 * groupY(random);
    SCOPED_TRACE("group at tile " + std::to_string(tileX) + ", " + std::to_string(tileY));
    ++tally.groups;
    const auto small = g % 2 ? SmallTriangles::AsSlots : SmallTriangles::AsPoints;
    if (!stage.makeReady(tileX, tileY, small, group))
    {
      ++tally.refused;
      continue;
    }
    ASSERT_TRUE(small == SmallTriangles::AsPoints || group.small().empty());
    if (bounds)
    {
      checkBounds(stage, group, tileX, tileY, tally);
      checkPoints(stage, group, tileX, tileY, tally);
    }
    for (int tile = 0; tile < 16 && !testing::Test::HasFailure(); ++tile)
    {
      compareTile(stage, group, tileX, tileY, tile % 4, tile / 4, tally);
    }
  }
}

/// A projection whose axis does not pass through the middle of the image.
View lookAside(const glm::dvec3& eye, int width, int height)
{
  View view;
  makeView(glm::lookAt(eye, glm::dvec3(0.0), glm::dvec3(0, 0, 1)),
    glm::frustum(-0.09, 0.02, -0.01, 0.07, 0.1, 100.0), width, height, view);
  return view;
}

std::vector<View> views()
{
  return { svotest::lookAt({ 3.0, -2.0, 2.5 }, 256, 192),
    svotest::lookAt({ 0.4, 0.9, 1.3 }, 256, 192),
    // So wide that rays of a tile are longest along different axes.
    svotest::lookAt({ 1.0, 1.1, 0.9 }, 64, 64, 150.0),
    // From inside.
    svotest::lookAt({ 0.02, 0.03, 0.05 }, 96, 64, 120.0),
    // From so far that depths hardly differ.
    svotest::lookAt({ 60.0, 30.0, 40.0 }, 256, 192, 2.0),
    svotest::lookAtParallel({ 2.0, 1.0, 3.0 }, 200, 160, 1.2),
    // Along an axis: through vertices, along edges and faces.
    svotest::lookAtParallel({ 3.0, 0.0, 0.0 }, 128, 128, 1.0),
    lookAside({ 3.0, -2.0, 2.5 }, 256, 192) };
}

struct Case
{
  const char* name;
  svotest::Mesh mesh;
  int level;
};

/// Triangles up to a thousand times as long as wide.
svotest::Mesh slivers(int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  svotest::Mesh mesh;
  for (int i = 0; i < count; ++i)
  {
    const glm::dvec3 a(unit(random), unit(random), unit(random));
    const glm::dvec3 along(unit(random), unit(random), unit(random));
    const glm::dvec3 aside(unit(random), unit(random), unit(random));
    mesh.add(a, a + along, a + 0.5 * along + std::pow(10.0, -2.0 + unit(random)) * aside);
  }
  return mesh;
}

std::vector<Case> cases()
{
  return { { "square", svotest::square(1.0), 9 }, { "wide square", svotest::square(40.0), 9 },
    { "sphere", svotest::sphere(30, 40), 8 }, { "torus", svotest::torus(40, 30), 9 },
    { "one level", svotest::sphere(4, 6), 1 }, { "soup", svotest::soup(600, 0.3, 5), 7 },
    { "small soup", svotest::soup(1500, 0.05, 6), 9 }, { "slivers", slivers(200, 8), 7 } };
}

const glm::dmat4 Sheared(glm::dvec4(1.0, 0.3, 0.0, 0.0), glm::dvec4(0.0, -0.7, 0.2, 0.0),
  glm::dvec4(0.4, 0.0, 1.5, 0.0), glm::dvec4(0.2, 0.1, -0.3, 1.0));
}

TEST(TriangleGroup, DecidesAsTheFloatTestDoes)
{
  for (const Case& c : cases())
  {
    SCOPED_TRACE(c.name);
    const Octree octree = svotest::makeOctree(c.mesh, c.level);
    ASSERT_TRUE(octree);
    svotest::onEveryInstructionSet(
      [&]
      {
        Tally tally;
        unsigned seed = 0;
        for (const View& view : views())
        {
          for (const bool deep : { false, true })
          {
            for (const glm::dmat4& localToWorld : { glm::dmat4(1.0), Sheared })
            {
              ++seed;
              SCOPED_TRACE("view " + std::to_string(seed));
              compareGroups(Stage(octree, view, localToWorld, deep), 6, seed, false, tally);
              if (HasFailure()) // of one is enough
              {
                return;
              }
            }
          }
        }
        EXPECT_GT(tally.hits, 5000) << "too few to say anything";
        // Seen edge-on and behind the eye as well.
        EXPECT_LE(tally.refused, std::string(c.name) == "slivers" ? tally.groups / 4 : 0);
      });
  }
}

TEST(TriangleGroup, BoundsHoldAtEachPixel)
{
  for (const Case& c : cases())
  {
    SCOPED_TRACE(c.name);
    const Octree octree = svotest::makeOctree(c.mesh, c.level);
    Tally tally;
    unsigned seed = 100;
    for (const View& view : views())
    {
      ++seed;
      SCOPED_TRACE("view " + std::to_string(seed));
      compareGroups(Stage(octree, view, seed % 2 ? glm::dmat4(1.0) : Sheared, seed % 3 == 0), 3,
        seed, true, tally);
    }
    RecordProperty(std::string("worst_key_") + c.name, std::to_string(tally.worstKey));
    RecordProperty(std::string("worst_edge_") + c.name, std::to_string(tally.worstEdge));
    std::printf("%s: keys off by %.3f, edges by %.3f of what is allowed; %ld of %ld doubtful\n",
      c.name, tally.worstKey, tally.worstEdge, tally.doubtful, tally.rays);
  }
}

TEST(TriangleGroup, BoundsHoldWhereEdgesPassThroughPixelsCentres)
{
  // Vertices at the centres of pixels, or a little beside them; the ground is a little tilted.
  svotest::Mesh mesh;
  constexpr int Quads = 16;
  for (int i = 0; i <= Quads; ++i)
  {
    for (int j = 0; j <= Quads; ++j)
    {
      mesh.points.push_back({ 0.125 * i - 1.0, 0.125 * j - 1.0, 0.03 * ((i + j) % 3) });
    }
  }
  for (unsigned i = 0; i < Quads; ++i)
  {
    for (unsigned j = 0; j < Quads; ++j)
    {
      const unsigned a = i * (Quads + 1) + j, b = a + Quads + 1;
      mesh.triangles.push_back({ a, b, b + 1 });
      mesh.triangles.push_back({ a, b + 1, a + 1 });
    }
  }
  const Octree octree = svotest::makeOctree(mesh, 7);
  Tally tally;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 120 && !HasFailure(); ++k)
  {
    // 32 pixels are as long as the mesh's unit, at the depth of the eye's focus.
    const double beside = k % 3 == 0 ? 0.0 : std::pow(10.0, -5.0 - k % 4) * unit(random) / 32.0;
    const double pixel = 0.5 / 32.0 + beside;
    View view;
    const glm::dmat4 down =
      glm::lookAt(glm::dvec3(pixel, pixel, 4.0), glm::dvec3(pixel, pixel, 0.0), { 0, 1, 0 });
    makeView(down,
      k % 2 ? glm::frustum(-0.05, 0.05, -0.05, 0.05, 0.1, 100.0)
            : glm::ortho(-2.0, 2.0, -2.0, 2.0, 0.1, 100.0),
      128, 128, view);
    SCOPED_TRACE("view " + std::to_string(k));
    compareGroups(Stage(octree, view, glm::dmat4(1.0), false), 2, k, true, tally);
  }
  EXPECT_GT(tally.doubtful, 1000);
  EXPECT_GT(tally.worstEdge, 1e-4); // the test does hang on what is allowed
  std::printf("edges off by %.4f, keys by %.3f of what is allowed; %ld of %ld doubtful\n",
    tally.worstEdge, tally.worstKey, tally.doubtful, tally.rays);
}

TEST(TriangleGroup, TrianglesOfAPixelHideWhatLiesBehind)
{
  const Octree octree = svotest::makeOctree(svotest::sphere(60, 80), 9);
  Tally tally;
  unsigned seed = 0;
  for (const View& view : { svotest::lookAt({ 3.0, -2.0, 2.5 }, 96, 72),
         svotest::lookAtParallel({ 2.0, 1.0, 3.0 }, 96, 72, 1.5) })
  {
    for (const bool deep : { false, true })
    {
      compareGroups(Stage(octree, view, glm::dmat4(1.0), deep), 6, ++seed, true, tally);
    }
  }
  EXPECT_GT(tally.small, 1000);
  EXPECT_GT(tally.hidden, 1000);
  EXPECT_LT(tally.undecided, tally.points / 4);
}

TEST(TriangleGroup, WhatLiesBehindHidesNothing)
{
  // The nearer of two comes later: none of its nodes may be left out.
  const Octree octree = svotest::makeOctree(svotest::sphere(60, 80), 9);
  const glm::dvec3 eye(3.0, -2.0, 2.5);
  const View view = svotest::lookAt(eye, 96, 72);
  Stage far(octree, view, glm::dmat4(1.0), false);
  Stage near(octree, view, glm::translate(glm::dmat4(1.0), 0.05 * glm::normalize(eye)), false);
  near.keys = far.keys;
  long decided = 0;
  for (int g = 0; g < 9; ++g)
  {
    const int tileX = 4 * (g % 3), tileY = 4 * (g / 3);
    TriangleGroup group;
    for (const Stage* stage : { &far, &near })
    {
      std::vector<GroupNode> nodes;
      ASSERT_TRUE(findGroupNodes(octree, makePyramid(stage->projection, view, tileX, tileY, 4),
        0.0f, stage->local.tMax, 1 << 20, nodes));
      ASSERT_TRUE(group.add(octree, nodes,
        makeGroupView(stage->local, stage->functions, stage->keys, HitLimits(), tileX, tileY),
        SmallTriangles::AsPoints, stage == &near));
    }
    for (int tile = 0; tile < 16; ++tile)
    {
      NearestTriangles found;
      std::uint32_t triangles[64], owners[64];
      if (!group.nearest(tile % 4, tile / 4, found, triangles, owners))
      {
        continue;
      }
      for (int i = 0; i < 64; ++i)
      {
        if ((found.doubtful >> i & 1) || found.slot[i] == NearestTriangles::None)
        {
          continue;
        }
        const double x = 8 * (tileX + tile % 4) + i % 8 + 0.5;
        const double y = 8 * (tileY + tile / 4) + i / 8 + 0.5;
        bool nearMet = false;
        for (std::uint32_t t = 0; t < octree.surface()->triangles.size() && !nearMet; ++t)
        {
          float at;
          nearMet = near.meets(x, y, t, at);
        }
        // Both are convex, and so far apart.
        ASSERT_EQ(owners[i], nearMet ? 1u : 0u) << x << ", " << y;
        ++decided;
      }
    }
  }
  EXPECT_GT(decided, 500);
}

TEST(TriangleGroup, LeavesFewRaysInDoubt)
{
  const Octree octree = svotest::makeOctree(svotest::torus(80, 60), 9);
  for (const View& view : { svotest::lookAt({ 3.0, -2.0, 2.5 }, 640, 480),
         svotest::lookAtParallel({ 2.0, 1.0, 3.0 }, 640, 480, 1.5) })
  {
    Tally tally;
    compareGroups(Stage(octree, view, glm::dmat4(1.0), false), 60, 1, false, tally);
    EXPECT_GT(tally.hits, 10000);
    EXPECT_LT(tally.doubtful, tally.hits / 50) << tally.hits;
  }
}
