#include "svoLayerCache.h"

#include <gtest/gtest.h>

namespace
{
const svo::PixelRect Rect{ 0, 0, 32, 16 };
const std::size_t Bytes = svo::DepthLayer(Rect).bytes();

svo::LayerKey keyOf(std::uint64_t octree)
{
  svo::LayerKey key;
  key.octree = octree;
  return key;
}

/// One frame of two instances.
struct Frame
{
  svo::DepthLayer* first;
  svo::DepthLayer* second;
};
Frame draw(svo::LayerCache& cache, svo::LayerBudget& budget, const svo::LayerKey& first,
  const svo::LayerKey& second, bool moved = false, bool keep = true)
{
  cache.beginFrame(keep, moved, budget);
  Frame frame{};
  frame.first = cache.layerOf(1, first, Rect, budget);
  frame.second = cache.layerOf(2, second, Rect, budget);
  cache.endFrame(budget);
  EXPECT_EQ(budget.used, cache.memory());
  return frame;
}
}

TEST(LayerCache, WhatStandsStillKeepsItsLayer)
{
  svo::LayerCache cache;
  svo::LayerBudget budget{ 10 * Bytes, 0 };
  const Frame one = draw(cache, budget, keyOf(1), keyOf(2));
  ASSERT_TRUE(one.first && one.second);
  EXPECT_NE(one.first, one.second);
  one.first->traced[0] = svo::DepthLayer::Traced;
  const Frame two = draw(cache, budget, keyOf(1), keyOf(2));
  EXPECT_EQ(two.first, one.first);
  EXPECT_EQ(two.first->traced[0], svo::DepthLayer::Traced);
  EXPECT_EQ(budget.used, 2 * Bytes);
}

// An identity may be used again by another actor at the same address: the key decides.
TEST(LayerCache, AnotherKeyHasNoLayerUntilItStandsStill)
{
  svo::LayerCache cache;
  svo::LayerBudget budget{ 10 * Bytes, 0 };
  draw(cache, budget, keyOf(1), keyOf(2)).first->traced[0] = svo::DepthLayer::Traced;
  const Frame changed = draw(cache, budget, keyOf(3), keyOf(2));
  EXPECT_EQ(changed.first, nullptr);
  EXPECT_NE(changed.second, nullptr);
  const Frame still = draw(cache, budget, keyOf(3), keyOf(2));
  ASSERT_NE(still.first, nullptr);
  EXPECT_EQ(still.first->traced[0], svo::DepthLayer::Unknown) << "the old layer came back";
}

TEST(LayerCache, TwoInstancesOfOneIdentityDoNotShareALayer)
{
  svo::LayerCache cache;
  svo::LayerBudget budget{ 10 * Bytes, 0 };
  cache.beginFrame(true, false, budget);
  EXPECT_NE(cache.layerOf(1, keyOf(1), Rect, budget), nullptr);
  EXPECT_EQ(cache.layerOf(1, keyOf(1), Rect, budget), nullptr);
  cache.endFrame(budget);
}

TEST(LayerCache, AViewThatMovesHasNoLayers)
{
  svo::LayerCache cache;
  svo::LayerBudget budget{ 10 * Bytes, 0 };
  draw(cache, budget, keyOf(1), keyOf(2)).first->traced[0] = svo::DepthLayer::Traced;
  const Frame moved = draw(cache, budget, keyOf(1), keyOf(2), true);
  EXPECT_FALSE(moved.first || moved.second);
  EXPECT_EQ(budget.used, 0u);
  const Frame still = draw(cache, budget, keyOf(1), keyOf(2));
  ASSERT_NE(still.first, nullptr);
  EXPECT_EQ(still.first->traced[0], svo::DepthLayer::Unknown);
}

TEST(LayerCache, NothingIsKeptWhereThatIsSwitchedOff)
{
  svo::LayerCache cache;
  svo::LayerBudget budget{ 10 * Bytes, 0 };
  draw(cache, budget, keyOf(1), keyOf(2));
  const Frame off = draw(cache, budget, keyOf(1), keyOf(2), false, false);
  EXPECT_FALSE(off.first || off.second);
  EXPECT_EQ(budget.used, 0u);
}

TEST(LayerCache, TheBudgetIsOfAllCaches)
{
  svo::LayerCache cache;
  svo::LayerBudget budget{ 2 * Bytes, Bytes }; // others have one layer already
  cache.beginFrame(true, false, budget);
  EXPECT_NE(cache.layerOf(1, keyOf(1), Rect, budget), nullptr);
  EXPECT_EQ(cache.layerOf(2, keyOf(2), Rect, budget), nullptr);
  cache.endFrame(budget);
  EXPECT_EQ(budget.used, 2 * Bytes);
  budget.limit = Bytes; // lowered: those that are there go
  cache.beginFrame(true, false, budget);
  EXPECT_EQ(budget.used, Bytes);
  EXPECT_EQ(cache.layerOf(1, keyOf(1), Rect, budget), nullptr);
  cache.endFrame(budget);
}

TEST(LayerCache, InstancesThatAreGoneAreForgotten)
{
  svo::LayerCache cache;
  svo::LayerBudget budget{ 10 * Bytes, 0 };
  draw(cache, budget, keyOf(1), keyOf(2));
  cache.beginFrame(true, false, budget);
  cache.layerOf(2, keyOf(2), Rect, budget);
  cache.endFrame(budget);
  EXPECT_EQ(cache.memory(), Bytes);
  EXPECT_EQ(budget.used, Bytes);
}
