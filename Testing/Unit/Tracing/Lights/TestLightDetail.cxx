// Shadows of small things on vast grounds that cast shadows themselves: by buffers as by rays,
// because the maps are fitted to what is seen; and maps that stay as they are where that is not
// needed.
#include "svoLightDetail.h"
#include "svoLightView.h"
#include "svoShadowBuffer.h"
#include "svoTestTracers.h"
#include "svoTexelPlace.h"
#include "svoTracerScenes.h"
#include "svoWorldSize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <set>
#include <string>

using namespace svotest;

namespace
{
const svo::View Eye = lookAt({ 0, -6, 4 }, 200, 150);

/// A square with bumps a tenth high, which is enough to make it a caster.
Mesh bumpy(double half)
{
  constexpr int Cells = 60;
  Mesh mesh;
  for (int y = 0; y <= Cells; ++y)
  {
    for (int x = 0; x <= Cells; ++x)
    {
      const double px = half * (2.0 * x / Cells - 1.0), py = half * (2.0 * y / Cells - 1.0);
      mesh.points.push_back({ px, py, 0.05 * (std::sin(0.7 * px) * std::cos(0.9 * py) - 1.0) });
    }
  }
  for (unsigned y = 0; y < Cells; ++y)
  {
    for (unsigned x = 0; x < Cells; ++x)
    {
      const unsigned a = y * (Cells + 1) + x, b = a + 1, c = a + Cells + 1, d = c + 1;
      mesh.triangles.push_back({ a, b, d });
      mesh.triangles.push_back({ a, d, c });
    }
  }
  return mesh;
}

svo::Scene ballAbove(const Mesh& ground)
{
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(ground, 8), 1),
    instanceOf(makeOctree(sphere(40, 64), 7), 2,
      movedTo(0.0, 0.0, 0.8) * glm::scale(glm::dmat4(1.0), glm::dvec3(0.5))) };
  return scene;
}

std::vector<LightCase> lights()
{
  using Kind = svo::Light::Kind;
  return { { "sun", lightOf(Kind::Directional, { 3, -2, 5 }) },
    { "bulb", lightOf(Kind::Point, { 3, -2, 5 }) },
    { "bulb far away", lightOf(Kind::Point, { 3e4, -2e4, 5e4 }) },
    { "spot", lightOf(Kind::Spot, { 3, -2, 5 }) } };
}

svo::Frame rendered(const svo::Scene& scene, svo::ShadowTechnique technique)
{
  svo::FrameSettings settings;
  settings.shadowTechnique = technique;
  svo::CPUTracer tracer;
  return svotest::rendered(tracer, scene, Eye, settings);
}

struct Comparison
{
  int dark = 0;  // by rays
  int wrong = 0; // by buffers
};

Comparison compare(const svo::Scene& scene)
{
  const svo::Frame lit = rendered(scene, svo::ShadowTechnique::None);
  const svo::Frame buffer = rendered(scene, svo::ShadowTechnique::Buffer);
  const svo::Frame rays = rendered(scene, svo::ShadowTechnique::Rays);
  Comparison found;
  for (std::size_t p = 0; p < lit.instance.size(); ++p)
  {
    found.dark += lit.color[4 * p] - rays.color[4 * p] > 8;
    found.wrong += std::abs(buffer.color[4 * p] - rays.color[4 * p]) > 8;
  }
  return found;
}

void expectShadows(const svo::Scene& ground, const std::string& name)
{
  for (const LightCase& test : lights())
  {
    svo::Scene scene = ground;
    scene.lights = { test.light };
    const Comparison found = compare(scene);
    std::printf("%s, %s: %d dark pixels, %d wrong\n", name.c_str(), test.name.c_str(), found.dark,
      found.wrong);
    EXPECT_GT(found.dark, 300) << name << ", " << test.name;
    EXPECT_LE(found.wrong, found.dark / 20) << name << ", " << test.name;
  }
}
}

TEST(LightDetail, ABallOnAVastBumpyGroundHasItsShadow)
{
  for (const double half : { 20.0, 200.0, 600.0, 1e4, 1e5 })
  {
    expectShadows(ballAbove(bumpy(half)), "bumpy, " + std::to_string(half));
  }
}

