// Frames with soft shadows and ambient occlusion: the same bits however they are made, and what
// comes of scenes at the ends of what numbers can say.
#include "svoInstructionSets.h"
#include "svoSoftScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace svotest;

namespace
{
/// A ball and a ring over a ground, small ones around, some of which let light through, some of
/// which are smooth; under a ball of light, a disc and a spot, and ambient occlusion.
struct Stage
{
  svo::Scene scene = ballRingAndGround();
  svo::View view = lookAt({ 3, -6, 4 }, 72, 56);
  svo::FrameSettings settings = sampled(5);

  Stage()
  {
    static const Mesh mesh = sphere(10, 14);
    static const svo::Octree octree = makeOctree(mesh, 5);
    static const std::vector<float> normals = radialNormals(mesh);
    for (int i = 0; i < 24; ++i)
    {
      const double angle = 2.0 * Pi * i / 24;
      const glm::dmat4 place =
        movedTo(2.2 * std::cos(angle), 2.2 * std::sin(angle), 0.3 + 0.02 * i);
      svo::Instance instance = instanceOf(octree, 10 + i, glm::scale(place, glm::dvec3(0.25)));
      instance.opacity = i % 6 == 0 ? 0.5f : 1.0f;
      if (i % 2)
      {
        instance.body.own().attributes.normals = normals.data();
        instance.body.own().attributes.normalAssociation = svo::Association::Point;
      }
      this->scene.instances.push_back(instance);
    }
    this->scene.lights.push_back(lightOf(svo::Light::Kind::Spot, { -2, -2, 4 }));
    this->scene.lights[0].size = 0.7;
    this->scene.lights[1].size = 8.0;
    this->scene.lights[2].size = 0.4;
    this->scene.lights[2].id = 79;
    this->settings.ambientOcclusion = true;
    this->settings.ambientOcclusionStrength = 0.8;
    this->settings.filterLightSamples = true;
  }
};

svo::Frame shown(const Stage& stage)
{
  return rendered(stage.scene, stage.view, stage.settings);
}

/// Pixels that the casters darken partly: else there is nothing to be the same.
void expectSoft(const Stage& stage)
{
  Stage plain = stage;
  plain.settings.ambientOcclusion = false;
  plain.settings.shadowTechnique = svo::ShadowTechnique::None;
  const svo::Frame soft = shown(stage), open = shown(plain);
  int partly = 0;
  for (std::size_t i = 0; i < soft.light.size(); i += 3)
  {
    partly += soft.light[i] < 0.95f * open.light[i] && soft.light[i] > 0.05f * open.light[i];
  }
  EXPECT_GT(partly, 500);
}

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

TEST(SoftFrames, ThreadsDoNotMatter)
{
  for (const bool antiAliasing : { false, true })
  {
    Stage stage;
    stage.settings.antiAliasing = antiAliasing;
    expectSoft(stage);
    const svo::Frame expected = shown(stage);
    for (const unsigned threads : { 2u, 3u, 7u })
    {
      svo::CPUTracer tracer;
      EXPECT_TRUE(identical(
        expected, rendered(tracer, stage.scene, stage.view, stage.settings, raggedFor(threads))));
    }
  }
}

TEST(SoftFrames, CullingDoesNotMatter)
{
  Stage stage;
  const svo::Frame expected = shown(stage);
  for (const bool view : { false, true })
  {
    for (const bool occlusion : { false, true })
    {
      stage.settings.viewCulling = view;
      stage.settings.occlusionCulling = occlusion;
      EXPECT_TRUE(identical(expected, shown(stage))) << view << " " << occlusion;
    }
  }
}

TEST(SoftFrames, TheOrderOfInstancesDoesNotMatter)
{
  Stage stage;
  for (svo::Instance& instance : stage.scene.instances)
  {
    instance.opacity = 1.0f; // what several let through is a product of floats
  }
  const svo::Frame expected = shown(stage);
  std::mt19937 random(4);
  for (int round = 0; round < 3; ++round)
  {
    std::shuffle(stage.scene.instances.begin(), stage.scene.instances.end(), random);
    const svo::Frame frame = shown(stage);
    EXPECT_EQ(expected.color, frame.color);
    EXPECT_EQ(expected.light, frame.light);
    EXPECT_EQ(expected.depth, frame.depth);
  }
}

TEST(SoftFrames, InstructionSetsDoNotMatter)
{
  const Stage stage;
  const svo::Frame expected = shown(stage);
  int sets = 0;
  onEveryInstructionSet(
    [&]
    {
      const svo::Frame frame = shown(stage);
      ++sets;
      EXPECT_EQ(expected.color, frame.color);
      EXPECT_EQ(expected.depth, frame.depth);
    });
  EXPECT_GT(sets, 1);
}

// What is filtered does not end where one block of a surface does.
TEST(SoftFrames, BlocksHaveNoSeams)
{
  const svo::Octree ground = makeOctree(square(4.0), 4);
  const svo::Instance ball = instanceOf(makeOctree(sphere(24, 32), 6), 0, movedTo(0, 0, 2));
  svo::Scene scene = planeUnder({ ball });
  svo::Light light = lightOf(svo::Light::Kind::Directional, { 0, 0, 1 });
  light.size = 30.0;
  scene.lights = { light };
  scene.instances[0].body = instanceOf(ground, 1).body;
  scene.instances[0].localToWorld = movedTo(4.0, 0, 0);
  svo::Instance other = scene.instances[0];
  other.localToWorld = movedTo(-4.0, 0, 0);
  other.id = 50;
  scene.instances.push_back(other);
  svo::Scene whole = scene;
  whole.instances.pop_back();
  whole.instances[0].localToWorld = glm::scale(glm::dmat4(1.0), glm::dvec3(2.0, 1.0, 1.0));
  svo::FrameSettings settings = sampled(4);
  settings.filterLightSamples = true;
  const svo::View view = fromAbove(2.0, 2.0, 96, 96);
  const svo::Frame inTwo = rendered(scene, view, settings), inOne = rendered(whole, view, settings);
  // Rays from there begin a rounding apart.
  int different = 0;
  for (std::size_t i = 0; i < inOne.light.size(); i += 3)
  {
    different += std::abs(inOne.light[i] - inTwo.light[i]) > 1e-3f * inOne.light[i];
  }
  EXPECT_LE(different, 9);
}

// Samples are added to those that there are.
TEST(SoftFrames, StepsDoNotMatter)
{
  Stage stage;
  stage.settings.lightSamples = 20;
  stage.settings.skyLight = true;
  for (const bool filtered : { false, true })
  {
    stage.settings.filterLightSamples = filtered;
    svo::CPUTracer atOnce, inSteps;
    const svo::Frame expected = rendered(atOnce, stage.scene, stage.view, stage.settings);
    std::uint64_t rays = 0;
    for (const int samples : { 3, 6, 12, 20 })
    {
      svo::FrameSettings few = stage.settings;
      few.samplesNow = samples;
      const svo::Frame frame = rendered(inSteps, stage.scene, stage.view, few);
      EXPECT_EQ(samples == 20, identical(expected, frame)) << samples;
      rays += inSteps.statistics().shadowRays;
    }
    // But for those that find the terminator.
    EXPECT_LT(rays, 1.1 * static_cast<double>(atOnce.statistics().shadowRays));
  }
}

// Else a pixel's errors of several lights would add up.
TEST(SoftFrames, LightsOfOtherNumbersHaveOtherGrain)
{
  Stage stage;
  stage.settings.ambientOcclusion = false;
  stage.scene.lights = { stage.scene.lights[0], stage.scene.lights[0] };
  stage.scene.lights[1].id = 5;
  stage.scene.lights[1].color = glm::vec3(0.0f);
  const svo::Frame first = shown(stage);
  std::swap(stage.scene.lights[0].color, stage.scene.lights[1].color);
  EXPECT_NE(first.color, shown(stage).color);
}

namespace
{
/// Changes one thing of the stage.
void changeAnything(std::mt19937& random, Stage& stage)
{
  const auto number = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<svo::Instance>& all = stage.scene.instances;
  std::vector<svo::Light>& lights = stage.scene.lights;
  const auto any = [&]() -> svo::Instance&
  { return all[3 + number(static_cast<int>(all.size()) - 3)]; };
  switch (number(lights.empty() ? 10 : 12))
  {
    case 0:
    case 1:
    case 2:
      any().localToWorld =
        glm::scale(movedTo(0.1 * number(50) - 2.5, 0.1 * number(50) - 2.5, 0.1 + 0.1 * number(10)),
          glm::dvec3(0.15 + 0.05 * number(3)));
      break;
    case 3:
      all[1 + number(2)].localToWorld = movedTo(0.2 * number(10) - 1.0, 0.0, 0.8 + 0.1 * number(5));
      break;
    case 4:
      any().castShadow = number(3) != 0;
      break;
    case 5:
      any().opacity = 0.25f * static_cast<float>(number(5));
      break;
    case 6:
      stage.settings.lightSamples = 1 + number(6);
      break;
    case 7:
      all[0].receiveShadow = number(3) != 0;
      break;
    case 8:
      stage.settings.ambientOcclusionDistance = 0.5 * number(4);
      break;
    case 9:
      stage.settings.ambientOcclusion = number(3) != 0;
      stage.settings.ambientOcclusionOfAllLight = number(2) != 0;
      break;
    case 10:
      lights[0].position += glm::dvec3(0.1 * number(3), 0.0, 0.1);
      break;
    default:
      lights[number(3)].size = 0.5 * number(5);
  }
}
}

TEST(SoftFrames, WhatIsKeptIsAsIfMadeAfresh)
{
  int kept = 0;
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    Stage stage;
    // Casters of which few tiles know, and lights from afar.
    stage.settings.ambientOcclusionDistance = 0.3;
    stage.settings.antiAliasing = seed == 3;
    stage.settings.shadowTechnique =
      seed == 1 ? svo::ShadowTechnique::Rays : svo::ShadowTechnique::Buffer;
    if (seed == 2)
    {
      stage.scene.lights.clear();
    }
    std::mt19937 random(seed);
    svo::CPUTracer tracer;
    for (int step = 0; step < 24; ++step)
    {
      const svo::Frame frame = rendered(tracer, stage.scene, stage.view, stage.settings);
      svo::CPUTracer fresh;
      const svo::Frame expected = rendered(fresh, stage.scene, stage.view, stage.settings);
      ASSERT_TRUE(identical(expected, frame)) << "seed " << seed << ", step " << step;
      kept += tracer.statistics().shadowRays < fresh.statistics().shadowRays;
      changeAnything(random, stage);
    }
  }
  EXPECT_GT(kept, 24); // of 96 frames; else it says nothing
}

