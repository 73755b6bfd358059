// The nearest triangles of a group's tiles against the float test of every ray: whatever is decided
// without it has to agree, and the bounds have to hold for each triangle at each pixel.
#ifndef svoTriangleGroupOracle_h
#define svoTriangleGroupOracle_h

#include "svoIntersectTile.h"
#include "svoPixelFunctions.h"
#include "svoProjection.h"
#include "svoReadyRay.h"
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

namespace svotest
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
  ReadyRay ray(double x, double y) const
  {
    return { glm::vec3(local.originAt(x, y)), glm::vec3(local.directionAt(x, y)) };
  }
  bool meets(const ReadyRay& ray, std::uint32_t triangle, float& t) const
  {
    return ray.meets(*octree.surface(), triangle, t) && t >= 0.0f && t <= local.tMax;
  }
  bool meets(double x, double y, std::uint32_t triangle, float& t) const
  {
    return meets(ray(x, y), triangle, t);
  }
  /// Those of a group's pixels, row by row.
  std::vector<ReadyRay> groupRays(int tileX, int tileY) const
  {
    std::vector<ReadyRay> rays;
    for (int pixel = 0; pixel < GroupPixels::Count; ++pixel)
    {
      rays.push_back(ray(
        8 * tileX + pixel % GroupView::Pixels + 0.5, 8 * tileY + pixel / GroupView::Pixels + 0.5));
    }
    return rays;
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

inline void compareTile(const Stage& stage, const TriangleGroup& group, int tileX, int tileY,
  int column, int row, Tally& tally)
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
inline void checkBounds(
  const Stage& stage, const TriangleGroup& group, const std::vector<ReadyRay>& rays, Tally& tally)
{
  const TriangleGroup::Slots& s = group.slots();
  for (std::size_t k = 0; k < s.count; ++k)
  {
    for (int row = 0; row < GroupView::Pixels; ++row)
    {
      for (int column = 0; column < GroupView::Pixels; ++column)
      {
        float t;
        const bool hit = stage.meets(rays[GroupView::Pixels * row + column], s.id[k], t);
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
inline void checkPoints(
  const Stage& stage, const TriangleGroup& group, const std::vector<ReadyRay>& rays, Tally& tally)
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
    const auto known = seen.find(triangle);
    for (int pixel = 0; pixel < GroupPixels::Count; ++pixel)
    {
      float t = 0.0f;
      const bool hit = stage.meets(rays[pixel], triangle, t);
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
inline void compareGroups(const Stage& stage, int groups, unsigned seed, bool bounds, Tally& tally)
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
      const std::vector<ReadyRay> rays = stage.groupRays(tileX, tileY);
      checkBounds(stage, group, rays, tally);
      checkPoints(stage, group, rays, tally);
    }
    for (int tile = 0; tile < 16 && !testing::Test::HasFailure(); ++tile)
    {
      compareTile(stage, group, tileX, tileY, tile % 4, tile / 4, tally);
    }
  }
}
}

#endif
