#include "svoCrowdFixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

using namespace svotest;

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// Everything that a tree keeps lies in the loose cubes of its node and of all above it, and nodes
/// know how many they are.
void expectEnclosed(const svo::LooseOctree& tree, const Crowd& crowd)
{
  std::vector<svo::LooseNode> path;
  const Crowd balls = keptBalls(tree);
  std::size_t objects = 0, nodes = 0;
  tree.visit(
    svo::VisitOrder{ { 1, 2, 3 } },
    [&](const svo::LooseNode& node, std::uint8_t&)
    {
      path.resize(node.depth);
      path.push_back(node);
      objects += node.depth == 0 ? node.objects : 0;
      ++nodes;
      return true;
    },
    [&](std::uint32_t object)
    {
      const svo::Ball &given = crowd.at(object), kept = balls.at(object);
      EXPECT_LE(glm::distance(kept.centre, given.centre) + given.radius, kept.radius);
      if (path.empty())
      {
        EXPECT_EQ(kept.radius, Infinity);
        return;
      }
      EXPECT_LE(
        kept.radius, given.radius + std::ldexp(16.0, -15 - path.back().depth) + 16.0 * 0x1p-31);
      for (const svo::LooseNode& node : path)
      {
        const glm::dvec3 reach = glm::abs(given.centre - node.centre) + given.radius;
        EXPECT_LE(std::max({ reach.x, reach.y, reach.z }), node.half);
      }
    });
  EXPECT_EQ(objects + tree.outsiders().size(), crowd.size());
  EXPECT_EQ(tree.size(), crowd.size());
  EXPECT_LE(nodes, tree.nodes());
}
}

TEST(LooseOctree, WhereAnObjectIsKeptFollowsFromRadiusCentreAndTheCrowd)
{
  RandomBalls random(1);
  const PlainTree plain = plainly();
  Crowd crowd;
  for (std::uint32_t i = 0; i < 9000; ++i)
  {
    crowd[i] = random.ball();
  }
  const svo::LooseOctree tree = treeOf(plain, crowd);
  const std::vector<TreeNode> expected = plain.written(crowd), found = written(tree);
  EXPECT_TRUE(expected == found);
  EXPECT_GT(found.size(), 200u);
  expectEnclosed(tree, crowd);
}

