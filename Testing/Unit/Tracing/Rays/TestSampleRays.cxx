// Sampled rays through all casters, asked together in float, against rays alone in double.
#include "svoEyeHits.h"
#include "svoInstanceTree.h"
#include "svoIntersect.h"
#include "svoSampleDirections.h"
#include "svoSampleRays.h"
#include "svoTracerScenes.h"
#include "svoWorldSize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

using namespace svotest;

namespace
{
/// How far off rays begin at least, and what floats tell apart in a caster's cube, of its edge.
constexpr double Resolution = 1e-6;

/// Balls and rings in a cube of edge 8, scaled, turned, mirrored and sheared; every fifth lets
/// light through.
svo::Scene crowd()
{
  static const svo::Octree ball = makeOctree(sphere(20, 30), 6);
  static const svo::Octree ring = makeOctree(torus(30, 16), 7);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  svo::Scene scene;
  for (std::uint64_t i = 0; i < 70; ++i)
  {
    glm::dmat4 place = movedTo(4.0 * unit(random), 4.0 * unit(random), 4.0 * unit(random));
    place =
      glm::rotate(place, 3.0 * unit(random), glm::dvec3(unit(random), unit(random), unit(random)));
    if (i % 3 == 0)
    {
      glm::dmat4 shear(1.0);
      shear[1][0] = 0.7;
      place = place * shear;
    }
    const double size = i % 2 ? 0.8 + 0.5 * unit(random) : 0.03 * std::exp2(3.0 * unit(random));
    place = glm::scale(place, glm::dvec3(i % 8 < 2 ? -size : size, size, 0.7 * size));
    scene.instances.push_back(instanceOf(i % 4 < 2 ? ball : ring, i + 1, place));
    scene.instances.back().opacity = i % 5 == 0 ? 0.25f : 1.0f;
  }
  return scene;
}

/// One ray from `start`, in double: what is blocked of it.
double blockedAlone(const svo::Scene& scene, const glm::dvec3& position, const glm::dvec3& side,
  const glm::dvec3& along, double length, double offset, const glm::dvec3& beside = glm::dvec3(0))
{
  double left = 1.0;
  for (const svo::Instance& instance : scene.instances)
  {
    const double edge = svo::worldVoxel(instance, 0);
    const glm::dvec3 start =
      position + std::max(offset, Resolution * edge) * side + Resolution * edge * beside;
    const svo::WorldToOctree toOctree(instance.body->octree, instance.localToWorld);
    const svo::Ray ray{ toOctree.point(start), toOctree.vector(along), 0.0,
      std::min(length, 1e300) };
    if (svo::occluded(
          instance.body->octree, ray, { instance.body->leafGeometry, svo::MaximumLevel }))
    {
      left *= 1.0 - double(instance.opacity);
    }
  }
  return 1.0 - left;
}

/// Where casters are asked for, with their tree and without.
struct Asked
{
  svo::Scene scene;
  svo::LayeredView eye;
  svo::InstanceTree tree;
  std::unique_ptr<svo::RayCasters> plain, culled;

  explicit Asked(const svo::Scene& of)
    : scene(stamped(of))
  {
    prepareEye(this->eye, this->scene, lookAt({ 3, -5, 3 }, 16, 16));
    this->tree.follow(this->scene, svo::SceneFollower().follow(this->scene), svo::serialFor);
    this->plain = std::make_unique<svo::RayCasters>(this->scene, this->eye.hits().instances);
    this->culled =
      std::make_unique<svo::RayCasters>(this->scene, this->eye.hits().instances, this->tree.tree());
  }
};

glm::dvec3 anywhere(std::mt19937& random, double size)
{
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double x = unit(random), y = unit(random), z = unit(random);
  return size * glm::dvec3(x, y, z);
}

glm::vec3 anyDirection(std::mt19937& random)
{
  for (;;)
  {
    const glm::dvec3 d = anywhere(random, 1.0);
    if (glm::length(d) > 0.1)
    {
      return glm::vec3(glm::normalize(d));
    }
  }
}

/// Points around one, and rays from them, up to a reach: half of them anywhere, the others towards
/// an instance, to somewhere before it or behind.
void fill(std::mt19937& random, const svo::Scene& scene, svo::SampleBatch& batch, double reach)
{
  batch.points = batch.rays = 0;
  const glm::dvec3 middle = anywhere(random, 4.5);
  for (int i = 0; i < svo::SampleBatch::MostPoints; ++i)
  {
    batch.addPoint(middle + anywhere(random, 0.1), anyDirection(random));
  }
  std::uniform_real_distribution<double> share(0.9, 1.1);
  for (int ray = 0; ray < svo::SampleBatch::MostRays; ++ray)
  {
    const int point = ray % batch.points;
    const svo::Instance& at = scene.instances[random() % scene.instances.size()];
    const glm::dvec3 towards =
      glm::dvec3(at.localToWorld * glm::dvec4(anywhere(random, 0.8), 1.0)) - batch.position[point];
    switch (ray % 8)
    {
      case 0:
        batch.addRay(point, anyDirection(random), 0.0f);
        break;
      case 1:
      case 2:
      case 3:
        batch.addRay(point, anyDirection(random), static_cast<float>(reach));
        break;
      default:
        batch.addRay(point, glm::vec3(glm::normalize(towards)),
          static_cast<float>(std::min(share(random) * glm::length(towards), reach)));
    }
  }
}
}

