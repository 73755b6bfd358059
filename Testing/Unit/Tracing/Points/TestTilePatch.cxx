// Points as ways from their patch's origin, against points in double.
#include "svoInstructionSets.h"
#include "svoTilePatch.h"
#include "svoTracerScenes.h"
#include "svoWorldSize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

using namespace svo;

namespace
{
/// Views from anywhere in the world, near and far, wide and narrow, skewed and parallel.
std::vector<View> manyViews(std::mt19937& random)
{
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<View> views;
  for (int i = 0; i < 40; ++i)
  {
    const double far = std::pow(10.0, 6.0 * unit(random)),
                 away = std::pow(10.0, 2.0 * unit(random));
    const glm::dvec3 at = far * glm::dvec3(unit(random), unit(random), unit(random));
    const glm::dvec3 from = at + away * glm::dvec3(1.0, unit(random), unit(random));
    const double half = i % 3 == 0 ? 1e-3 : 0.7; // a telescope, or not
    const glm::dmat4 clip = i % 4 == 1
      ? glm::ortho(-away * half, away * half, -away * half, away * half, 0.1 * away, 9.0 * away)
      : i % 4 == 2
      ? glm::frustum(-0.1 * half, 0.02 * half, -0.03 * half, 0.05 * half, 0.1, 9.0) // off-axis
      : glm::perspective(half, 1.5, 0.1 * away, 9.0 * away);
    views.emplace_back();
    EXPECT_TRUE(makeView(glm::lookAt(from, at, glm::dvec3(0, 0, 1)), clip, 203, 101, views.back()));
  }
  return views;
}
}

TEST(TilePatch, WaysAreWithinTheirBound)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const std::vector<View> views = manyViews(random);
  svotest::onEveryInstructionSet(
    [&]
    {
      double worst = 0.0;
      std::size_t all = 0;
      for (const View& view : views)
      {
        TileHitList list;
        list.start(8 * 11, 8 * 5);
        const double near = view.tNear + unit(random) * (view.tFar - view.tNear);
        const double width = worldPixel(view, near);
        for (int i = 0; i < TileHits::Most; ++i)
        {
          list.put(i, list.hits.x0 + 8.0 * unit(random), list.hits.y0 + 8.0 * unit(random),
            static_cast<float>((i % 5 == 0 ? 900.0 : 30.0) * unit(random) * width), 7, 1);
        }
        std::size_t patches = 0;
        TilePatch patch;
        eachPatch(
          view, list.hits, [](std::uint32_t) { return true; }, [&](std::uint32_t) { return near; },
          patch,
          [&](const TilePatch&)
          {
            ++patches;
            eachBit(patch.mask,
              [&](int i)
              {
                const glm::dvec3 way = patch.position(i) - patch.origin.position;
                const double noise = 1e-15 * glm::length(patch.origin.position);
                for (int k = 0; k < 3; ++k)
                {
                  const double off = std::abs(way[k] - patch.way(i)[k]);
                  const double allowed = WayError * static_cast<double>(patch.extent[k]);
                  ASSERT_LE(off, allowed + noise);
                  ASSERT_LE(std::abs(patch.way(i)[k]), patch.extent[k]);
                  worst = std::max(worst, (off - noise) / allowed);
                }
              });
          });
        all += patches;
        EXPECT_LT(patches, 8u);
      }
      EXPECT_GT(all, views.size());
      EXPECT_GT(worst, 0.05); // the bound says something
    });
}

TEST(TilePatch, InstancesAndNodesAreToldApart)
{
  std::mt19937 random(6);
  const View view = svotest::lookAt({ 3, 2, 1 }, 64, 64);
  svotest::onEveryInstructionSet(
    [&]
    {
      TileHitList list;
      list.start(8, 16);
      std::uint64_t nodes = 0, ofOne = 0;
      for (int i = 0; i < TileHits::Most; ++i)
      {
        if (random() % 4 == 0)
        {
          continue; // no hit
        }
        const bool node = random() % 2 == 0, one = random() % 2 == 0;
        nodes |= std::uint64_t(node) << i;
        ofOne |= std::uint64_t(one) << i;
        list.put(i, 8.0 + i % 8, 16.0 + i / 8, 0.0f, one ? 1 : 4, node ? NodePrimitive | 3u : 3u);
      }
      std::uint64_t seen = 0;
      TilePatch patch;
      eachPatch(
        view, list.hits, [](std::uint32_t i) { return i == 1; }, [](std::uint32_t) { return 2.0; },
        patch,
        [&](const TilePatch&)
        {
          EXPECT_EQ(patch.mask, ofOne);
          EXPECT_EQ(patch.nodes, ofOne & nodes);
          seen |= patch.mask;
        });
      EXPECT_EQ(seen, ofOne);
    });
}
