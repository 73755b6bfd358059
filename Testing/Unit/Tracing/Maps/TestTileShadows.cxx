// Patches against a shadow map in single precision: every answer that is given is that of the same
// test in double, and few are not given.
#include "svoInstructionSets.h"
#include "svoShadowTest.h"
#include "svoTexelPlace.h"
#include "svoTileShadows.h"
#include "svoTracerScenes.h"
#include "svoWorldSize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <random>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

using namespace svo;

namespace
{
struct Case
{
  View eye;
  MapGeometry light;
};

/// The same rays, but for rounding, as the crop of an image with `times` as many pixels.
View asCrop(const View& view, int times, int x, int y)
{
  glm::dmat4 toClip = view.viewToClip;
  const auto shrink = [&](int row, int from, int size)
  {
    const double middle = (2.0 * from + size) / (static_cast<double>(times) * size) - 1.0;
    for (int column = 0; column < 4; ++column)
    {
      toClip[column][row] = toClip[column][row] / times + middle * toClip[column][3];
    }
  };
  shrink(0, x, view.width);
  shrink(1, y, view.height);
  View crop;
  EXPECT_TRUE(makeView(view.worldToView, toClip, times * view.width, times * view.height, crop));
  crop.crop = { x, y, x + view.width, y + view.height };
  return crop;
}

/// The eye and a light look at the same things, which may be far from the world's origin. Some
/// lights are turned away from them, as most of a cube's six maps are.
std::vector<Case> manyCases(std::mt19937& random)
{
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Case> cases;
  for (int i = 0; i < 60; ++i)
  {
    const glm::dvec3 at =
      std::pow(10.0, 2.0 + 2.0 * unit(random)) * glm::dvec3(unit(random), 0.3, unit(random));
    const glm::dvec3 lamp = at + glm::dvec3(2.0 * unit(random), 2.0 * unit(random), 4.0);
    Case c;
    EXPECT_TRUE(
      makeView(glm::lookAt(at + glm::dvec3(3.0, unit(random), 1.0), at, glm::dvec3(0, 0, 1)),
        glm::perspective(i % 3 == 0 ? 0.05 : 0.7, 1.5, 0.1, 90.0), 192, 128, c.eye));
    const double half = i % 5 == 0 ? 0.05 : 1.5; // some points are beyond
    const glm::dvec3 towards = i % 6 == 1 ? 2.0 * lamp - at : at;
    View light;
    EXPECT_TRUE(makeView(glm::lookAt(lamp, towards, glm::dvec3(0, 1, 0)),
      i % 2 == 0 ? glm::ortho(-half, half, -0.7 * half, 0.7 * half, 0.5, 9.0)
                 : glm::perspective(half, 1.3, 0.5, 9.0),
      1024, 1024, light));
    const int times = 1 << i % 17;
    // Of some the last column or row of the image, of others nothing of its border.
    const int last = 1024 * (times - 1);
    c.light =
      MapGeometry(i % 4 < 2 || times == 1 ? light
                                          : asCrop(light, times, i % 3 == 0 ? last : 8 * (i % 60),
                                              i % 5 == 0 ? last : last / 16 * 8));
    cases.push_back(c);
  }
  return cases;
}

/// Hits on a bumpy ground.
void fill(const View& eye, std::mt19937& random, TileHitList& list)
{
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const int tileX = static_cast<int>(24 * unit(random)),
            tileY = static_cast<int>(16 * unit(random));
  list.start(8 * tileX, 8 * tileY);
  const double t = 2.0 + 2.0 * unit(random), bumps = 20.0 * unit(random) * worldPixel(eye, t);
  for (int i = 0; i < TileHits::Most; ++i)
  {
    list.put(i, list.hits.x0 + i % 8 + 0.5, list.hits.y0 + i / 8 + 0.5,
      static_cast<float>(t - 1.0 + bumps * unit(random)), 0, 1);
  }
}

/// Calls f(case, patch) for many patches.
template <class F>
void eachCase(int patches, F&& f)
{
  std::mt19937 random(9);
  const std::vector<Case> cases = manyCases(random);
  TileHitList list;
  TilePatch patch;
  for (const Case& c : cases)
  {
    for (int i = 0; i < patches; ++i)
    {
      fill(c.eye, random, list);
      takePatch(c.eye, list.hits, list.hits.mask, 1.0, patch);
      f(c, random, patch);
    }
  }
}
}

TEST(TileShadows, PlacesAreWithinTheirBound)
{
  svotest::onEveryInstructionSet(
    [&]
    {
      double worst = 0.0;
      int points = 0, sure = 0, outside = 0;
      eachCase(30,
        [&](const Case& c, std::mt19937&, TilePatch& patch)
        {
          MapPlaces places;
          placeInMap(c.light, patch, patch.mask, places);
          ASSERT_EQ((places.inside | places.outside) & ~patch.mask, 0u);
          ASSERT_EQ(places.inside & places.outside, 0u);
          ASSERT_EQ(places.sure & ~places.inside, 0u);
          eachBit(patch.mask,
            [&](int i)
            {
              const TexelPlace expected = texelPlace(c.light, patch.position(i));
              ++points;
              outside += places.outside >> i & 1;
              ASSERT_FALSE((places.outside >> i & 1) && expected.inside > 0.0);
              if (places.inside >> i & 1)
              {
                ASSERT_GT(expected.inside, 0.0);
                const double off = std::max(std::abs(places.x0 + double(places.x[i]) - expected.x),
                  std::abs(places.y0 + double(places.y[i]) - expected.y));
                ASSERT_LE(off, places.error);
                worst = std::max(worst, off / places.error);
                ASSERT_NEAR(places.t0 + double(places.t[i]), expected.t, 1e-5);
              }
              if (places.sure >> i & 1)
              {
                ++sure;
                ASSERT_EQ(places.column(i), static_cast<int>(expected.x));
                ASSERT_EQ(places.row(i), static_cast<int>(expected.y));
              }
            });
        });
      EXPECT_GT(worst, 0.01); // the bound says something
      EXPECT_GT(outside, points / 20);
      EXPECT_GT(sure + outside, 0.98 * points);
    });
}