// A million times as wide as the ball.
TEST(LightDetail, ABallOnAnEndlessFlatGroundHasItsShadow)
{
  expectShadows(ballAbove(square(1e4)), "flat, 1e4");
  const Comparison found = []
  {
    svo::Scene scene = ballAbove(square(5e5));
    scene.lights = { lightOf(svo::Light::Kind::Directional, { 3, -2, 5 }) };
    return compare(scene);
  }();
  EXPECT_GT(found.dark, 300);
  EXPECT_LE(found.wrong, found.dark / 5); // floats resolve a tenth of the ball on that ground
}

TEST(LightDetail, MapsOfOrdinaryScenesAreThoseOfTheirCasters)
{
  for (const LightCase& test : everyLight())
  {
    const auto outlines = svo::outlinesOf(ballAbove(bumpy(5.0)));
    const svo::LightMaps maps = svo::mapsOfLight(outlines, test.light, 2048, Eye);
    const auto fitted = svo::fitLight(outlines, maps.casters, test.light, 2048);
    ASSERT_EQ(maps.views.size(), fitted.size()) << test.name;
    for (std::size_t i = 0; i < fitted.size(); ++i)
    {
      EXPECT_EQ(maps.views[i].viewToClip, fitted[i].viewToClip) << test.name;
    }
    EXPECT_EQ(maps.coarsest, 0.0) << test.name;
  }
}

TEST(LightDetail, MapsAreNoFinerThanPixelsAndFew)
{
  for (const double half : { 200.0, 1e4, 1e6 })
  {
    for (const LightCase& test : lights())
    {
      const auto outlines = svo::outlinesOf(ballAbove(bumpy(half)));
      const svo::LightMaps maps = svo::mapsOfLight(outlines, test.light, 2048, Eye);
      EXPECT_LE(maps.views.size(), 11u) << test.name;
      EXPECT_LE(maps.coarsest, 16.0) << test.name << ", " << half;
    }
  }
}

// Most small steps of the eye leave the maps as they are, and what was traced through them; others
// look at another part of the same ones.
TEST(LightDetail, MapsChangeNowAndThenOnlyWhenTheEyeMoves)
{
  const auto outlines = svo::outlinesOf(ballAbove(bumpy(600.0)));
  for (const LightCase& test : lights())
  {
    SCOPED_TRACE(test.name);
    int others = 0, moved = 0;
    svo::LightMaps last = svo::mapsOfLight(outlines, test.light, 2048, Eye);
    for (int i = 1; i <= 100; ++i)
    {
      const svo::View eye = lookAt({ 0.01 * i, -6, 4 }, 200, 150);
      const svo::LightMaps maps = svo::mapsOfLight(outlines, test.light, 2048, eye);
      for (const svo::View& view : maps.views)
      {
        const auto among = [&](bool (*same)(const svo::View&, const svo::View&))
        {
          return std::any_of(last.views.begin(), last.views.end(),
            [&](const svo::View& before) { return same(before, view); });
        };
        others += !among(svo::sameImage);
        moved += among(svo::sameImage) && !among(svo::sameRays);
      }
      last = maps;
    }
    EXPECT_LT(others, 20);
    EXPECT_LT(moved, 50);
  }
}

// Wherever the eye sees a receiver one of the maps has the point.
TEST(LightDetail, MapsHoldAllThatIsSeen)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const double half : { 200.0, 1e4 })
  {
    const auto outlines = svo::outlinesOf(ballAbove(bumpy(half)));
    for (const LightCase& test : lights())
    {
      SCOPED_TRACE(test.name + ", " + std::to_string(half));
      int crops = 0, points = 0, missing = 0;
      for (int i = 0; i < 20; ++i)
      {
        const svo::View eye =
          lookAt({ 8.0 * unit(random), -6, 1.0 + 5.0 * unit(random) }, 200, 150, 60.0);
        const svo::LightMaps maps = svo::mapsOfLight(outlines, test.light, 2048, eye);
        const auto fitted = svo::fitLight(outlines, maps.casters, test.light, 2048);
        const auto holds = [](const std::vector<svo::View>& views, const glm::dvec3& point)
        {
          return std::any_of(views.begin(), views.end(),
            [&](const svo::View& view)
            { return svo::texelPlace(svo::MapGeometry(view), point).inside > 0.0; });
        };
        for (const svo::View& view : maps.views)
        {
          crops += view.crop.x1 - view.crop.x0 < view.width;
        }
        for (int k = 0; k < 500; ++k)
        {
          // On the ground, where the eye's ray meets it.
          const double x = eye.width * unit(random), y = eye.height * unit(random);
          const glm::dvec3 from = eye.rayOrigin(x, y), along = eye.rayDirection(x, y);
          const double t = -from.z / along.z;
          const glm::dvec3 point = from + t * along;
          if (t > eye.tNear && t < eye.tFar && std::abs(point.x) < half &&
            std::abs(point.y) < half && holds(fitted, point))
          {
            ++points;
            missing += !holds(maps.views, point);
          }
        }
      }
      EXPECT_GT(points, 3000);
      EXPECT_TRUE(crops > 19 || test.light.kind == svo::Light::Kind::Spot);
      EXPECT_EQ(missing, 0);
    }
  }
}

