// Crowds of balls, a loose octree written down, and one that is made plainly to compare with.
#ifndef svoCrowdFixtures_h
#define svoCrowdFixtures_h

#include "svoLooseOctree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace svotest
{
using Crowd = std::map<std::uint32_t, svo::Ball>;

/// What is kept of object i of a group; of outsiders a ball without an end.
inline svo::Ball keptBall(const svo::LooseObjects& some, std::uint32_t i)
{
  return some.x ? svo::Ball{ some.low +
      some.unit * glm::dvec3(some.x[i] + 0.5, some.y[i] + 0.5, some.z[i] + 0.5),
    some.unit * some.radius[i] + some.noise }
                : svo::Ball{ glm::dvec3(0.0), std::numeric_limits<double>::infinity() };
}

/// All that is kept.
inline Crowd keptBalls(const svo::LooseOctree& tree)
{
  Crowd kept;
  tree.visitGroups(
    svo::VisitOrder{ { 0, 0, 0 } }, [](const svo::LooseNode&, std::uint8_t&) { return true; },
    [&](const svo::LooseObjects& some, std::uint8_t)
    {
      for (std::uint32_t i = 0; i < some.count; ++i)
      {
        kept[some.objects[i]] = keptBall(some, i);
      }
    });
  return kept;
}

/// Depth, the middle of the cell, names in ascending order; outsiders have depth -1.
struct TreeNode
{
  int depth;
  std::array<double, 3> centre;
  std::vector<std::uint32_t> objects;
  bool operator==(const TreeNode& other) const
  {
    return this->depth == other.depth && this->centre == other.centre &&
      this->objects == other.objects;
  }
};

/// All nodes of a tree, in the order of their codes.
inline std::vector<TreeNode> written(const svo::LooseOctree& tree)
{
  std::vector<TreeNode> nodes{ { -1, {}, {} } };
  tree.visit(
    svo::VisitOrder::along({ 1, 1, 1 }),
    [&](const svo::LooseNode& node, std::uint8_t&)
    {
      nodes.push_back({ node.depth, { node.centre.x, node.centre.y, node.centre.z }, {} });
      return true;
    },
    [&](std::uint32_t object) { nodes.back().objects.push_back(object); });
  for (TreeNode& node : nodes)
  {
    std::sort(node.objects.begin(), node.objects.end());
  }
  return nodes;
}

/// A cube, and what belongs where in it, by loops. A loose cell is 1.25 times as wide as a cell.
struct PlainTree
{
  glm::dvec3 low;
  double edge;

  int deepest(double radius) const
  {
    int d = 0;
    while (d < svo::LooseOctree::MostDepth && radius <= std::ldexp(0.125 * this->edge, -d - 1))
    {
      ++d;
    }
    return d;
  }
  bool fits(const svo::Ball& ball) const
  {
    const glm::dvec3 at = ball.centre - this->low;
    return at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x <= this->edge && at.y <= this->edge &&
      at.z <= this->edge && ball.radius >= 0 && ball.radius <= 0.125 * this->edge;
  }
  void place(const Crowd& all, int depth, const glm::dvec3& corner, std::vector<TreeNode>& to) const
  {
    if (all.empty())
    {
      return;
    }
    const double half = std::ldexp(this->edge, -depth - 1);
    const glm::dvec3 middle = corner + half;
    const std::size_t mine = to.size();
    to.push_back({ depth, { middle.x, middle.y, middle.z }, {} });
    Crowd below[8];
    for (const auto& [name, ball] : all)
    {
      if (all.size() <= svo::LooseOctree::Bucket || this->deepest(ball.radius) == depth)
      {
        to[mine].objects.push_back(name);
        continue;
      }
      const glm::bvec3 upper = glm::greaterThanEqual(ball.centre, middle);
      below[upper.x + 2 * upper.y + 4 * upper.z][name] = ball;
    }
    for (int i = 0; i < 8; ++i)
    {
      this->place(below[i], depth + 1, corner + half * glm::dvec3(i & 1, i >> 1 & 1, i >> 2), to);
    }
  }
  std::vector<TreeNode> written(const Crowd& crowd) const
  {
    std::vector<TreeNode> nodes{ { -1, {}, {} } };
    Crowd inside;
    for (const auto& [name, ball] : crowd)
    {
      if (this->fits(ball))
      {
        inside[name] = ball;
      }
      else
      {
        nodes[0].objects.push_back(name);
      }
    }
    this->place(inside, 0, this->low, nodes);
    return nodes;
  }
};

/// The cube [-8, 8]^3.
inline PlainTree plainly()
{
  return { glm::dvec3(-8.0), 16.0 };
}

inline svo::LooseOctree treeLike(const PlainTree& plain)
{
  return svo::LooseOctree(plain.low + 0.5 * plain.edge, plain.edge);
}

inline svo::LooseOctree treeOf(const PlainTree& plain, const Crowd& crowd)
{
  svo::LooseOctree tree = treeLike(plain);
  for (const auto& [name, ball] : crowd)
  {
    tree.insert(name, ball.centre, ball.radius);
  }
  return tree;
}

/// Balls in the cube [-8, 8]^3 and a few beyond it, in clusters and alone, from points to balls
/// that fit no cell.
class RandomBalls
{
public:
  explicit RandomBalls(unsigned seed)
    : Random(seed)
  {
  }
  double between(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(this->Random);
  }
  std::uint32_t below(std::uint32_t count) { return this->Random() % count; }
  svo::Ball ball()
  {
    const auto place = [&](double reach)
    {
      return glm::dvec3(
        this->between(-reach, reach), this->between(-reach, reach), this->between(-reach, reach));
    };
    svo::Ball ball;
    const std::uint32_t kind = this->below(20);
    ball.centre = kind == 0 ? place(12.0)
      : kind < 8            ? glm::dvec3(1.3, -2.7, 5.1) + place(0.02)
      : kind == 8           ? glm::dvec3(-4.0, 4.0, 0.0) // on planes of many nodes
                            : place(8.0);
    ball.radius = kind == 9 ? 0.0
      : kind == 10          ? std::ldexp(1.0, 2 - static_cast<int>(this->below(16)))
                            : std::exp2(this->between(-18.0, 3.5));
    return ball;
  }

private:
  std::mt19937 Random;
};
}

#endif
