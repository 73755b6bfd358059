#include "svoCrowdFixtures.h"

#include <gtest/gtest.h>

#include <thread>

using namespace svotest;

namespace
{
/// Where a cell lies of a plane through the middle of a node, along an axis: -1, 1, or 0: across.
int sideOf(const TreeNode& cell, double edge, const std::array<double, 3>& middle, int axis)
{
  const double half = std::ldexp(edge, -cell.depth - 1);
  return cell.centre[axis] - half >= middle[axis] ? 1
    : cell.centre[axis] + half <= middle[axis]    ? -1
                                                  : 0;
}
}

TEST(LooseOctreeVisits, OfTwoCellsThatAPlaneOfANodeSeparatesTheNearerIsFirst)
{
  const PlainTree plain = plainly();
  RandomBalls random(4);
  Crowd crowd;
  for (std::uint32_t i = 0; i < 6000; ++i)
  {
    crowd[i] = random.ball();
  }
  const svo::LooseOctree tree = treeOf(plain, crowd);
  const std::vector<glm::dvec3> eyes = { { 20, 3, 1 }, { -0.7, 0.3, 5.2 }, { -9, -30, 14 },
    { 1.3, -2.7, 5.1 }, { 0, 0, 0 } };
  for (std::size_t e = 0; e < 2 * eyes.size(); ++e)
  {
    const bool parallel = e >= eyes.size();
    const glm::dvec3 eye = eyes[e % eyes.size()];
    std::vector<TreeNode> nodes;
    tree.visit(
      parallel ? svo::VisitOrder::along(-eye) : svo::VisitOrder{ eye },
      [&](const svo::LooseNode& node, std::uint8_t&)
      {
        nodes.push_back({ node.depth, { node.centre.x, node.centre.y, node.centre.z }, {} });
        return true;
      },
      [&](std::uint32_t) {});
    ASSERT_GT(nodes.size(), 100u);
    std::size_t pairs = 0;
    for (const TreeNode& node : nodes)
    {
      const double half = std::ldexp(plain.edge, -node.depth - 1);
      const auto inside = [&](const TreeNode& other)
      {
        bool is = other.depth > node.depth;
        for (int a = 0; a < 3; ++a)
        {
          is = is && std::abs(other.centre[a] - node.centre[a]) < half;
        }
        return is;
      };
      std::vector<const TreeNode*> below;
      for (const TreeNode& other : nodes)
      {
        if (inside(other))
        {
          below.push_back(&other);
        }
      }
      if (below.size() > 200) // the upper nodes: enough of all pairs
      {
        std::vector<const TreeNode*> some;
        for (std::size_t i = 0; i < below.size(); i += below.size() / 200 + 1)
        {
          some.push_back(below[i]);
        }
        below = some;
      }
      for (std::size_t i = 0; i < below.size(); ++i)
      {
        for (std::size_t j = i + 1; j < below.size(); ++j)
        {
          int differ = 0, nearerFirst = 0;
          for (int a = 0; a < 3; ++a)
          {
            const int first = sideOf(*below[i], plain.edge, node.centre, a);
            const int second = sideOf(*below[j], plain.edge, node.centre, a);
            if (first * second == -1)
            {
              ++differ;
              const double towards = parallel ? eye[a] : eye[a] - node.centre[a];
              nearerFirst += towards == 0.0 || (towards > 0.0) == (first > 0);
            }
          }
          ASSERT_TRUE(differ == 0 || nearerFirst > 0);
          pairs += differ == 1;
        }
      }
    }
    EXPECT_GT(pairs, 1000u);
  }
}

TEST(LooseOctreeVisits, NothingBelowANodeThatIsSkippedIsVisited)
{
  RandomBalls random(5);
  svo::LooseOctree tree(glm::dvec3(0.0), 16.0);
  for (std::uint32_t i = 0; i < 2000; ++i)
  {
    const svo::Ball ball = random.ball();
    tree.insert(i, ball.centre, ball.radius);
  }
  // The first node of depth 2 with many below it.
  std::size_t skipped = 0, visited = 0;
  tree.visit(
    svo::VisitOrder{ { 9, 9, 9 } },
    [&](const svo::LooseNode& node, std::uint8_t& known)
    {
      EXPECT_EQ(known, node.depth > 1 ? 2 : node.depth) << "handed down, to no neighbour";
      known = static_cast<std::uint8_t>(std::min(node.depth + 1, 2));
      if (skipped == 0 && node.depth == 2 && node.objects > 70)
      {
        skipped = node.objects;
        return false;
      }
      return true;
    },
    [&](std::uint32_t) { ++visited; });
  ASSERT_GT(skipped, 0u);
  EXPECT_EQ(visited, 2000 - skipped);
}

TEST(LooseOctreeVisits, ManyMayLookAtOnce)
{
  RandomBalls random(8);
  svo::LooseOctree tree(glm::dvec3(0.0), 16.0);
  for (std::uint32_t i = 0; i < 3000; ++i)
  {
    const svo::Ball ball = random.ball();
    tree.insert(i, ball.centre, ball.radius);
  }
  const std::vector<TreeNode> alone = written(tree);
  std::vector<std::vector<TreeNode>> together(4);
  std::vector<std::thread> readers;
  for (std::vector<TreeNode>& nodes : together)
  {
    readers.emplace_back([&] { nodes = written(tree); });
  }
  for (std::thread& reader : readers)
  {
    reader.join();
  }
  for (const std::vector<TreeNode>& nodes : together)
  {
    EXPECT_TRUE(nodes == alone);
  }
}
