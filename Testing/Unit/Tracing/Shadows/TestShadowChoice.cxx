// ShadowTechnique::Automatic: what lights take is one of the two techniques, to the bit, and
// follows from the scene alone.
#include "svoShadowChoice.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

using namespace svotest;

namespace
{
using Technique = svo::ShadowTechnique;
using Kind = svo::Light::Kind;

svo::Scene makeScene(svo::LeafGeometry leaves = svo::LeafGeometry::Automatic)
{
  static const svo::Octree ground = makeOctree(square(3.0), 6);
  static const svo::Octree ball = makeOctree(sphere(24, 40), 7);
  static const svo::Octree ring = makeOctree(torus(40, 24), 7);
  svo::Scene scene;
  scene.instances = { instanceOf(ground, 1, glm::dmat4(1.0), leaves),
    instanceOf(ball, 2, movedTo(-0.8, 0.0, 1.0), leaves),
    instanceOf(ring, 3, movedTo(1.2, 0.3, 0.8), leaves) };
  for (svo::Instance& instance : scene.instances)
  {
    instance.material.specular = 0.5f;
  }
  // Red, green and blue, so that each is what one channel of the picture shows.
  scene.lights = { lightOf(Kind::Point, { 2, -3, 6 }), lightOf(Kind::Directional, { -4, -1, 5 }),
    lightOf(Kind::Spot, { -1, -4, 5 }) };
  for (std::size_t l = 0; l < scene.lights.size(); ++l)
  {
    scene.lights[l].id = 70 + l;
    scene.lights[l].color = glm::vec3(0.0f);
    scene.lights[l].color[static_cast<int>(l)] = 1.0f;
  }
  return scene;
}

const svo::View Eye = lookAt({ 1, -6, 4 }, 160, 120);

svo::FrameSettings settingsOf(Technique technique, int resolution = 256)
{
  svo::FrameSettings settings;
  settings.shadowTechnique = technique;
  settings.shadowResolution = resolution;
  return settings;
}

/// How many lights have rays in an automatic frame.
int raysOf(const svo::Scene& scene, const svo::FrameSettings& settings)
{
  svo::CPUTracer tracer;
  rendered(tracer, scene, Eye, settings);
  const svo::FrameStatistics& statistics = tracer.statistics();
  EXPECT_EQ(statistics.lightsWithBuffers + statistics.lightsWithRays,
    static_cast<int>(scene.lights.size()));
  return statistics.lightsWithRays;
}

/// Of fine maps for a small picture rays are cheaper, of coarse ones buffers are.
constexpr int Fine = 8192, Coarse = 64;
}

TEST(ShadowChoice, OneTechniqueOfAllLightsIsThatTechnique)
{
  const svo::Scene scene = makeScene();
  EXPECT_EQ(raysOf(scene, settingsOf(Technique::Automatic, Fine)), 3);
  EXPECT_EQ(raysOf(scene, settingsOf(Technique::Automatic, Coarse)), 0);
  const svo::Frame rays = rendered(scene, Eye, settingsOf(Technique::Rays, Fine));
  const svo::Frame buffers = rendered(scene, Eye, settingsOf(Technique::Buffer, Coarse));
  ASSERT_FALSE(identical(rays, buffers));
  EXPECT_TRUE(identical(rays, rendered(scene, Eye, settingsOf(Technique::Automatic, Fine))));
  EXPECT_TRUE(identical(buffers, rendered(scene, Eye, settingsOf(Technique::Automatic, Coarse))));
}

TEST(ShadowChoice, MixedLightsAreTheTechniquesAloneLightByLight)
{
  svo::Scene scene = makeScene();
  const svo::Frame pure[] = { rendered(scene, Eye, settingsOf(Technique::Buffer)),
    rendered(scene, Eye, settingsOf(Technique::Rays)) };
  int differ[3] = { 0, 0, 0 };
  for (std::size_t i = 0; i < pure[0].color.size(); ++i)
  {
    if (i % 4 < 3)
    {
      differ[i % 4] += pure[0].color[i] != pure[1].color[i];
    }
  }
  for (const int count : differ)
  {
    EXPECT_GT(count, 10) << "else nothing is told apart";
  }
  svo::CPUTracer keeping;
  svo::Frame kept; // handed in again and again, as a pass does
  for (int mix = 0; mix < 8; ++mix)
  {
    const auto isRays = [mix](std::size_t light) { return (mix >> light & 1) != 0; };
    for (std::size_t l = 0; l < 3; ++l)
    {
      scene.lights[l].shadowTechnique = isRays(l) ? Technique::Rays : Technique::Buffer;
    }
    const svo::FrameSettings settings = settingsOf(Technique::Automatic);
    const svo::Frame mixed = rendered(scene, Eye, settings);
    int wrong = 0;
    for (std::size_t i = 0; i < mixed.color.size(); ++i)
    {
      wrong += mixed.color[i] != pure[i % 4 < 3 && isRays(i % 4)].color[i];
    }
    EXPECT_EQ(wrong, 0) << mix;
    EXPECT_EQ(raysOf(scene, settings), static_cast<int>(isRays(0)) + isRays(1) + isRays(2));
    keeping.render(scene, Eye, settings, svo::serialFor, kept);
    EXPECT_TRUE(identical(mixed, kept)) << mix << ", after another mix";
  }
}