// Where one caster moves only those tiles are shaded anew whose samples it may be met by.
TEST(SoftFrames, ACasterFarFromARayLeavesItAlone)
{
  svo::Instance ball = instanceOf(makeOctree(sphere(12, 16), 5), 0, movedTo(0, 0, 1));
  svo::Scene scene = planeUnder({ ball });
  svo::Light light = lightOf(svo::Light::Kind::Directional, { 0, 0, 1 });
  light.size = 5.0;
  scene.lights = { light };
  const svo::View view = fromAbove(10.0, 10.0, 160, 160);
  svo::FrameSettings settings = sampled(4);
  svo::CPUTracer tracer;
  rendered(tracer, scene, view, settings);
  const std::uint64_t all = tracer.statistics().shadowRays;
  scene.instances[1].localToWorld = movedTo(0.1, 0, 1);
  const svo::Frame frame = rendered(tracer, scene, view, settings);
  EXPECT_LT(tracer.statistics().shadowRays, all / 8);
  EXPECT_GT(tracer.statistics().shadowRays, 0u);
  EXPECT_TRUE(identical(frame, rendered(scene, view, settings)));
}

TEST(SoftFrames, ALightInsideOfACasterIsDark)
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

TEST(SoftFrames, ALightThatTouchesItsReceiver)
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

