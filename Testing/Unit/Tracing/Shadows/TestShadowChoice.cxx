// ShadowTechnique::Automatic: what lights take is one of the two techniques, to the bit: their own,
// or buffers.
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

svo::Scene makeScene()
{
  svo::Scene scene = ballRingAndGround();
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

}

TEST(ShadowChoice, LightsThatNameNoTechniqueHaveBuffers)
{
  const svo::Scene scene = makeScene();
  for (const int resolution : { 64, 8192 }) // rays are quicker than such fine maps
  {
    EXPECT_EQ(raysOf(scene, settingsOf(Technique::Automatic, resolution)), 0);
    EXPECT_TRUE(identical(rendered(scene, Eye, settingsOf(Technique::Buffer, resolution)),
      rendered(scene, Eye, settingsOf(Technique::Automatic, resolution))));
  }
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