TEST(ShadowChoice, MixedLightsInSmoothedPicturesKeepTheirFilters)
{
  svo::Scene scene = makeScene();
  svo::FrameSettings settings = settingsOf(Technique::Buffer);
  settings.antiAliasing = settings.filterShadows = true;
  svo::FrameSettings byRays = settings;
  byRays.shadowTechnique = Technique::Rays;
  const svo::Frame buffers = rendered(scene, Eye, settings);
  settings.shadowTechnique = Technique::Automatic;
  EXPECT_TRUE(identical(buffers, rendered(scene, Eye, settings))) << "no rays of its own accord";
  for (svo::Light& light : scene.lights)
  {
    light.shadowTechnique = Technique::Rays;
  }
  EXPECT_TRUE(identical(rendered(scene, Eye, byRays), rendered(scene, Eye, settings)));
}

TEST(ShadowChoice, RaysAreTakenOnlyWhereTheyAreExactAndBuffersAreNotNeeded)
{
  const svo::FrameSettings fine = settingsOf(Technique::Automatic, Fine);
  EXPECT_GT(raysOf(makeScene(), fine), 0);
  EXPECT_GT(raysOf(makeScene(svo::LeafGeometry::Triangle), fine), 0);
  EXPECT_EQ(raysOf(makeScene(svo::LeafGeometry::Voxel), fine), 0);
  EXPECT_EQ(raysOf(makeScene(svo::LeafGeometry::Plane), fine), 0);
  svo::FrameSettings other = settingsOf(Technique::Automatic, 2048);
  other.wholeShadowBuffers = true;
  EXPECT_EQ(raysOf(makeScene(), other), 0) << "rasterised surfaces have them";
  other = fine;
  other.automaticBias = false;
  EXPECT_EQ(raysOf(makeScene(), other), 0);
  other = fine;
  other.bias = 1.0;
  EXPECT_EQ(raysOf(makeScene(), other), 0);
}

TEST(ShadowChoice, StillPicturesKnowNothingOfWhatWasShownBefore)
{
  svo::Scene scene = makeScene();
  svo::CPUTracer keeping;
  svo::Frame frame;
  for (int step = 0; step < 8; ++step)
  {
    svo::FrameSettings settings = settingsOf(Technique::Automatic, step % 2 ? Fine : Coarse);
    settings.mayDependOnLastFrame = step % 4 == 2;
    scene.instances[1].localToWorld = movedTo(-0.8 + 0.1 * (step / 3), 0.0, 1.0);
    keeping.render(scene, Eye, settings, svo::serialFor, frame);
    if (!settings.mayDependOnLastFrame)
    {
      EXPECT_TRUE(identical(frame, rendered(scene, Eye, settings))) << step;
    }
  }
}

// A buffer that was there would be kept wherever the camera goes, so in interactive frames one is
// made even where rays are cheaper once.
TEST(ShadowChoice, InteractiveFramesTakeBuffersWhereTheyCanBeKept)
{
  const svo::Scene scene = makeScene();
  svo::FrameSettings settings = settingsOf(Technique::Automatic, 1024);
  svo::CPUTracer tracer;
  const auto raysFrom = [&](double x)
  {
    rendered(tracer, scene, lookAt({ x, -6, 4 }, 160, 120), settings);
    return tracer.statistics().lightsWithRays;
  };
  EXPECT_EQ(raysFrom(1.0), 3);
  EXPECT_EQ(raysFrom(1.1), 3);
  settings.mayDependOnLastFrame = true;
  EXPECT_EQ(raysFrom(1.2), 0);
  settings.mayDependOnLastFrame = false;
  EXPECT_EQ(raysFrom(1.3), 3);
}

TEST(ShadowChoice, WorkIsCounted)
{
  svo::Scene scene = makeScene();
  svo::FrameSettings settings = settingsOf(Technique::Buffer, 512);
  svo::LayeredView eye;
  svo::LayerBudget budget{ std::size_t(1) << 30, 0 };
  eye.prepare(
    scene, Eye, [](const svo::Instance&) { return true; },
    [](const svo::Instance& instance, const svo::LocalView&)
    { return instance.body->octree.level(); },
    true, budget);
  eye.trace(svo::serialFor, nullptr);
  double hits = 0.0;
  const svo::DepthBuffer& depth = eye.depthBuffer();
  for (std::size_t i = 0; i < 64 * depth.tiles(); ++i)
  {
    hits += depth.hit[i / 64] && depth.instance[i] != svo::NoInstance;
  }
  const auto maps = svo::mapsOfLights(svo::outlinesOf(scene), scene.lights, settings, Eye);
  const std::vector<std::uint8_t> none(scene.instances.size(), 0), all(scene.instances.size(), 1);
  const svo::ShadowWork work = svo::shadowWork(scene, Eye, eye, maps[1], none);
  EXPECT_NEAR(work.points, hits, 0.25 * hits);
  EXPECT_EQ(work.freshTexels, 512.0 * 512.0);
  EXPECT_EQ(work.keptTexels, 0.0);
  EXPECT_LE(work.tracedTexels, 3.0 * work.freshTexels);
  EXPECT_GT(work.tracedTexels, 0.0);
  EXPECT_GT(work.seenTriangles, 0.0);
  EXPECT_GT(work.beamPoints, 0.0);
  const svo::ShadowWork kept = svo::shadowWork(scene, Eye, eye, maps[1], all);
  EXPECT_EQ(kept.freshTexels, 0.0);
  EXPECT_EQ(kept.keptTexels, 512.0 * 512.0);
  EXPECT_EQ(kept.tracedTexels, 0.0);
  EXPECT_EQ(kept.seenTriangles, 0.0);
  EXPECT_EQ(kept.beamPoints, work.beamPoints);
  // A finer map has more of all.
  settings.shadowResolution = 1024;
  const auto finer = svo::mapsOfLights(svo::outlinesOf(scene), scene.lights, settings, Eye);
  EXPECT_GT(svo::shadowWork(scene, Eye, eye, finer[1], none).tracedTexels, work.tracedTexels);
}