TEST(LooseOctree, CrowdsOfAllSizesPileUpWhereNodesAreSmallest)
{
  const PlainTree plain = plainly();
  RandomBalls random(3);
  const glm::dvec3 middle = random.ball().centre;
  Crowd crowd;
  for (std::uint32_t i = 0; i < 600; ++i)
  {
    const glm::dvec3 beside(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    crowd[i] = { middle + 1e-6 * beside,
      i % 8 == 0 ? 0.0 : std::pow(10.0, random.between(-9, -4)) };
  }
  const svo::LooseOctree tree = treeOf(plain, crowd);
  const std::vector<TreeNode> found = written(tree);
  EXPECT_TRUE(plain.written(crowd) == found);
  EXPECT_TRUE(std::any_of(found.begin(), found.end(),
    [](const TreeNode& node) { return node.depth == 20 && node.objects.size() > 15; }));
  expectEnclosed(tree, crowd);
}

TEST(LooseOctree, AfterAnySequenceOfChangesItEqualsOneBuiltAfresh)
{
  const PlainTree plain = plainly();
  RandomBalls random(2);
  svo::LooseOctree tree = treeLike(plain);
  Crowd crowd;
  for (int step = 1; step <= 80000; ++step)
  {
    // Crowds grow and shrink again.
    const std::uint32_t name = random.below(step % 40000 < 20000 ? 6000 : 600);
    const std::uint32_t kind = random.below(8);
    const bool there = crowd.count(name) > 0;
    ASSERT_EQ(tree.contains(name), there);
    svo::Ball ball = random.ball();
    if (kind == 0 || (kind < 4 && step % 40000 > 20000))
    {
      const std::uint32_t gone = random.below(6000);
      ASSERT_EQ(tree.remove(gone), crowd.erase(gone) > 0);
      continue;
    }
    if (there && kind < 6)
    {
      // A little, or another size at the same place.
      ball.centre = crowd[name].centre +
        glm::dvec3(random.between(-0.1, 0.1), random.between(-1e-4, 1e-4), 0.0);
      ball.radius = kind == 5 ? ball.radius : crowd[name].radius;
    }
    if (kind == 7)
    {
      tree.insert(name, ball.centre, ball.radius);
      crowd[name] = ball;
    }
    else
    {
      ASSERT_EQ(tree.move(name, ball.centre, ball.radius), there);
      if (there)
      {
        crowd[name] = ball;
      }
    }
    if (step % 10000 == 5000)
    {
      const std::vector<TreeNode> before = written(tree);
      tree.arrange();
      ASSERT_TRUE(written(tree) == before);
    }
    if (step % 4000 == 0)
    {
      const svo::LooseOctree fresh = treeOf(plain, crowd);
      ASSERT_TRUE(written(tree) == written(fresh)) << "step " << step;
      ASSERT_TRUE(written(tree) == plain.written(crowd)) << "step " << step;
      ASSERT_EQ(tree.nodes(), fresh.nodes());
      expectEnclosed(tree, crowd);
    }
  }
  EXPECT_GT(tree.outsiders().size(), 0u);
  while (!crowd.empty())
  {
    ASSERT_TRUE(tree.remove(crowd.begin()->first));
    crowd.erase(crowd.begin());
  }
  EXPECT_EQ(tree.size(), 0u);
  EXPECT_EQ(tree.nodes(), 1u) << "empty nodes are reclaimed";
  EXPECT_EQ(written(tree).size(), 1u);
}

TEST(LooseOctree, MemoryStaysBoundedWhileObjectsMove)
{
  constexpr std::uint32_t Count = 20000;
  RandomBalls random(3);
  svo::LooseOctree tree(glm::dvec3(0.0), 16.0);
  const auto moveAll = [&](int times)
  {
    for (std::uint32_t i = 0; i < Count * times; ++i)
    {
      const svo::Ball ball = random.ball();
      tree.insert(i % Count, ball.centre, ball.radius);
    }
  };
  moveAll(10);
  const std::size_t before = tree.memory();
  moveAll(90);
  EXPECT_LE(tree.memory(), 2 * before); // vectors double
  EXPECT_LT(tree.memory(), Count * 200);
  for (std::uint32_t i = 0; i < Count; ++i)
  {
    tree.remove(i);
  }
  EXPECT_EQ(tree.nodes(), 1u);
  const std::size_t empty = tree.memory();
  moveAll(10);
  EXPECT_LE(tree.memory(), 2 * empty);
}

TEST(LooseOctree, WhatFitsNowhereIsHeldApartAndCanComeBack)
{
  svo::LooseOctree tree(glm::dvec3(1.0), 2.0);
  const std::vector<svo::Ball> outside = { { { NaN, 1, 1 }, 0.1 }, { { 1, Infinity, 1 }, 0.1 },
    { { 1, 1, -Infinity }, 0.1 }, { { 1, 1, 1 }, NaN }, { { 1, 1, 1 }, Infinity },
    { { 1, 1, 1 }, -1.0 }, { { -1e-9, 1, 1 }, 0.1 }, { { 1, 2.0 + 1e-9, 1 }, 0.1 },
    { { 1e300, 1, 1 }, 0.1 }, { { 1, 1, 1 }, 0.25 + 1e-7 }, { { 1, 1, 1 }, 1e300 } };
  const std::vector<svo::Ball> inside = { { { 0, 0, 0 }, 0.0 }, { { 2, 2, 2 }, 0.0 },
    { { 1, 1, 1 }, 0.25 }, { { 2, 0, 1 }, 5e-324 }, { { 0.3, 1.2, 1.9 }, 1e-300 } };
  for (int round = 0; round < 3; ++round)
  {
    for (std::uint32_t i = 0; i < 40; ++i)
    {
      const bool out = (i + round) % 2 == 0;
      const svo::Ball& ball =
        out ? outside[(i / 2) % outside.size()] : inside[(i / 2) % inside.size()];
      tree.insert(i, ball.centre, ball.radius);
      const std::vector<std::uint32_t>& held = tree.outsiders();
      EXPECT_EQ(std::count(held.begin(), held.end(), i), out ? 1 : 0) << i << ", round " << round;
      EXPECT_EQ(keptBalls(tree).at(i).radius == Infinity, out);
    }
    EXPECT_EQ(tree.size(), 40u);
    EXPECT_EQ(tree.outsiders().size(), 20u);
    std::size_t visited = 0;
    tree.visit(
      svo::VisitOrder{ { 0, 0, 0 } }, [](const svo::LooseNode&, std::uint8_t&) { return false; },
      [&](std::uint32_t) { ++visited; });
    EXPECT_EQ(visited, 20u) << "outsiders are visited whatever nodes are told";
  }
  for (std::uint32_t i = 0; i < 40; ++i)
  {
    EXPECT_TRUE(tree.remove(i));
    EXPECT_FALSE(tree.remove(i));
    EXPECT_FALSE(tree.move(i, glm::dvec3(1.0), 0.1));
  }
  EXPECT_EQ(tree.size(), 0u);
  EXPECT_FALSE(tree.contains(1000000));
  EXPECT_FALSE(tree.remove(1000000));
}

TEST(LooseOctree, ACubeThatIsNoneHoldsEverybodyApart)
{
  for (const double edge : { 0.0, -1.0, NaN, Infinity, 5e-324 })
  {
    svo::LooseOctree tree(glm::dvec3(0.0), edge);
    tree.insert(3, glm::dvec3(0.0), 0.0);
    EXPECT_EQ(tree.outsiders().size(), 1u) << edge;
    EXPECT_TRUE(tree.remove(3));
  }
  svo::LooseOctree tree(glm::dvec3(0.0, NaN, 0.0), 1.0);
  tree.insert(0, glm::dvec3(0.0), 0.0);
  EXPECT_EQ(tree.outsiders().size(), 1u);
}

TEST(LooseOctree, CubesOfAnySizeAnywhere)
{
  for (const double edge : { 1e-6, 1e-3, 1.0, 1e6, 1e100, 1e-100 })
  {
    for (const double far : { 0.0, 1.0, 1e6 })
    {
      const glm::dvec3 middle = far * edge * glm::dvec3(1.0, -0.3, 0.7);
      svo::LooseOctree tree(middle, edge);
      Crowd crowd;
      RandomBalls random(6);
      for (std::uint32_t i = 0; i < 1000; ++i)
      {
        svo::Ball ball = random.ball();
        ball.centre = middle + edge / 16.0 * ball.centre;
        ball.radius *= edge / 16.0;
        if (i % 2 == 0)
        {
          // As large as its cell takes, about the cell's corner: it touches the loose cell.
          const double cell = std::ldexp(edge, -static_cast<int>(i % 16));
          ball.centre = middle - 0.5 * edge +
            cell * glm::dvec3(random.below(1u << i % 16), random.below(1u << i % 16), 0.0);
          ball.radius = 0.125 * cell;
        }
        crowd[i] = ball;
        tree.insert(i, ball.centre, ball.radius);
      }
      EXPECT_LT(tree.outsiders().size(), 300u);
      std::vector<svo::LooseNode> path;
      const Crowd balls = keptBalls(tree);
      tree.visit(
        svo::VisitOrder{ middle },
        [&](const svo::LooseNode& node, std::uint8_t&)
        {
          path.resize(node.depth);
          path.push_back(node);
          return true;
        },
        [&](std::uint32_t object)
        {
          const svo::Ball& ball = crowd[object];
          const svo::Ball& kept = balls.at(object);
          EXPECT_LE(
            glm::length((kept.centre - ball.centre) / edge) * edge + ball.radius, kept.radius);
          for (const svo::LooseNode& node : path)
          {
            const glm::dvec3 reach = glm::abs(ball.centre - node.centre) + ball.radius;
            EXPECT_LE(std::max({ reach.x, reach.y, reach.z }), node.half);
          }
        });
    }
  }
}

TEST(LooseOctree, ManyObjectsAtOnePlaceComeAndGo)
{
  constexpr std::uint32_t Count = 100000;
  svo::LooseOctree tree(glm::dvec3(0.0), 16.0);
  // In one of the smallest cells, which is 1.5e-5 wide.
  RandomBalls random(9);
  Crowd crowd;
  for (std::uint32_t i = 0; i < Count; ++i)
  {
    const glm::dvec3 beside(random.between(0.0, 1e-7), random.between(0.0, 1e-8), 0.0);
    crowd[i] = { glm::dvec3(1.0, 2.0, 3.0) + beside, i % 2 ? 0.0 : 1e-9 };
    tree.insert(i, crowd[i].centre, crowd[i].radius);
  }
  EXPECT_EQ(written(tree).back().depth, 20);
  EXPECT_EQ(written(tree).back().objects.size(), Count);
  expectEnclosed(tree, crowd);
  // From the front, the back and the middle.
  std::vector<std::uint32_t> names(Count);
  std::iota(names.begin(), names.end(), 0u);
  std::shuffle(names.begin(), names.end(), std::mt19937(7));
  for (std::uint32_t i = 0; i + 50 < Count; ++i)
  {
    ASSERT_TRUE(tree.remove(names[i]));
  }
  std::vector<std::uint32_t> left(names.end() - 50, names.end());
  std::sort(left.begin(), left.end());
  ASSERT_EQ(written(tree).size(), 2u);
  EXPECT_EQ(written(tree).back().depth, 0) << "they need no node but the root";
  EXPECT_TRUE(written(tree).back().objects == left);
}

TEST(LooseOctree, ChildrenAreReclaimedWhereAllThatIsLeftIsLarge)
{
  svo::LooseOctree tree(glm::dvec3(0.0), 16.0);
  for (std::uint32_t i = 1; i <= 200; ++i)
  {
    tree.insert(i, glm::dvec3(1.0), 1.9);
  }
  EXPECT_EQ(tree.nodes(), 1u);
  tree.insert(0, glm::dvec3(1.0), 0.1);
  EXPECT_EQ(tree.nodes(), 9u);
  tree.move(0, glm::dvec3(-1.0), 0.1);
  EXPECT_EQ(tree.nodes(), 9u);
  EXPECT_EQ(written(tree).size(), 3u);
  tree.move(0, glm::dvec3(1.0), 1.9);
  EXPECT_EQ(tree.nodes(), 1u);
}