TEST(TileShadows, TilesAroundPointsAreThoseOfTheirTexels)
{
  svotest::onEveryInstructionSet(
    [&]
    {
      int several = 0;
      eachCase(30,
        [&](const Case& c, std::mt19937&, TilePatch& patch)
        {
          MapPlaces places;
          placeInMap(c.light, patch, patch.mask, places);
          if (places.inside == 0)
          {
            return;
          }
          const PixelRect& crop = c.light.view.crop;
          const MapTiles box = tilesOf(places, c.light.view, 0.5f);
          const bool few = box.atMost(8);
          const std::uint64_t found = few ? tilesAround(places, c.light.view, 0.5f, box) : 0;
          several += few && !box.atMost(2);
          std::uint64_t least = 0;
          eachBit(places.inside,
            [&](int i)
            {
              const TexelPlace at = texelPlace(c.light, patch.position(i));
              for (int corner = 0; corner < 4; ++corner)
              {
                const double x = at.x + (corner & 1 ? 0.5 : -0.5);
                const double y = at.y + (corner & 2 ? 0.5 : -0.5);
                const int column =
                  static_cast<int>(std::clamp<double>(x, crop.x0, crop.x1 - 1)) >> 3;
                const int row = static_cast<int>(std::clamp<double>(y, crop.y0, crop.y1 - 1)) >> 3;
                ASSERT_TRUE(column >= box.x0 && column <= box.x1 && row >= box.y0 && row <= box.y1);
                least |= few ? std::uint64_t(1) << (8 * (row - box.y0) + column - box.x0) : 0;
              }
            });
          ASSERT_EQ(least & ~found, 0u);
          ASSERT_LE(std::bitset<64>(found).count(), std::bitset<64>(least).count() + 1);
        });
      EXPECT_GT(several, 30);
    });
}

/// Occluders are where the answer just changes, or a little before or beyond.
TEST(TileShadows, AnswersThatAreGivenAreThoseInDouble)
{
  svotest::onEveryInstructionSet(
    [&]
    {
      int given[3] = { 0, 0, 0 }, asked = 0, unsure = 0;
      eachCase(60,
        [&](const Case& c, std::mt19937& random, TilePatch& patch)
        {
          std::uniform_real_distribution<double> unit(-1.0, 1.0);
          const TexelEdge& edge = c.light.edge;
          MapPlaces places;
          placeInMap(c.light, patch, patch.mask, places);
          TexelTests tests;
          ShadowQuestion<double> questions[TilePatch::Most];
          eachBit(places.sure,
            [&](int i)
            {
              const auto direction = [&]
              {
                const glm::vec3 v(unit(random), unit(random), i % 4 == 0 ? 1e-3 : 1.0);
                return glm::normalize(v);
              };
              const glm::dvec3 position = patch.position(i);
              const double x = places.column(i) + 0.5, y = places.row(i) + 0.5;
              const glm::dvec3 ray = glm::normalize(c.light.view.rayDirection(x, y));
              const glm::dvec3 beside = glm::normalize(glm::cross(ray, glm::dvec3(direction())));
              const double sine = EdgeOnSine * (1.0 + 1e-4 * unit(random));
              patch.facet.set(i, direction());
              patch.normal.set(i, i % 6 == 5 ? glm::vec3(beside + sine * ray) : direction());
              const double t = texelPlace(c.light, position).t;
              ShadowQuestion<double>& q = questions[i];
              q = { glm::dvec3(patch.facet(i)), glm::dvec3(patch.normal(i)),
                position - c.light.view.rayOrigin(x, y), c.light.view.rayDirection(x, y), t,
                edge(t), edge.aspect, t - 0.01 - 0.1 * unit(random) * unit(random),
                1e-3 * std::abs(unit(random)), 1e-3 * std::abs(unit(random)) };
              const ShadowAnswer<double> before = shadowTest(q);
              const double step = i % 3 == 0 ? before.reached
                : i % 3 == 1                 ? before.behind
                                             : before.farBefore;
              if (std::abs(step) < 1.0)
              {
                q.occluder +=
                  step + std::pow(10.0, -2.0 + 2.5 * unit(random)) * unit(random) * edge(t);
              }
              tests.occluder[i] = static_cast<float>(q.occluder - places.t0);
              tests.bias[i] = static_cast<float>(q.bias);
              tests.error[i] = static_cast<float>(q.error);
            });
          if (places.sure == 0)
          {
            return;
          }
          testTexels(c.light, patch, places.sure, places, tests);
          ASSERT_EQ((tests.dark | tests.nearby | tests.unsure) & ~places.sure, 0u);
          eachBit(places.sure,
            [&](int i)
            {
              ++asked;
              if (tests.unsure >> i & 1)
              {
                ++unsure;
                return;
              }
              const int found = tests.dark >> i & 1 ? 2 : tests.nearby >> i & 1 ? 1 : 0;
              ++given[found];
              ASSERT_EQ(found, shadowTest(questions[i]).shadowed());
            });
        });
      EXPECT_GT(unsure, 100);
      EXPECT_LT(unsure, asked / 2);
      for (const int count : given)
      {
        EXPECT_GT(count, 1000);
      }
    });
}
