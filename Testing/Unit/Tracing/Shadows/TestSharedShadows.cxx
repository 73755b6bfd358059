// Shadow buffers that several processes merge are those of one process with everything.
#include "svoThreadProcesses.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

using namespace svotest;

namespace
{
/// A ground with three balls, one above the other in part.
svo::Scene ballsOnGround()
{
  svo::Scene scene;
  const svo::Octree ball = makeOctree(sphere(40, 64), 7);
  scene.instances = { instanceOf(makeOctree(square(3.0), 7), 1),
    instanceOf(ball, 2, movedTo(0.0, 0.0, 1.2)), instanceOf(ball, 3, movedTo(1.2, -1.0, 1.4)),
    instanceOf(ball, 4, movedTo(-1.5, 0.8, 1.1)) };
  return scene;
}

/// Every `count`th instance.
svo::Scene partOf(const svo::Scene& whole, int self, int count)
{
  svo::Scene part;
  part.lights = whole.lights;
  for (std::size_t i = self; i < whole.instances.size(); i += count)
  {
    part.instances.push_back(whole.instances[i]);
  }
  return part;
}

/// The nearest of the processes' pixels.
svo::Frame composed(const std::vector<svo::Frame>& frames)
{
  svo::Frame picture = frames.front();
  for (const svo::Frame& frame : frames)
  {
    for (std::size_t i = 0; i < frame.depth.size(); ++i)
    {
      if (frame.depth[i] < picture.depth[i])
      {
        picture.depth[i] = frame.depth[i];
        std::copy_n(frame.color.data() + 4 * i, 4, picture.color.data() + 4 * i);
      }
    }
  }
  return picture;
}

svo::FrameSettings smallBuffers()
{
  svo::FrameSettings settings;
  settings.shadowResolution = 256;
  return settings;
}

/// Each process's tracer, which lives from frame to frame.
struct Group
{
  explicit Group(int count)
    : Tracers(count)
    , Frames(count)
  {
  }
  svo::Frame picture(
    const svo::Scene& whole, const svo::View& view, const svo::FrameSettings& settings)
  {
    const int count = static_cast<int>(this->Tracers.size());
    inProcesses(count,
      [&](svo::Processes& processes)
      {
        const int self = processes.self();
        const svo::Scene part = stamped(partOf(whole, self, count));
        EXPECT_TRUE(
          this->Tracers[self].shareShadows(part, view, settings, svo::serialFor, processes));
        this->Tracers[self].render(part, view, settings, svo::serialFor);
        this->Frames[self] = this->Tracers[self].frame();
      });
    return composed(this->Frames);
  }
  std::uint64_t shadowRays() const
  {
    std::uint64_t sum = 0;
    for (const svo::Tracer& tracer : this->Tracers)
    {
      sum += tracer.statistics().shadowRays;
    }
    return sum;
  }
  std::vector<svo::CPUTracer> Tracers;
  std::vector<svo::Frame> Frames;
};

std::size_t differing(const svo::Frame& a, const svo::Frame& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.depth.size(); ++i)
  {
    count +=
      !std::equal(a.color.data() + 4 * i, a.color.data() + 4 * i + 4, b.color.data() + 4 * i);
  }
  return count;
}
}

TEST(SharedShadows, SeveralProcessesHaveThePictureOfOne)
{
  const svo::View eye = lookAt({ 1, -6, 4 }, 160, 120);
  for (const LightCase& test : everyLight())
  {
    svo::Scene scene = ballsOnGround();
    scene.lights = { test.light };
    const svo::Frame expected = rendered(scene, eye, smallBuffers());
    svo::FrameSettings none = smallBuffers();
    none.shadowTechnique = svo::ShadowTechnique::None;
    ASSERT_GT(differing(expected, rendered(scene, eye, none)), 500u) << test.name;
    for (int count : { 1, 2, 3, 5 }) // the last of five has nothing
    {
      Group group(count);
      EXPECT_EQ(differing(group.picture(scene, eye, smallBuffers()), expected), 0u)
        << test.name << ", " << count << " processes";
    }
  }
}

// Translucent casters of all processes, while one of them fades.
TEST(SharedShadows, TranslucentCastersAreThoseOfOneProcess)
{
  const svo::View eye = lookAt({ 1, -6, 4 }, 160, 120);
  for (const LightCase& test : everyLight())
  {
    svo::Scene scene = ballsOnGround();
    scene.lights = { test.light };
    scene.instances.push_back(scene.instances[1]);
    scene.instances.back().id = 5;
    scene.instances.back().localToWorld = movedTo(0.3, 0.2, 3.0);
    for (std::size_t i = 2; i < scene.instances.size(); ++i)
    {
      scene.instances[i].visible = scene.instances[i].receiveShadow = false;
      scene.instances[i].opacity = 0.2f * static_cast<float>(i);
    }
    const svo::Frame opaqueOnly = [&]
    {
      svo::Scene others = scene;
      others.instances.resize(2);
      return rendered(others, eye, smallBuffers());
    }();
    for (int count : { 2, 3 })
    {
      Group group(count);
      for (const float opacity : { 0.3f, 0.7f, 1.0f })
      {
        scene.instances[3].opacity = opacity;
        const svo::Frame expected = rendered(scene, eye, smallBuffers());
        EXPECT_GT(differing(expected, opaqueOnly), 500u) << test.name;
        EXPECT_EQ(differing(group.picture(scene, eye, smallBuffers()), expected), 0u)
          << test.name << ", " << count << " processes, opacity " << opacity;
      }
    }
  }
}