TEST(SampleRays, AnswersAreThoseOfRaysAlone)
{
  const Asked asked(crowd());
  std::mt19937 random(2);
  auto batch = std::make_unique<svo::SampleBatch>();
  int rays = 0, blocked = 0, partly = 0, different = 0, unexplained = 0;
  for (int round = 0; round < 60; ++round)
  {
    const double reach = round % 2 ? 2.0 : 1e20, offset = round % 3 ? 0.0 : 1e-3;
    fill(random, asked.scene, *batch, reach);
    svo::traceSamples(*asked.plain, offset, *batch);
    for (int i = 0; i < batch->rays; ++i)
    {
      const glm::dvec3 at = batch->position[batch->point[i]], along(batch->direction[i]);
      const glm::dvec3 side(batch->side[batch->point[i]]);
      const double length = batch->length[i], found = batch->blocked[i];
      const auto alone = [&](const glm::dvec3& beside) {
        return length > 0.0 ? blockedAlone(asked.scene, at, side, along, length, offset, beside)
                            : 0.0;
      };
      // Of at most 70 opacities.
      const auto same = [&](double expected) { return std::abs(found - expected) < 70 * 6e-8; };
      ++rays;
      blocked += found == 1.0;
      partly += found > 0.0 && found < 1.0;
      if (same(alone(glm::dvec3(0.0))))
      {
        continue;
      }
      ++different;
      // A ray beside it has to have the answer.
      bool explained = false;
      for (int k = 0; k < 27 && !explained; ++k)
      {
        explained = same(alone(glm::dvec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)));
      }
      unexplained += !explained;
    }
  }
  EXPECT_EQ(60 * 512, rays);
  EXPECT_GT(blocked, 5000);
  EXPECT_GT(partly, 1000);
  EXPECT_LT(blocked + partly, 28000);
  EXPECT_EQ(0, unexplained);
  // Edges of some ten balls, seen by a ray, are a few of their radii long; so are their discs wide:
  // a share of 10 times the resolution passes so closely.
  EXPECT_LE(different, rays / 1000);
}

