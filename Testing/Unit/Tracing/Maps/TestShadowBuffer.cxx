// A shadow buffer's maps: what is traced of them, kept, and handed out.
#include "svoBallOnGround.h"

#include "svoCasters.h"

#include <gtest/gtest.h>

using namespace svotest;

TEST(ShadowBuffer, WholeBuffersGiveTheSameBitsAndAreHandedOut)
{
  for (const LightCase& c : everyLight())
  {
    svo::Scene scene = ballOnGround(svo::LeafGeometry::Automatic, 6);
    scene.lights = { c.light };
    svo::FrameSettings settings = settingsOf(svo::ShadowTechnique::Buffer);
    settings.shadowResolution = 64;
    svo::CPUTracer tracer;
    const svo::Frame marked = rendered(tracer, scene, Eye, settings);
    EXPECT_TRUE(tracer.shadowMaps().empty());
    settings.wholeShadowBuffers = true;
    svo::CPUTracer whole;
    EXPECT_TRUE(identical(marked, rendered(whole, scene, Eye, settings))) << c.name;
    const std::size_t faces = c.name == "point, six faces" ? 6 : 1;
    ASSERT_GE(whole.shadowMaps().size(), faces);
    ASSERT_LE(whole.shadowMaps().size(), faces + 5); // further ones where texels look wide
    int occupied = 0;
    for (const svo::ShadowMap& map : whole.shadowMaps())
    {
      EXPECT_EQ(map.light, 0);
      for (float depth : map.texels->numbers)
      {
        occupied += std::isfinite(depth) && depth >= 0.0f;
      }
    }
    EXPECT_GT(occupied, 500) << c.name;
  }
}

// Who sends them to a GPU tells by the object whether they are others than last time.
TEST(ShadowBuffer, MapsAreKeptAsLongAsNothingTheyShowChanges)
{
  for (const LightCase& c : everyLight())
  {
    svo::Scene scene = ballOnGround(svo::LeafGeometry::Automatic, 6);
    scene.lights = { c.light };
    svo::FrameSettings settings = settingsOf(svo::ShadowTechnique::Buffer);
    settings.shadowResolution = 256; // so that none is fitted to what is seen
    settings.wholeShadowBuffers = true;
    svo::CPUTracer tracer;
    const auto shown = [&](const svo::View& eye)
    {
      svo::CPUTracer fresh;
      const svo::Frame expected = rendered(fresh, scene, eye, settings);
      EXPECT_TRUE(identical(expected, rendered(tracer, scene, eye, settings))) << c.name;
      const std::vector<svo::ShadowMap> maps = tracer.shadowMaps();
      EXPECT_EQ(maps.size(), fresh.shadowMaps().size());
      for (std::size_t i = 0; i < maps.size(); ++i)
      {
        const svo::ShadowTexels &kept = *maps[i].texels, &anew = *fresh.shadowMaps()[i].texels;
        EXPECT_EQ(kept.tiles, anew.tiles) << c.name;
        EXPECT_EQ(kept.numbers, anew.numbers) << c.name;
      }
      return maps.front().texels;
    };
    const svo::View aside = lookAt({ 1, -7, 4 }, 160, 120);
    const auto first = shown(Eye);
    EXPECT_EQ(shown(aside), first) << c.name << ": the eye moves";
    EXPECT_EQ(shown(Eye), first);
    const svo::Scene both = scene;
    scene.instances.erase(scene.instances.begin());
    const auto without = shown(Eye);
    EXPECT_NE(without, first) << c.name << ": a caster goes";
    EXPECT_EQ(shown(aside), without);
    scene = both;
    EXPECT_NE(shown(Eye), without) << c.name << ": it comes back";
    scene.instances.back().localToWorld[3].z += 0.1;
    EXPECT_NE(shown(Eye), first) << c.name << ": one moves";
    shown(Eye);
    tracer.releaseLayers();
    shown(Eye);
    settings.frameCoherence = false;
    shown(aside);
    shown(Eye);
  }
}

