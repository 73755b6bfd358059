// Soft shadows and ambient occlusion at the ends of what numbers, and scenes, can say.
#include "svoSampleSequence.h"
#include "svoSoftStage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace svotest;

namespace
{
void expectFinite(const svo::Frame& frame, const std::string& name)
{
  const bool finite = std::all_of(frame.light.begin(), frame.light.end(),
    [](float light) { return std::isfinite(light) && light >= 0.0f; });
  EXPECT_TRUE(finite) << name;
  EXPECT_TRUE(std::any_of(frame.instance.begin(), frame.instance.end(),
    [](std::uint32_t instance) { return instance != ~0u; }))
    << name;
}
}

TEST(SoftExtremes, ALightInsideOfACasterIsDark)
{
  const svo::Instance lamp = instanceOf(makeOctree(sphere(24, 32), 6), 0, movedTo(0, 0, 3));
  svo::Scene scene = planeUnder({ lamp });
  const svo::View view = fromAbove(3.0, 3.0, 32, 32);
  for (const double size : { 1e-3, 0.5, 0.9 })
  {
    scene.lights = { lightOf(svo::Light::Kind::Point, { 0, 0, 3 }) };
    scene.lights[0].size = size;
    for (const double share : lightShares(scene, view, sampled(16)))
    {
      ASSERT_EQ(0.0, share) << size;
    }
  }
}

TEST(SoftExtremes, ALightThatTouchesItsReceiver)
{
  svo::Scene scene = planeUnder({});
  scene.instances[0].castShadow = true;
  const svo::View view = fromAbove(2.0, 2.0, 33, 33);
  for (const double height : { 1.0, 0.5, 1e-3 })
  {
    scene.lights = { lightOf(svo::Light::Kind::Point, { 0, 0, height }) };
    scene.lights[0].size = 1.0;
    const std::vector<double> shares = lightShares(scene, view, sampled(16));
    for (const double share : shares)
    {
      ASSERT_EQ(1.0, share) << height; // what of it lies below the ground is none of it
    }
    expectFinite(rendered(scene, view, sampled(16)), "touching");
  }
}

TEST(SoftExtremes, SizesThatAreNone)
{
  Stage stage;
  stage.settings.ambientOcclusion = false;
  const auto withSize = [&](double size)
  {
    stage.scene.lights[0].size = size;
    return shown(stage);
  };
  const svo::Frame none = withSize(0.0);
  EXPECT_TRUE(identical(none, withSize(-1.0)));
  EXPECT_TRUE(identical(none, withSize(std::nan(""))));
  expectFinite(withSize(std::numeric_limits<double>::infinity()), "infinite");
  expectFinite(withSize(std::numeric_limits<double>::denorm_min()), "tiny");
  expectFinite(withSize(std::numeric_limits<double>::max()), "huge");
}

TEST(SoftExtremes, ALightLargerThanTheScene)
{
  Stage stage;
  stage.scene.lights[0].size = 100.0; // all is in it
  stage.scene.lights.resize(1);
  stage.settings.ambientOcclusion = false;
  const svo::Frame inside = shown(stage);
  expectFinite(inside, "inside");
  // Between a point and a light that it is in there is nothing.
  stage.settings.shadowTechnique = svo::ShadowTechnique::None;
  EXPECT_EQ(inside.light, shown(stage).light);
  // From outside it fills nearly the hemisphere: half of what an upright plane leaves.
  svo::Scene scene = planeUnder({ instanceOf(makeOctree(square(20.0), 4), 0, movedTo(20, 0, 1)) });
  scene.lights = { lightOf(svo::Light::Kind::Point, { 0, 0, 1.0e4 }) };
  scene.lights[0].size = 0.9e4;
  const svo::View view = fromAbove(0.001, 0.001, 8, 8);
  for (const double share : lightShares(scene, view, sampled(1024)))
  {
    EXPECT_NEAR(0.5, share, 0.005);
  }
}

namespace
{
svo::View viewOf(const Stage& of, const glm::dvec3& at, double size)
{
  svo::View view;
  svo::makeView(glm::lookAt(at + size * glm::dvec3(3, -6, 4), at, glm::dvec3(0, 0, 1)),
    glm::perspective(
      glm::radians(40.0), double(of.view.width) / of.view.height, 0.1 * size, 100.0 * size),
    of.view.width, of.view.height, view);
  return view;
}

/// The same scene elsewhere, and of another size.
Stage placed(const Stage& of, const glm::dvec3& at, double size)
{
  Stage stage = of;
  const glm::dmat4 place = glm::scale(glm::translate(glm::dmat4(1.0), at), glm::dvec3(size));
  for (svo::Instance& instance : stage.scene.instances)
  {
    instance.localToWorld = place * instance.localToWorld;
  }
  for (svo::Light& light : stage.scene.lights)
  {
    light.position = at + size * light.position;
    light.size *= light.atInfinity() ? 1.0 : size;
  }
  stage.view = viewOf(of, at, size);
  stage.settings.ambientOcclusionDistance *= size;
  return stage;
}

/// The same, near to `at`, where its grain is that of another view.
Stage placedAlike(const Stage& of, const glm::dvec3& at, double size, const svo::View& other)
{
  Stage stage = placed(of, at, size);
  for (int i = 1; svo::noiseShift(stage.view) != svo::noiseShift(other) && i < 1000000; ++i)
  {
    stage.view = viewOf(of, at + 0.37 * size * i, size);
    if (svo::noiseShift(stage.view) == svo::noiseShift(other))
    {
      stage = placed(of, at + 0.37 * size * i, size);
    }
  }
  return stage;
}

double meanDifference(const svo::Frame& a, const svo::Frame& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.light.size(); ++i)
  {
    sum += std::abs(double(a.light[i]) - b.light[i]);
  }
  return sum / static_cast<double>(a.light.size());
}
}

