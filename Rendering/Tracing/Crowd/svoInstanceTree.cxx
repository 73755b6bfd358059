#include "svoInstanceTree.h"

#include "svoBox.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

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

void InstanceTree::build(const Scene& scene, const ParallelFor& parallelFor)
{
  std::vector<Ball> balls(scene.instances.size());
  forEach(
    parallelFor, balls.size(), 512, [&](std::size_t i) { balls[i] = ballOf(scene.instances[i]); });
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

void InstanceTree::follow(
  const Scene& scene, const SceneChanges& changes, const ParallelFor& parallelFor)
{
  const std::size_t count = changes.count;
  const std::vector<std::uint32_t>& changed = changes.instances;
  assert(count == scene.instances.size());
  if (changes.none())
  {
    return;
  }
  this->Shown =
    static_cast<std::size_t>(std::count_if(scene.instances.begin(), scene.instances.end(),
      [](const Instance& instance)
      { return instance.visible && instance.body->octree && !instance.body->octree.empty(); }));
  if (count < Fewest)
  {
    this->Tree.reset();
    return;
  }
  if (!this->Tree)
  {
    this->build(scene, parallelFor);
    return;
  }
  for (std::size_t i = count; i < changes.before; ++i)
  {
    this->Tree->remove(static_cast<std::uint32_t>(i));
  }
  std::vector<Ball> balls(changed.size());
  forEach(parallelFor, changed.size(), 512,
    [&](std::size_t k) { balls[k] = ballOf(scene.instances[changed[k]]); });
  for (std::size_t k = 0; k < changed.size(); ++k)
  {
    this->put(changed[k], balls[k]);
  }
  if (this->Tree->outsiders().size() > 2 * this->OutsidersAtFirst + count / 16 + 8)
  {
    this->build(scene, parallelFor);
  }
}
}
