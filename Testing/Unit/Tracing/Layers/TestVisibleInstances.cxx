#include "svoTracerScenes.h"

#include "svoIntersect.h"
#include "svoVisibleInstances.h"
#include "svoWorldToOctree.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <random>

using namespace svotest;

namespace
{
bool everybody(const svo::Instance&)
{
  return true;
}

int lastLevel(const svo::Instance& instance, const svo::LocalView&)
{
  return instance.body->octree.level();
}

/// Balls all around the origin, turned, squeezed, mirrored, of many sizes.
svo::Scene manyBalls(unsigned count)
{
  const svo::Octree ball = makeOctree(sphere(9, 12), 5);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  svo::Scene scene;
  for (unsigned i = 0; i < count; ++i)
  {
    const glm::dvec3 at(6.0 * unit(random), 6.0 * unit(random), 6.0 * unit(random));
    const glm::dvec3 size(0.05 + std::abs(unit(random)), 0.02 + 0.5 * std::abs(unit(random)),
      (i % 5 ? 1.0 : -1.0) * (0.1 + std::abs(unit(random))));
    const glm::dmat4 place = glm::translate(glm::dmat4(1.0), at) *
      glm::rotate(glm::dmat4(1.0), 3.0 * unit(random), glm::dvec3(unit(random), 1.0, 0.3)) *
      glm::scale(glm::dmat4(1.0), size);
    scene.instances.push_back(instanceOf(ball, i + 1, place));
  }
  return scene;
}

std::vector<svo::View> everyProjection()
{
  std::vector<svo::View> views = { lookAt({ 0, -9, 3 }, 48, 40),
    lookAt({ 0.5, 0.2, 0 }, 48, 40, 90.0, { 3, 3, 1 }), lookAtParallel({ 4, -6, 2 }, 48, 40, 2.5) };
  svo::View offAxis;
  svo::makeView(glm::lookAt(glm::dvec3(2, -5, 1), glm::dvec3(0.0), glm::dvec3(0, 0, 1)),
    glm::frustum(-0.02, 0.1, 0.01, 0.06, 0.1, 8.0), 48, 40, offAxis);
  views.push_back(offAxis);
  return views;
}

/// True if the ray through a pixel's centre meets the instance between the clipping planes.
bool meets(const svo::Instance& instance, const svo::View& view, int x, int y)
{
  const svo::WorldToOctree toOctree(instance.body->octree, instance.localToWorld);
  const svo::Ray ray{ toOctree.point(view.rayOrigin(x + 0.5, y + 0.5)),
    toOctree.vector(view.rayDirection(x + 0.5, y + 0.5)), view.tNear, view.tFar };
  return svo::occluded(
    instance.body->octree, ray, { instance.body->leafGeometry, svo::MaximumLevel });
}

std::vector<svo::VisibleInstance> seenBy(const svo::Scene& scene, const svo::View& view,
  const std::function<bool(const svo::Instance&)>& takesPart, const svo::LevelOf& levelOf)
{
  svo::VisibleSet set;
  svo::findVisible(scene, view, {}, takesPart, svo::serialFor, set);
  std::vector<svo::VisibleInstance> visible;
  for (const std::uint32_t i : set.visible)
  {
    visible.push_back(svo::seenInstance(scene, i, view, levelOf, true));
  }
  return visible;
}
}

TEST(VisibleInstances, AllThatARayMeetsIsAmongThem)
{
  const svo::Scene scene = manyBalls(60);
  for (const svo::View& view : everyProjection())
  {
    const std::vector<svo::VisibleInstance> visible = seenBy(scene, view, everybody, lastLevel);
    EXPECT_LT(visible.size(), scene.instances.size()) << "none is culled";
    std::size_t next = 0, met = 0;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
    {
      const bool found = next < visible.size() && visible[next].index == i;
      const svo::PixelRect rect = found ? visible[next].local.rect : svo::PixelRect();
      next += found;
      for (int y = 0; y < view.height; ++y)
      {
        for (int x = 0; x < view.width; ++x)
        {
          if (meets(scene.instances[i], view, x, y))
          {
            ++met;
            ASSERT_TRUE(x >= rect.x0 && x < rect.x1 && y >= rect.y0 && y < rect.y1)
              << "instance " << i << ", pixel " << x << ", " << y;
          }
        }
      }
    }
    EXPECT_EQ(next, visible.size()) << "not in the scene's order";
    EXPECT_GT(met, 20u);
  }
}

TEST(VisibleInstances, WhatTakesNoPartOrHasNoOctreeIsNotAmongThem)
{
  svo::Scene scene = manyBalls(3);
  for (svo::Instance& instance : scene.instances)
  {
    instance.localToWorld = glm::dmat4(1.0);
  }
  scene.instances[0].body.own().octree = svo::Octree();
  scene.instances[1].visible = false;
  const std::vector<svo::VisibleInstance> visible = seenBy(
    scene, lookAt({ 0, -9, 3 }, 48, 40), [](const svo::Instance& i) { return i.visible; },
    lastLevel);
  ASSERT_EQ(visible.size(), 1u);
  EXPECT_EQ(visible[0].index, 2u);
  EXPECT_EQ(visible[0].id, scene.instances[2].id);
  EXPECT_EQ(visible[0].octree, &scene.instances[2].body->octree);
}

TEST(VisibleInstances, TheKeyNamesAllThatALayerDependsOn)
{
  svo::Scene scene = manyBalls(1);
  scene.instances[0].body.own().leafGeometry = svo::LeafGeometry::Plane;
  scene.instances[0].localToWorld = glm::dmat4(1.0);
  const svo::View view = lookAt({ 0, -9, 3 }, 48, 40);
  const auto keyOf = [&](int level)
  {
    const auto visible = seenBy(scene, view, everybody,
      [level](const svo::Instance&, const svo::LocalView&) { return level; });
    return visible.at(0).key;
  };
  const svo::LayerKey key = keyOf(4);
  EXPECT_TRUE(key == keyOf(4));
  EXPECT_FALSE(key == keyOf(3));
  scene.instances[0].id = 1000;
  EXPECT_TRUE(key == keyOf(4)) << "an identity is no look";
  scene.instances[0].body.own().leafGeometry = svo::LeafGeometry::Voxel;
  EXPECT_FALSE(key == keyOf(4));
  scene.instances[0].body.own().leafGeometry = svo::LeafGeometry::Plane;
  scene.instances[0].localToWorld[3][0] = 1e-9;
  EXPECT_FALSE(key == keyOf(4));
  scene.instances[0].localToWorld = glm::dmat4(1.0);
  scene.instances[0].body.own().octree = makeOctree(sphere(9, 12), 5); // the same, opened once more
  EXPECT_FALSE(key == keyOf(4)) << "another octree in the same place";
}
