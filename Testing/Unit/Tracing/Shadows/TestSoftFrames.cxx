// Frames with soft shadows and ambient occlusion have the same bits however they are made.
#include "svoInstructionSets.h"
#include "svoRandomScenes.h"
#include "svoSoftStage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace svotest;

namespace
{
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
  const unsigned steps = scenesOr(12);
  unsigned kept = 0;
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
    for (unsigned step = 0; step < steps; ++step)
    {
      const svo::Frame frame = rendered(tracer, stage.scene, stage.view, stage.settings);
      svo::CPUTracer fresh;
      const svo::Frame expected = rendered(fresh, stage.scene, stage.view, stage.settings);
      ASSERT_TRUE(identical(expected, frame)) << "seed " << seed << ", step " << step;
      kept += tracer.statistics().shadowRays < fresh.statistics().shadowRays;
      changeAnything(random, stage);
    }
  }
  EXPECT_GT(kept, steps); // of four times as many frames; else it says nothing
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