// Maps that are fitted to what is seen are the same on all processes, whoever holds the ground.
TEST(SharedShadows, MapsOfAVastGroundAreFittedAlike)
{
  svo::Scene scene = ballsOnGround();
  Mesh ground = square(2000.0);
  ground.points.push_back({ 0.0, 0.0, -5.0 }); // no flat one, which would not cast
  ground.triangles.push_back({ 0, 1, 4 });
  scene.instances[0] = instanceOf(makeOctree(ground, 7), 1);
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 2, -2, 5 }) };
  Group group(3);
  std::vector<svo::View> eyes{ lookAt({ 1, -6, 4 }, 160, 120), lookAt({ 6, -4, 4 }, 160, 120) };
  for (int step = 1; step < 8; ++step) // maps that stay, of which other parts are seen
  {
    eyes.push_back(lookAt({ 6.0 - 0.1 * step, -4, 4 }, 160, 120, 40.0, { 0.4 * step, 0, 0 }));
  }
  for (const svo::View& eye : eyes)
  {
    const svo::Frame expected = rendered(scene, eye, smallBuffers());
    svo::FrameSettings none = smallBuffers();
    none.shadowTechnique = svo::ShadowTechnique::None;
    ASSERT_GT(differing(expected, rendered(scene, eye, none)), 300u);
    EXPECT_EQ(differing(group.picture(scene, eye, smallBuffers()), expected), 0u);
  }
}

TEST(SharedShadows, AreKeptWhileNoProcessChangesAnything)
{
  svo::Scene scene = ballsOnGround();
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 2, -2, 5 }) };
  Group group(3);
  const svo::FrameSettings settings = smallBuffers();
  group.picture(scene, lookAt({ 1, -6, 4 }, 160, 120), settings);
  EXPECT_GT(group.shadowRays(), 0u);

  const svo::View turned = lookAt({ 3, -5, 4 }, 160, 120);
  EXPECT_EQ(
    differing(group.picture(scene, turned, settings), rendered(scene, turned, settings)), 0u);
  EXPECT_EQ(group.shadowRays(), 0u);

  // How points are tested is no matter of what is traced.
  svo::FrameSettings others = settings;
  others.automaticBias = false;
  others.bias = 6.0;
  EXPECT_EQ(differing(group.picture(scene, turned, others), rendered(scene, turned, others)), 0u);
  EXPECT_EQ(group.shadowRays(), 0u);
  others = settings;
  others.filterShadows = true;
  EXPECT_EQ(differing(group.picture(scene, turned, others), rendered(scene, turned, others)), 0u);
  EXPECT_EQ(group.shadowRays(), 0u);

  // Of a process that is not the ground's.
  scene.instances[1].localToWorld = movedTo(0.5, 0.5, 1.6);
  EXPECT_EQ(
    differing(group.picture(scene, turned, settings), rendered(scene, turned, settings)), 0u);
  EXPECT_GT(group.shadowRays(), 0u);

  scene.lights[0].direction = glm::normalize(glm::dvec3(1, 1, -3));
  EXPECT_EQ(
    differing(group.picture(scene, turned, settings), rendered(scene, turned, settings)), 0u);

  scene.instances[1].castShadow = false;
  EXPECT_EQ(
    differing(group.picture(scene, turned, settings), rendered(scene, turned, settings)), 0u);

  // One of them forgets: all trace again, and none waits for ever.
  group.Tracers[2].releaseLayers();
  EXPECT_EQ(
    differing(group.picture(scene, turned, settings), rendered(scene, turned, settings)), 0u);
  EXPECT_GT(group.shadowRays(), 0u);
}

TEST(SharedShadows, AProcessWithoutInstancesHasTheWholeMaps)
{
  svo::Scene scene = ballsOnGround();
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 2, -2, 5 }) };
  svo::FrameSettings settings = smallBuffers();
  settings.wholeShadowBuffers = true; // rasterised receivers
  const svo::View eye = lookAt({ 1, -6, 4 }, 160, 120);
  svo::CPUTracer one;
  rendered(one, scene, eye, settings);
  Group group(5);
  group.picture(scene, eye, settings);
  ASSERT_EQ(one.shadowMaps().size(), 1u);
  ASSERT_EQ(group.Tracers[4].shadowMaps().size(), 1u);
  const svo::ShadowMap& expected = one.shadowMaps()[0];
  const svo::ShadowMap& found = group.Tracers[4].shadowMaps()[0];
  EXPECT_EQ(found.worldBias, expected.worldBias);
  std::size_t casters = 0;
  for (int i = 0; i < expected.view.width * expected.view.height; ++i)
  {
    const int x = i % expected.view.width, y = i / expected.view.width;
    const float depth = expected.texels->depthAt(x, y);
    casters += depth < 1e30f;
    ASSERT_TRUE(
      found.texels->depthAt(x, y) == depth || std::abs(found.texels->depthAt(x, y) - depth) < 1e-6f)
      << i;
  }
  EXPECT_GT(casters, 1000u);
}