// The same picture, but for rays that pass an edge as closely as the numbers tell: 1e-9 of the
// scene at 1e7, 1e-6 in floats; of some edges a pixel.
TEST(SoftExtremes, PlaceAndScaleDoNotMatter)
{
  Stage stage;
  stage.settings.ambientOcclusionDistance = 1.0;
  const Stage here = placed(stage, glm::dvec3(0.0), 1.0);
  const svo::Frame expected = shown(here);
  for (const auto& [at, size] : { std::pair(glm::dvec3(1e7, -1e7, 1e7), 1.0),
         std::pair(glm::dvec3(0.0), 1e-6), std::pair(glm::dvec3(0.0), 1e6),
         std::pair(glm::dvec3(5e6, 0, 0), 1e6), std::pair(glm::dvec3(1, 2, 3), 1e-6) })
  {
    const Stage there = placedAlike(stage, at, size, here.view);
    ASSERT_EQ(svo::noiseShift(here.view), svo::noiseShift(there.view));
    const svo::Frame frame = shown(there);
    const std::string name = std::to_string(at.x) + " " + std::to_string(size);
    expectFinite(frame, name);
    EXPECT_LT(meanDifference(expected, frame), 1e-3) << name;
  }
}

// What is closer to a large caster than its own rays begin off it: rays of others do not.
TEST(SoftExtremes, WhatLiesCloselyUnderAHugeCasterIsClosedOff)
{
  for (const double size : { 1e2, 1e4 })
  {
    for (const double gap : { 0.01, 0.2 })
    {
      svo::Instance caster = instanceOf(makeOctree(square(1.0), 4), 2);
      caster.localToWorld = glm::scale(movedTo(0, 0, gap), glm::dvec3(size));
      svo::Scene scene = planeUnder({ caster });
      const svo::View view = fromAbove(5.0, 5.0, 16, 16);
      const std::vector<double> closed = closedShares(scene, view, sampled(16), 50.0);
      EXPECT_EQ(1.0, *std::min_element(closed.begin(), closed.end())) << size << ' ' << gap;
      scene.lights.resize(1);
      scene.lights[0].direction = glm::dvec3(0, 0, -1);
      scene.lights[0].size = 10.0;
      const std::vector<double> lit = lightShares(scene, view, sampled(16));
      EXPECT_EQ(0.0, *std::max_element(lit.begin(), lit.end())) << size << ' ' << gap;
    }
  }
}

// A plane sheared, and mirrored, in itself is the same plane, but for rays that pass its edge as
// closely as floats tell: 1e-6 of 40 in penumbras half a unit wide, so one of 10^4 rays.
TEST(SoftExtremes, ShearedInstances)
{
  const svo::Instance straight = instanceOf(makeOctree(square(20.0), 5), 0, movedTo(20, 0, 1));
  const svo::View view = fromAbove(0.5, 0.1, 64, 8, { -0.1, 0, 0 });
  const auto shares = [&](const svo::Instance& instance)
  {
    svo::Scene scene = planeUnder({ instance });
    scene.lights = { lightOf(svo::Light::Kind::Directional, { 0.1, 0.2, 1 }) };
    scene.lights[0].size = 30.0;
    return lightShares(scene, view, sampled(64));
  };
  const std::vector<double> expected = shares(straight);
  EXPECT_GT(Difference(expected, std::vector<double>(expected.size(), 1.0)).rms, 0.1);
  for (const double side : { 1.0, -1.0 })
  {
    svo::Instance sheared = straight;
    glm::dmat4 shear(1.0);
    shear[0] = { 1, 0.5, 0, 0 };
    shear[1] = { 0, side, 0, 0 };
    shear[2] = { 3, -2, 1, 0 };
    sheared.localToWorld = straight.localToWorld * shear;
    const std::vector<double> found = shares(sheared);
    double different = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      different += 64 * std::abs(found[i] - expected[i]);
    }
    EXPECT_LE(different, 64.0 * static_cast<double>(found.size()) * 1e-4);
  }
}

TEST(SoftExtremes, AThousandLights)
{
  Stage one;
  one.settings.ambientOcclusion = false;
  one.settings.lightSamples = 1;
  one.view = lookAt({ 3, -6, 4 }, 40, 32);
  one.scene.lights.resize(1);
  Stage many = one;
  for (int i = 1; i < 1000; ++i)
  {
    many.scene.lights.push_back(one.scene.lights[0]);
    many.scene.lights.back().id = 1000 + i;
    many.scene.lights.back().size = 0.001 * i;
  }
  for (svo::Light& light : many.scene.lights)
  {
    light.color = glm::vec3(0.001f);
  }
  const svo::Frame few = shown(one), all = shown(many);
  expectFinite(few, "one");
  expectFinite(all, "thousand");
  one.settings.shadowTechnique = svo::ShadowTechnique::None;
  const svo::Frame open = shown(one);
  // One sample is all or nothing; a thousandth of a thousand lights lies between.
  int between = 0;
  for (std::size_t i = 0; i < open.light.size(); ++i)
  {
    EXPECT_LE(all.light[i], open.light[i] * (1.0f + 1000 * 6e-8f));
    between += all.light[i] > 0.02f * open.light[i] && all.light[i] < 0.98f * open.light[i];
  }
  EXPECT_GT(between, 50);
}