TEST(ShadowBuffer, OnlyTilesThatAreLookedUpAreTraced)
{
  svo::Scene scene = ballOnGround(svo::LeafGeometry::Automatic, 6);
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 2, -2, 5 }) };
  svo::FrameSettings settings = settingsOf(svo::ShadowTechnique::Buffer);
  const svo::View corner = lookAt({ 1, -6, 4 }, 64, 48, 5.0, { -1.5, -2, 0 });
  svo::CPUTracer tracer;
  rendered(tracer, scene, corner, settings);
  const std::uint64_t marked = tracer.statistics().shadowRays;
  settings.wholeShadowBuffers = true;
  svo::CPUTracer whole;
  rendered(whole, scene, corner, settings);
  EXPECT_GT(marked, 0u);
  EXPECT_LT(marked, whole.statistics().shadowRays / 10);
}

TEST(ShadowBuffer, TheSwitchesOfInstancesAndLightsAreHeeded)
{
  svo::Scene scene = ballOnGround(svo::LeafGeometry::Triangle, 6);
  scene.lights = { lightOf(svo::Light::Kind::Point, { 2, -2, 9 }) };
  const svo::FrameSettings settings = settingsOf(svo::ShadowTechnique::Buffer);
  const svo::Frame none = rendered(scene, Eye, settingsOf(svo::ShadowTechnique::None));
  EXPECT_NE(rendered(scene, Eye, settings).color, none.color);
  scene.lights[0].castShadow = false;
  EXPECT_EQ(rendered(scene, Eye, settings).color, none.color);
  scene.lights[0].castShadow = true;
  svo::FrameSettings faint = settings;
  faint.shadowIntensity = 0.0;
  EXPECT_EQ(rendered(scene, Eye, faint).color, none.color);
  scene.instances[0].receiveShadow = false;
  scene.instances[1].receiveShadow = false;
  EXPECT_EQ(rendered(scene, Eye, settings).color, none.color);
}

TEST(ShadowBuffer, AGroundCastsOnlyIfSomethingCanLieInItsShadow)
{
  svo::Scene scene = ballOnGround(svo::LeafGeometry::Triangle, 6);
  const svo::Light sun = lightOf(svo::Light::Kind::Directional, { 2, -2, 5 });
  const auto casters = [&]
  {
    std::vector<svo::Outline> outlines = svo::outlinesOf(scene);
    for (int i = 0; i < 3; ++i) // octrees that are made without a vtkPolyData do not know its box
    {
      outlines[0].mesh.high[i] = i < 2 ? 3.0 : 0.0;
      outlines[0].mesh.low[i] = -outlines[0].mesh.high[i];
      outlines[1].mesh.high[i] = 1.0;
      outlines[1].mesh.low[i] = -1.0;
    }
    return svo::castersOf(outlines, sun);
  };
  EXPECT_EQ(casters(), (std::vector<std::uint8_t>{ 0, 1 }));
  // Rasterised surfaces on the ground and above it change nothing,
  scene.receivers = { { { -1, -1, 0 }, { 1, 1, 2 } }, { { 5, 5, 7 }, { 6, 6, 9 } } };
  EXPECT_EQ(casters(), (std::vector<std::uint8_t>{ 0, 1, 0, 0 }));
  // one that reaches below it does,
  scene.receivers.push_back({ { 5, 5, -1 }, { 6, 6, 9 } });
  EXPECT_EQ(casters(), (std::vector<std::uint8_t>{ 1, 1, 0, 0, 0 }));
  // and so does one that may be anywhere.
  const double infinity = std::numeric_limits<double>::infinity();
  scene.receivers = { { glm::dvec3(-infinity), glm::dvec3(infinity) } };
  EXPECT_EQ(casters(), (std::vector<std::uint8_t>{ 1, 1, 0 }));
}
