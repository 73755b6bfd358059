#include "svoInstanceTree.h"

#include "svoBox.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
Ball ballOf(const Octree& octree, const glm::dmat4& localToWorld)
{
  const Header& h = octree.header();
  const double half = 0.5 * h.voxelSize * static_cast<double>(1u << h.level);
  const glm::dvec4 middle(h.origin[0] + half, h.origin[1] + half, h.origin[2] + half, 1.0);
  const glm::dvec3 x(localToWorld[0]), y(localToWorld[1]), z(localToWorld[2]);
  double reach = 0.0, rounding = 0.0;
  for (const glm::dvec3& corner : { x + y + z, x + y - z, x - y + z, x - y - z })
  {
    reach = std::max(reach, half * glm::length(corner));
  }
  for (int i = 0; i < 4; ++i)
  {
    rounding += std::abs(middle[i]) * glm::length(glm::dvec3(localToWorld[i]));
  }
  // A sum that holds anything that is not finite is not finite.
  return { glm::dvec3(localToWorld * middle), reach * (1.0 + 0x1p-40) + 0x1p-46 * rounding };
}
}

Ball ballOf(const Instance& instance)
{
  if (!instance.body->octree)
  {
    return { glm::dvec3(0.0), -1.0 };
  }
  Ball ball = ballOf(instance.body->octree, instance.localToWorld);
  if (instance.body->casterOctree)
  {
    const Ball other = ballOf(instance.body->casterOctree, instance.localToWorld);
    const double apart = glm::length(other.centre - ball.centre) + other.radius;
    ball.radius = apart > ball.radius ? apart * (1.0 + 0x1p-40) : ball.radius;
  }
  return ball;
}

void InstanceTree::put(std::uint32_t object, const Ball& ball)
{
  if (ball.radius < 0.0)
  {
    this->Tree->remove(object);
  }
  else
  {
    this->Tree->insert(object, ball.centre, ball.radius);
  }
}

void InstanceTree::build(const std::vector<Ball>& balls)
{
  Box box;
  for (const Ball& ball : balls)
  {
    if (ball.radius >= 0.0 &&
      std::isfinite(ball.radius + ball.centre.x + ball.centre.y + ball.centre.z))
    {
      box.add(ball.centre - ball.radius);
      box.add(ball.centre + ball.radius);
    }
  }
  const glm::dvec3 size = box.high - box.low;
  const double edge =
    box.known() ? 2.0 * std::max({ size.x, size.y, size.z }) : 0.0; // room to move
  this->Tree.emplace(0.5 * (box.low + box.high), edge);
  this->Tree->reserve(balls.size());
  for (std::uint32_t i = 0; i < balls.size(); ++i)
  {
    this->put(i, balls[i]);
  }
  this->Tree->arrange();
  this->OutsidersAtFirst = this->Tree->outsiders().size();
}

void InstanceTree::follow(const Scene& scene, const ParallelFor& parallelFor)
{
  if (scene.version != 0 && scene.version == this->Version)
  {
    return;
  }
  this->Version = scene.version;
  const std::size_t count = scene.instances.size();
  const std::size_t before = this->Versions.size();
  const auto stays = [&](std::size_t i)
  {
    const std::uint64_t version = scene.instances[i].version;
    return i < before && version != 0 && version == this->Versions[i];
  };
  std::vector<Ball> balls(count < Fewest ? 0 : count); // of those that do not stay
  std::atomic<std::size_t> shown{ 0 };
  parallelFor(0, count, 512,
    [&](std::size_t first, std::size_t last)
    {
      std::size_t mine = 0;
      for (std::size_t i = first; i < last; ++i)
      {
        const Instance& instance = scene.instances[i];
        mine += instance.visible && instance.body->octree && !instance.body->octree.empty();
        if (!balls.empty() && !stays(i))
        {
          balls[i] = ballOf(instance);
        }
      }
      shown += mine;
    });
  this->Shown = shown;
  if (balls.empty())
  {
    this->Tree.reset();
    this->Versions.clear();
    return;
  }
  if (!this->Tree)
  {
    this->build(balls);
  }
  else
  {
    for (std::size_t i = count; i < before; ++i)
    {
      this->Tree->remove(static_cast<std::uint32_t>(i));
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!stays(i))
      {
        this->put(static_cast<std::uint32_t>(i), balls[i]);
      }
    }
  }
  if (this->Tree->outsiders().size() > 2 * this->OutsidersAtFirst + count / 16 + 8)
  {
    std::transform(scene.instances.begin(), scene.instances.end(), balls.begin(),
      [](const Instance& instance) { return ballOf(instance); });
    this->build(balls);
  }
  this->Versions.resize(count);
  std::transform(scene.instances.begin(), scene.instances.end(), this->Versions.begin(),
    [](const Instance& instance) { return instance.version; });
}
}
