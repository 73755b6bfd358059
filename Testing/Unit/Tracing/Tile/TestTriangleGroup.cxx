// Groups of triangles of all kinds, seen from all sides, against the oracle; and what hides what.
#include "svoInstructionSets.h"
#include "svoTestScenes.h"
#include "svoTracerScenes.h"
#include "svoTriangleGroupOracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace
{
using namespace svo;
using svotest::compareGroups;
using svotest::Stage;
using svotest::Tally;

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