// What is kept of maps while the eye walks is what would be traced anew, to the bit; so are the
// copies that rasterised receivers look up.
TEST(LightDetail, PicturesOfAWalkHangOnNoFrameBefore)
{
  svo::FrameSettings seen, whole;
  seen.shadowResolution = 400;
  whole.wholeShadowBuffers = true;
  whole.filterShadows = true;
  whole.shadowResolution = 301; // the last tiles of a crop reach beyond it
  for (const svo::FrameSettings& settings : { seen, whole })
  {
    for (const LightCase& test : lights())
    {
      SCOPED_TRACE(test.name);
      svo::Scene scene = ballAbove(bumpy(600.0));
      scene.lights = { test.light };
      svo::CPUTracer kept;
      std::uint64_t keptTexels = 0, texels = 0;
      std::set<std::size_t> counts;
      for (int i = 0; i < 10; ++i)
      {
        const svo::View eye =
          lookAt({ 0.07 * i, -6, 4 - 0.1 * i }, 200, 150, 40.0, { 0.3 * i, 0.05 * i, 0 });
        svo::CPUTracer fresh;
        const svo::Frame a = svotest::rendered(kept, scene, eye, settings);
        const svo::Frame b = svotest::rendered(fresh, scene, eye, settings);
        ASSERT_EQ(a.color, b.color) << i;
        ASSERT_EQ(a.depth, b.depth) << i;
        const auto &copies = kept.shadowMaps(), &expected = fresh.shadowMaps();
        ASSERT_EQ(copies.size(), expected.size());
        ASSERT_EQ(copies.empty(), !settings.wholeShadowBuffers);
        for (std::size_t m = 0; m < copies.size(); ++m)
        {
          ASSERT_EQ(copies[m].view.width, settings.shadowResolution);
          ASSERT_TRUE(svo::sameRays(copies[m].view, expected[m].view));
          ASSERT_EQ(copies[m].texels->tiles, expected[m].texels->tiles) << i << ", " << m;
          ASSERT_EQ(copies[m].texels->numbers, expected[m].texels->numbers) << i << ", " << m;
        }
        counts.insert(copies.size());
        keptTexels += kept.statistics().shadowRays;
        texels += fresh.statistics().shadowRays;
      }
      std::printf("%s: %llu of %llu texels traced, %zu counts of maps\n", test.name.c_str(),
        static_cast<unsigned long long>(keptTexels), static_cast<unsigned long long>(texels),
        counts.size());
      EXPECT_GT(keptTexels, 0u);
      EXPECT_LT(keptTexels, texels * 3 / 4);
    }
  }
}

// A map of all that is seen has wide texels, and a level of detail of the ball that is off by as
// much; a finer one, where points near the eye are looked up, has not.
TEST(LightDetail, WhatACasterIsOffByIsItsMapsOwn)
{
  svo::Scene scene = ballAbove(bumpy(600.0));
  scene.instances[1].body.own().octree = makeOctree(sphere(200, 300), 8);
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 3, -2, 5 }) };
  const svo::FrameSettings settings;
  const svo::LightMaps maps =
    svo::mapsOfLight(svo::outlinesOf(scene), scene.lights[0], settings.shadowResolution, Eye);
  ASSERT_GT(maps.views.size(), 1u);
  svo::ShadowBuffer buffer;
  svo::LayerBudget budget;
  buffer.prepare(scene, maps, 0, settings, budget);
  const svo::TracedMap &fine = *buffer.maps().maps.front(), &wide = *buffer.maps().maps.back();
  ASSERT_TRUE(fine.seesCasters && wide.seesCasters);
  EXPECT_GT(wide.casterError[1], 0.1 * svo::worldPixel(wide.view, 0.0));
  EXPECT_LT(fine.casterError[1], 0.1 * wide.casterError[1]);
}