TEST(SoftFrames, SizesThatAreNone)
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

TEST(SoftFrames, ALightLargerThanTheScene)
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
  svo::makeView(glm::lookAt(at + size * glm::dvec3(3, -6, 4), at, glm::dvec3(0, 0, 1)),
    glm::perspective(
      glm::radians(40.0), double(of.view.width) / of.view.height, 0.1 * size, 100.0 * size),
    of.view.width, of.view.height, stage.view);
  stage.settings.ambientOcclusionDistance *= size;
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
TEST(SoftFrames, PlaceAndScaleDoNotMatter)
{
  Stage stage;
  stage.settings.ambientOcclusionDistance = 1.0;
  const svo::Frame expected = shown(placed(stage, glm::dvec3(0.0), 1.0));
  for (const auto& [at, size] : { std::pair(glm::dvec3(1e7, -1e7, 1e7), 1.0),
         std::pair(glm::dvec3(0.0), 1e-6), std::pair(glm::dvec3(0.0), 1e6),
         std::pair(glm::dvec3(5e6, 0, 0), 1e6), std::pair(glm::dvec3(1, 2, 3), 1e-6) })
  {
    const svo::Frame frame = shown(placed(stage, at, size));
    const std::string name = std::to_string(at.x) + " " + std::to_string(size);
    expectFinite(frame, name);
    EXPECT_LT(meanDifference(expected, frame), 1e-3) << name;
  }
}

// What is closer to a large caster than its own rays begin off it: rays of others do not.
TEST(SoftFrames, WhatLiesCloselyUnderAHugeCasterIsClosedOff)
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
TEST(SoftFrames, ShearedInstances)
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

TEST(SoftFrames, AHundredLights)
{
  Stage one;
  one.settings.ambientOcclusion = false;
  one.settings.lightSamples = 1;
  one.view = lookAt({ 3, -6, 4 }, 40, 32);
  one.scene.lights.resize(1);
  Stage many = one;
  for (int i = 1; i < 100; ++i)
  {
    many.scene.lights.push_back(one.scene.lights[0]);
    many.scene.lights.back().id = 100 + i;
    many.scene.lights.back().size = 0.01 * i;
  }
  for (svo::Light& light : many.scene.lights)
  {
    light.color = glm::vec3(0.01f);
  }
  const svo::Frame few = shown(one), all = shown(many);
  expectFinite(few, "one");
  expectFinite(all, "hundred");
  one.settings.shadowTechnique = svo::ShadowTechnique::None;
  const svo::Frame open = shown(one);
  // One sample is all or nothing; a hundredth of a hundred lights lies between.
  int between = 0;
  for (std::size_t i = 0; i < open.light.size(); ++i)
  {
    EXPECT_LE(all.light[i], open.light[i] * (1.0f + 100 * 6e-8f));
    between += all.light[i] > 0.02f * open.light[i] && all.light[i] < 0.98f * open.light[i];
  }
  EXPECT_GT(between, 50);
}