TEST(SharedShadows, TheFirstProcessSaysHowManyTexelsThereAre)
{
  svo::Scene scene = ballsOnGround();
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 2, -2, 5 }) };
  const svo::View eye = lookAt({ 1, -6, 4 }, 160, 120);
  inProcesses(2,
    [&](svo::Processes& processes)
    {
      // As where rays are further apart to save time, which each process measures for itself.
      svo::FrameSettings settings = smallBuffers();
      settings.shadowResolution = processes.self() == 0 ? 128 : 256;
      const svo::Scene part = partOf(scene, processes.self(), 2);
      svo::CPUTracer tracer;
      EXPECT_TRUE(tracer.shareShadows(part, eye, settings, svo::serialFor, processes));
      tracer.render(part, eye, settings, svo::serialFor);
      EXPECT_FALSE(tracer.statistics().fewerTexels) << "none is missing for lack of memory";
    });
}

// Where some process has rasterised receivers the maps take more memory, of which the others do not
// know.
TEST(SharedShadows, ProcessesAgreeOnFewerTexels)
{
  svo::Scene scene = ballsOnGround();
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 2, -2, 5 }) };
  const svo::View eye = lookAt({ 1, -6, 4 }, 160, 120);
  inProcesses(2,
    [&](svo::Processes& processes)
    {
      svo::FrameSettings settings = smallBuffers();
      settings.shadowMemoryLimit = 16 * 256 * 256; // enough without receivers
      settings.wholeShadowBuffers = processes.self() == 0;
      const svo::Scene part = partOf(scene, processes.self(), 2);
      svo::CPUTracer tracer;
      EXPECT_TRUE(tracer.shareShadows(part, eye, settings, svo::serialFor, processes));
      tracer.render(part, eye, settings, svo::serialFor);
      EXPECT_TRUE(tracer.statistics().fewerTexels) << processes.self();
    });
}

// What has changed is found once, when shadows are shared, and told to the frame that is drawn
// next, of which objects may be gone.
TEST(SharedShadows, WhatHasChangedIsToldToTheNextFrame)
{
  svo::Scene scene = ballsOnGround();
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 2, -2, 5 }) };
  svo::Scene fewer = scene, moved = scene, away = scene;
  fewer.instances.resize(2);
  moved.instances[2].localToWorld = movedTo(0.5, -1.5, 1.6);
  away.instances[2].localToWorld = movedTo(-40.0, 0.0, 1.6);
  struct Step
  {
    const svo::Scene* scene;
    bool shared, drawn;
  };
  const Step steps[] = { { &scene, true, true }, { &scene, true, false }, { &fewer, true, true },
    { &moved, true, false }, { &fewer, true, true }, { &scene, false, true },
    { &moved, true, true }, { &moved, false, true }, { &away, false, true } };
  const svo::View eye = lookAt({ 1, -6, 4 }, 160, 120);
  for (const svo::ShadowTechnique technique :
    { svo::ShadowTechnique::Buffer, svo::ShadowTechnique::Rays })
  {
    svo::FrameSettings settings = smallBuffers();
    settings.shadowTechnique = technique;
    inProcesses(2,
      [&](svo::Processes& processes)
      {
        svo::CPUTracer tracer;
        for (const Step& step : steps)
        {
          const svo::Scene mine = stamped(partOf(*step.scene, processes.self(), 2));
          svo::CPUTracer other;
          for (svo::CPUTracer* const one : { &tracer, &other })
          {
            if (step.shared)
            {
              one->shareShadows(mine, eye, settings, svo::serialFor, processes);
            }
          }
          if (step.drawn)
          {
            EXPECT_TRUE(identical(
              rendered(tracer, mine, eye, settings), rendered(other, mine, eye, settings)))
              << &step - steps << ", process " << processes.self();
          }
        }
      });
  }
}

TEST(SharedShadows, ProcessesThatDisagreeAboutTheLightsKeepTheirOwn)
{
  svo::Scene scene = ballsOnGround();
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 2, -2, 5 }) };
  const svo::View eye = lookAt({ 1, -6, 4 }, 160, 120);
  inProcesses(2,
    [&](svo::Processes& processes)
    {
      svo::Scene part = partOf(scene, processes.self(), 2);
      if (processes.self() == 1)
      {
        part.lights.clear();
      }
      svo::CPUTracer tracer;
      EXPECT_FALSE(
        tracer.shareShadows(part, svo::View(), smallBuffers(), svo::serialFor, processes));
      EXPECT_TRUE(identical(
        rendered(tracer, part, eye, smallBuffers()), rendered(part, eye, smallBuffers())));
    });
}