// Of maps of a part of a scene only what casters can lie in counts.
TEST(LightDetail, FewTexelsOfManyFitIntoTheLimit)
{
  svo::Scene scene = ballAbove(bumpy(2000.0));
  scene.instances[0].castShadow = false;
  scene.instances.push_back(scene.instances[1]);
  scene.instances[2].localToWorld[3].x += 1500.0;
  const auto outlines = svo::outlinesOf(scene);
  svo::FrameSettings settings;
  settings.shadowResolution = 4096;
  const std::vector<svo::Light> sun{ lightOf(svo::Light::Kind::Directional, { 3, -2, 5 }) };
  settings.shadowMemoryLimit = std::size_t(1) << 40;
  const std::size_t views = svo::mapsOfLights(outlines, sun, settings, Eye).front().views.size();
  settings.shadowMemoryLimit = views * 4096 * 4096 * 3; // bytes; all texels would take four times
  const svo::LightMaps maps = svo::mapsOfLights(outlines, sun, settings, Eye).front();
  ASSERT_EQ(maps.views.size(), views);
  EXPECT_GT(maps.views.front().width, 4096);
  EXPECT_EQ(maps.views.front().crop.x1 - maps.views.front().crop.x0, 4096);
}

// Two lights with maps of 16384 texels and receivers would take 10 GiB.
TEST(LightDetail, MapsOfAllLightsAreLimitedTogether)
{
  const auto outlines = svo::outlinesOf(ballAbove(bumpy(5.0)));
  const auto widthOf = [&](int resolution, std::size_t count, bool receivers)
  {
    svo::FrameSettings settings;
    settings.shadowResolution = resolution;
    settings.wholeShadowBuffers = receivers;
    const std::vector<svo::Light> suns(count, lightOf(svo::Light::Kind::Directional, { 3, -2, 5 }));
    const auto maps = svo::mapsOfLights(outlines, suns, settings, Eye);
    EXPECT_EQ(maps.size(), count);
    return maps.back().views.front().width;
  };
  EXPECT_EQ(widthOf(16384, 1, false), 16384);
  EXPECT_EQ(widthOf(16384, 2, false), 8192);
  EXPECT_EQ(widthOf(16384, 2, true), 8192);
  EXPECT_EQ(widthOf(16384, 100, true), 1024);
  EXPECT_EQ(widthOf(2048, 40, true), 2048);

  svo::Scene scene = ballAbove(bumpy(5.0));
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 3, -2, 5 }) };
  svo::FrameSettings settings;
  settings.shadowMemoryLimit = 12 * 1024 * 1024;
  svo::CPUTracer tracer;
  svotest::rendered(tracer, scene, Eye, settings);
  EXPECT_TRUE(tracer.statistics().fewerTexels);
  settings.shadowMemoryLimit = svo::FrameSettings().shadowMemoryLimit;
  svotest::rendered(tracer, scene, Eye, settings);
  EXPECT_FALSE(tracer.statistics().fewerTexels);
}

// Of what is seen: an octree's cube may be many times as large as its surface, and reach to the
// eye.
TEST(LightDetail, GapsAreThoseOfWhatIsSeen)
{
  const auto gapOf = [](const svo::Octree& octree, const svo::View& eye)
  {
    svo::Scene scene;
    scene.instances = { instanceOf(octree, 1) };
    scene.lights = { lightOf(svo::Light::Kind::Directional, { 3, -2, 5 }) };
    svo::CPUTracer tracer;
    svotest::rendered(tracer, scene, eye, {});
    return tracer.statistics().largestGap;
  };
  const svo::Octree octree = makeOctree(square(5.0), 6);
  auto& h = const_cast<svo::Header&>(octree.header()); // what sources fill in
  h.pointCount = 4;
  const double bounds[] = { -5.0, 5.0, -5.0, 5.0, 0.0, 0.0 };
  std::copy_n(bounds, 6, h.meshBounds);
  ASSERT_GT(h.origin[2] + h.voxelSize * 64.0, 3.0);
  const auto worldGap = [&](double height)
  {
    const svo::View eye = lookAt({ 0, -1e-3, height }, 200, 150);
    return gapOf(octree, eye) * svo::worldPixel(eye, height);
  };
  const double far = worldGap(30.0);
  EXPECT_GT(far, 0.0);
  EXPECT_NEAR(worldGap(3.0) / far, 1.0, 0.01); // within the cube
}