// Of a ball 50 000 of its cubes away floats say no more than a three-hundredth of it.
TEST(SampleRays, CastersFarAwayAreMetExactly)
{
  constexpr double Size = 1e-4;
  svo::Scene scene;
  scene.instances = { instanceOf(
    makeOctree(sphere(20, 30), 5), 1, glm::scale(movedTo(3, 4, 5), glm::dvec3(Size))) };
  const Asked asked(scene);
  std::mt19937 random(7);
  auto batch = std::make_unique<svo::SampleBatch>();
  int blocked = 0, unexplained = 0;
  for (int round = 0; round < 20; ++round)
  {
    batch->points = batch->rays = 0;
    const glm::dvec3 at = glm::dvec3(3, 4, 5) + 10.0 * glm::dvec3(anyDirection(random));
    const int point = batch->addPoint(at, anyDirection(random));
    for (int ray = 0; ray < svo::SampleBatch::MostRays; ++ray)
    {
      const glm::dvec3 towards = glm::dvec3(3, 4, 5) + anywhere(random, 1.5 * Size) - at;
      batch->addRay(point, glm::vec3(glm::normalize(towards)), 1e20f);
    }
    svo::traceSamples(*asked.plain, 0.0, *batch);
    for (int i = 0; i < batch->rays; ++i)
    {
      bool explained = false;
      for (int k = 0; k < 27 && !explained; ++k)
      {
        explained = batch->blocked[i] ==
          blockedAlone(asked.scene, at, glm::dvec3(batch->side[point]),
            glm::dvec3(batch->direction[i]), 1e20, 0.0,
            glm::dvec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
      }
      blocked += batch->blocked[i] == 1.0f;
      unexplained += !explained;
    }
  }
  EXPECT_GT(blocked, 2000);
  EXPECT_LT(blocked, 9000);
  EXPECT_EQ(0, unexplained);
}

TEST(SampleRays, AnswersDependNeitherOnOrderNorOnCompanyNorOnTheTree)
{
  const Asked asked(crowd());
  ASSERT_NE(nullptr, asked.tree.tree());
  std::mt19937 random(3);
  auto batch = std::make_unique<svo::SampleBatch>(), other = std::make_unique<svo::SampleBatch>();
  for (int round = 0; round < 40; ++round)
  {
    fill(random, asked.scene, *batch, round % 2 ? 2.0 : 1e20);
    svo::traceSamples(*asked.plain, 0.0, *batch);
    // With the tree.
    *other = *batch;
    std::fill_n(other->blocked, other->rays, -1.0f);
    svo::traceSamples(*asked.culled, 0.0, *other);
    ASSERT_TRUE(std::equal(batch->blocked, batch->blocked + batch->rays, other->blocked));
    // Some of them, in another order.
    other->rays = 0;
    std::vector<int> which;
    for (int i = batch->rays - 1; i > 0; i -= 1 + round % 5)
    {
      which.push_back(i);
      other->addRay(batch->point[i], batch->direction[i], batch->length[i]);
    }
    svo::traceSamples(*asked.plain, 0.0, *other);
    for (std::size_t k = 0; k < which.size(); ++k)
    {
      ASSERT_EQ(batch->blocked[which[k]], other->blocked[k]) << round;
    }
  }
}

// A box is on the way to a light where a ray from one of the points to a part of the light meets
// it.
TEST(SampleRays, NoCasterOnTheWayToALightIsLeftOut)
{
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto power = [&](double low, double high)
  { return low * std::pow(high / low, unit(random)); };
  int met = 0;
  for (int round = 0; round < 20000; ++round)
  {
    svo::Light light;
    light.kind = round % 2 ? svo::Light::Kind::Point : svo::Light::Kind::Directional;
    light.position = anywhere(random, 10.0);
    light.direction = glm::dvec3(anyDirection(random));
    light.size = round % 2 ? power(0.01, 20.0) : power(0.1, 170.0);
    svo::Box box;
    const glm::dvec3 middle = anywhere(random, 2.0);
    const double wide[3] = { power(1e-3, 10.0), power(1e-3, 10.0), power(1e-3, 10.0) };
    box.add(middle, { wide[0], wide[1], wide[2] });
    const svo::BoxWay way = svo::wayToLight(light, box);
    for (int sample = 0; sample < 20; ++sample)
    {
      glm::dvec3 from = middle;
      for (int axis = 0; axis < 3; ++axis)
      {
        from[axis] += wide[axis] *
          (sample % 2        ? 2.0 * unit(random) - 1.0
              : random() % 2 ? 1.0
                             : -1.0);
      }
      const svo::LightCone cone(light, from);
      float length;
      const glm::vec3 along = cone.direction(svo::SquarePoint{ static_cast<std::uint32_t>(random()),
                                               static_cast<std::uint32_t>(random()) },
        length);
      if (!(length > 0.0f))
      {
        continue;
      }
      // A small box around a place on the way.
      const double t = std::min(double(length), power(1e-2, 100.0)) * 0.999;
      const svo::CasterBox there(from + t * glm::dvec3(along), power(1e-3, 1.0));
      ASSERT_TRUE(there.mayMeet(way)) << round << " " << sample << ", size " << light.size;
      ++met;
    }
  }
  EXPECT_GT(met, 300000);
}
