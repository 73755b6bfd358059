// Shadows of small things on vast grounds that cast shadows themselves: by buffers as by rays,
// because the maps are fitted to what is seen; and maps that stay as they are where that is not
// needed.
#include "svoConvexParts.h"
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

/// Corner i at the upper ends that its bits say.
svo::ConvexBody box(const glm::dvec3& low, const glm::dvec3& high)
{
  svo::ConvexBody body;
  for (int i = 0; i < 8; ++i)
  {
    body[i] = { i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z };
  }
  return body;
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
  svo::FrameSettings whole;
  whole.wholeShadowBuffers = true;
  whole.filterShadows = true;
  whole.shadowResolution = 501; // the last tiles of a crop reach beyond it
  for (const svo::FrameSettings& settings : { svo::FrameSettings(), whole })
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

TEST(ConvexParts, WhatBoxesHaveInCommon)
{
  std::vector<glm::dvec3> points;
  svo::CommonPart({ box({ 1, 2, 3 }, { 9, 9, 9 }), box({ -9, -9, -9 }, { 3.5, 9, 9 }) })
    .add(box({ 0, 0, 0 }, { 4, 4, 4 }), points);
  ASSERT_FALSE(points.empty());
  glm::dvec3 low(1e9), high(-1e9);
  for (const glm::dvec3& p : points)
  {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  EXPECT_EQ(low, glm::dvec3(1, 2, 3));
  EXPECT_EQ(high, glm::dvec3(3.5, 4, 4));

  points.clear();
  svo::CommonPart({ box({ 0, 0, 0 }, { 1, 1, 1 }) }).add(box({ 2, 0, 0 }, { 3, 1, 1 }), points);
  EXPECT_TRUE(points.empty());
}

TEST(ConvexParts, AFlatBoxIsCutAsASurface)
{
  std::vector<glm::dvec3> points;
  const svo::ConvexBody flat = box({ -9, -9, 1 }, { 9, 9, 1 }),
                        cube = box({ 0, 0, 0 }, { 2, 3, 4 });
  svo::CommonPart({ cube }).add(flat, points);
  ASSERT_FALSE(points.empty());
  svo::CommonPart({ flat }).add(cube, points);
  svo::CommonPart({ flat }).add(box({ 0, 0, 1 }, { 2, 3, 1 }), points);
  for (const glm::dvec3& p : points)
  {
    EXPECT_EQ(p.z, 1.0);
    EXPECT_TRUE(p.x >= 0.0 && p.x <= 2.0 && p.y >= 0.0 && p.y <= 3.0);
  }
}

TEST(ConvexParts, APieceOfAViewHasWhatItSees)
{
  std::vector<glm::dvec3> points;
  const svo::ConvexBody piece = svo::pieceOf(Eye, 1.0, 100.0);
  svo::CommonPart({ piece }).add(box({ -1e6, -1e6, 0 }, { 1e6, 1e6, 0 }), points);
  ASSERT_FALSE(points.empty());
  for (const glm::dvec3& p : points)
  {
    const glm::dvec4 clip = Eye.viewToClip * Eye.worldToView * glm::dvec4(p, 1.0);
    EXPECT_LE(std::abs(clip.x), 1.000001 * clip.w);
    EXPECT_LE(std::abs(clip.y), 1.000001 * clip.w);
    EXPECT_NEAR(p.z, 0.0, 1e-9);
  }
}

// Of boxes within, across and beyond the piece.
TEST(ConvexParts, HaveAllThatAViewSeesOfABox)
{
  const double near = 2.0, far = 20.0;
  const svo::CommonPart seen({ svo::pieceOf(Eye, near, far) });
  const auto sees = [&](const glm::dvec3& p, double slack)
  {
    const glm::dvec4 clip = Eye.viewToClip * Eye.worldToView * glm::dvec4(p, 1.0);
    const double depth = -(Eye.worldToView * glm::dvec4(p, 1.0)).z;
    return depth >= near - slack && depth <= far + slack && std::abs(clip.x) <= clip.w + slack &&
      std::abs(clip.y) <= clip.w + slack;
  };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto anywhere = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  int within = 0, across = 0, beyond = 0;
  for (int n = 0; n < 2000; ++n)
  {
    const glm::dvec3 middle = 12.0 * anywhere();
    const double size = std::pow(10.0, unit(random));
    const glm::dvec3 x = size * anywhere(), y = size * anywhere(), z = size * anywhere();
    svo::ConvexBody body;
    for (int i = 0; i < 8; ++i)
    {
      body[i] = middle + (i & 1 ? x : -x) + (i & 2 ? y : -y) + (i & 4 ? z : -z);
    }
    std::vector<glm::dvec3> points;
    seen.add(body, points);
    glm::dvec3 low(1e9), high(-1e9);
    for (const glm::dvec3& p : points)
    {
      ASSERT_TRUE(sees(p, 1e-9));
      low = glm::min(low, p - 1e-9);
      high = glm::max(high, p + 1e-9);
    }
    int found = 0;
    for (int k = 0; k < 200; ++k)
    {
      const glm::dvec3 p = middle + unit(random) * x + unit(random) * y + unit(random) * z;
      if (sees(p, 0.0))
      {
        ++found;
        ASSERT_TRUE(glm::all(glm::lessThanEqual(low, p)) && glm::all(glm::lessThanEqual(p, high)));
      }
    }
    within += found == 200;
    across += found > 0 && found < 200;
    beyond += points.empty();
  }
  EXPECT_GT(within, 50);
  EXPECT_GT(across, 200);
  EXPECT_GT(beyond, 200);
}
