// The visible points of a tile, side by side, against the functions for one point, bit for bit, on
// every instruction set of this machine.
#include "svoInstructionSets.h"
#include "svoLeafError.h"
#include "svoReferencePoint.h"
#include "svoReferenceShading.h"
#include "svoShadowBuffer.h"
#include "svoTileLighting.h"
#include "svoTilePoints.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

namespace
{
using namespace svo;
using svotest::onEveryInstructionSet;

template <class T>
bool sameBits(const T& a, const T& b)
{
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Instances with every kind of attribute, one of them mirrored, one sheared, one of coarse nodes.
struct Stage
{
  Octree torus = svotest::makeOctree(svotest::torus(24, 18), 7);
  std::vector<float> normals, coordinates;
  std::vector<unsigned char> colors, texture;
  Scene scene;
  View view = svotest::lookAt({ 3.5, -3.0, 2.5 }, 427, 301);
  LayeredView eye;
  std::vector<SurfaceMatrices> frames;

  Stage()
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    const std::size_t count = 24 * 18 * 2; // triangles; points are fewer
    for (std::size_t i = 0; i < 3 * count; ++i)
    {
      normals.push_back(2.0f * unit(random) - 1.0f);
    }
    for (std::size_t i = 0; i < 4 * count; ++i)
    {
      colors.push_back(static_cast<unsigned char>(255.0f * unit(random)));
      texture.push_back(static_cast<unsigned char>(255.0f * unit(random)));
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      coordinates.push_back(1.4f * unit(random) - 0.2f);
    }
    std::fill_n(normals.begin() + 30, 3, 0.0f); // one that is none
    for (int i = 0; i < 8; ++i)
    {
      const glm::dmat4 place =
        svotest::movedTo(0.9 * (i % 3) - 0.9, 0.8 * (i / 3) - 0.8, 0.15 * (i % 2)) *
        glm::dmat4(glm::dmat3(0.5));
      scene.instances.push_back(svotest::instanceOf(torus, 10 + i, place));
      Instance& instance = scene.instances.back();
      instance.material.ambient = 0.1f * i;
      instance.material.ambientColor = { 0.3f, 0.9f, 0.5f };
      instance.material.diffuseColor = { 0.7f, 0.6f, 0.2f };
      instance.material.specular = i % 2 == 0 ? 0.0f : 0.4f;
      instance.material.specularPower = 7.0f;
      instance.material.flat = i == 5;
      instance.material.lighting = i != 6;
      Attributes& a = instance.attributes;
      a.normals = i == 0 ? nullptr : normals.data();
      a.normalAssociation = i == 2 ? Association::Cell : Association::Point;
      if (i == 1 || i == 2 || i == 6)
      {
        a.colors = colors.data();
        a.colorAssociation = i == 1 ? Association::Point : Association::Cell;
      }
      if (i == 3)
      {
        a.colorCoordinates = coordinates.data();
        a.colorTexture = texture.data();
        a.colorTextureSize = static_cast<int>(count) / 2;
      }
    }
    scene.instances[1].localToWorld = scene.instances[1].localToWorld *
      glm::dmat4(glm::dmat3(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)));
    scene.instances[3].localToWorld = scene.instances[3].localToWorld *
      glm::dmat4(glm::dmat3(glm::dvec3(1, 0.4, 0), glm::dvec3(0, 1, 0.3), glm::dvec3(0.2, 0, 1)));
    scene.instances[7].leafGeometry = LeafGeometry::Plane;

    using Kind = Light::Kind;
    for (Kind kind : { Kind::Directional, Kind::Point, Kind::Spot, Kind::Spot })
    {
      scene.lights.push_back(svotest::lightOf(kind, { 2.0, 1.0 + scene.lights.size(), 4.0 }));
      Light& light = scene.lights.back();
      light.id = scene.lights.size();
      light.color = { 0.5f, 0.4f, 0.1f * scene.lights.size() };
      light.attenuation = { 1.0f, 0.1f, 0.02f };
      light.exponent = scene.lights.size() == 4 ? 3.0 : 1.0;
    }
  }

  /// Instance 7 is traced to `level`.
  void trace(int level)
  {
    LayerBudget budget{ 0, 0 };
    eye.prepare(
      scene, view, [](const Instance& i) { return i.visible; },
      [&](const Instance& i, const LocalView&)
      { return &i == &scene.instances[7] ? level : i.octree.level(); },
      false, budget);
    eye.trace(serialFor, nullptr);
    frames.clear();
    for (const Instance& instance : scene.instances)
    {
      frames.push_back(SurfaceMatrices(instance));
    }
  }

  /// Calls f(points) for every tile with hits.
  template <class F>
  void eachTile(F&& f)
  {
    const DepthBuffer& depth = eye.depthBuffer();
    TilePoints points{};
    for (std::size_t tile = 0; tile < depth.tiles(); ++tile)
    {
      if (depth.hit[tile] &&
        takePoints(
          depth, view, static_cast<int>(tile % depth.tilesX), static_cast<int>(tile / depth.tilesX),
          [](std::uint32_t) { return true; }, [&](std::uint32_t i) { return eye.base(i); }, points))
      {
        f(points);
      }
    }
  }
};

/// Runs of points of one instance.
template <class F>
void eachInstance(const TilePoints& points, F&& f)
{
  for (int run = 0; run < points.runCount;)
  {
    const TilePoints::Run first = points.runs[run];
    int last = first.last;
    for (; run < points.runCount && points.runs[run].instance == first.instance; ++run)
    {
      last = points.runs[run].last;
    }
    f(first.instance, first.first, last, first.hasColor);
  }
}

TEST(TileShading, PointsAreThoseOfSurfacePoint)
{
  Stage stage;
  for (int level : { 7, 3 }) // instance 7 in its triangles' planes, or in coarse nodes' ones
  {
    stage.trace(level);
    onEveryInstructionSet(
      [&]
      {
        std::vector<int> seen(stage.scene.instances.size());
        stage.eachTile(
          [&](TilePoints& points)
          {
            lookAtPoints(stage.frames, stage.view, points);
            for (int run = 0; run < points.runCount; ++run)
            {
              const TilePoints::Run& r = points.runs[run];
              for (int i = r.first; i < r.last; ++i)
              {
                ASSERT_EQ(points.instance[i], r.instance);
                ++seen[r.instance];
                const SurfacePoint expected = surfacePoint(stage.frames[r.instance], stage.view,
                  points.x[i], points.y[i], points.t[i], points.primitive[i]);
                const SurfacePoint point = points.point(i);
                ASSERT_TRUE(sameBits(point.position, expected.position));
                ASSERT_TRUE(sameBits(point.facet, expected.facet)) << r.instance;
                ASSERT_TRUE(sameBits(point.normal, expected.normal)) << r.instance;
                ASSERT_EQ(r.hasColor, expected.hasColor);
                ASSERT_TRUE(!r.hasColor || sameBits(point.color, expected.color)) << r.instance;
                ASSERT_EQ(points.window[i], stage.view.windowDepth(points.t[i]));
              }
            }
          });
        for (std::size_t i = 0; i < seen.size(); ++i)
        {
          EXPECT_GT(seen[i], 100) << i;
        }
      });
  }
}

/// Lights all points with shadows that are anywhere, and compares with shade().
void compareLighting(Stage& stage)
{
  const Lighting lighting(stage.scene, stage.view);
  onEveryInstructionSet(
    [&]
    {
      TileLight light{};
      TileColors colors{};
      stage.eachTile(
        [&](TilePoints& points)
        {
          lookAtPoints(stage.frames, stage.view, points);
          const auto isDark = [&](std::size_t l, int i)
          { return (points.pixel[i] * 7 + l * 5) % 3 == 0; };
          eachInstance(points,
            [&](std::uint32_t index, int first, int last, bool hasColor)
            {
              const Instance& instance = stage.scene.instances[index];
              if (instance.material.lighting)
              {
                toViewSpace(lighting, points, first, last, light);
                for (std::size_t l = 0; l < lighting.lights.size(); ++l)
                {
                  arriveLight(lighting, l, instance.material, last - first, light);
                  for (int i = first; i < last; ++i)
                  {
                    light.dark[i - first] = light.reached[i - first] && isDark(l, i);
                  }
                  addLight(lighting.lights[l], 0.25f, last - first, light);
                }
              }
              finishLight(
                lighting, instance.material, points, first, last, hasColor, light, colors);
              for (int i = first; i < last; ++i)
              {
                SurfacePoint point = points.point(i);
                point.hasColor = hasColor;
                const glm::vec3 expected = shade(
                  lighting, instance, point, 0.25f, [&](std::size_t l) { return isDark(l, i); });
                ASSERT_TRUE(sameBits(expected, glm::vec3(colors.r[i], colors.g[i], colors.b[i])))
                  << "instance " << index << ": " << colors.r[i] << ", " << expected.r;
              }
            });
        });
    });
}

TEST(TileShading, ColoursAreThoseOfShade)
{
  Stage stage;
  stage.trace(7);
  compareLighting(stage);
}

TEST(TileShading, ColoursInPartialShadowsAreThoseOfShade)
{
  Stage stage;
  stage.trace(7);
  const Lighting lighting(stage.scene, stage.view);
  constexpr float Remaining = 0.3f;
  onEveryInstructionSet(
    [&]
    {
      TileLight light{};
      TileColors colors{};
      stage.eachTile(
        [&](TilePoints& points)
        {
          lookAtPoints(stage.frames, stage.view, points);
          const auto missed = [&](std::size_t l, int i)
          { return 0.125f * static_cast<float>((points.pixel[i] * 7 + l * 5) % 9); };
          eachInstance(points,
            [&](std::uint32_t index, int first, int last, bool hasColor)
            {
              const Instance& instance = stage.scene.instances[index];
              if (!instance.material.lighting)
              {
                return;
              }
              toViewSpace(lighting, points, first, last, light);
              for (std::size_t l = 0; l < lighting.lights.size(); ++l)
              {
                arriveLight(lighting, l, instance.material, last - first, light);
                for (int i = first; i < last; ++i)
                {
                  light.share[i - first] =
                    light.reached[i - first] ? shareOfLight(missed(l, i), Remaining) : 1.0f;
                }
                addShares(lighting.lights[l], last - first, light);
              }
              finishLight(
                lighting, instance.material, points, first, last, hasColor, light, colors);
              for (int i = first; i < last; ++i)
              {
                SurfacePoint point = points.point(i);
                point.hasColor = hasColor;
                const glm::vec3 expected = shade(lighting, instance, point, Remaining,
                  [&](std::size_t l) { return missed(l, i); });
                ASSERT_TRUE(sameBits(expected, glm::vec3(colors.r[i], colors.g[i], colors.b[i])))
                  << "instance " << index << ": " << colors.r[i] << ", " << expected.r;
              }
            });
        });
    });
}

TEST(TileShading, ColoursUnderAHeadlightAloneAreThoseOfShade)
{
  Stage stage;
  stage.trace(7);
  stage.scene.lights.resize(1);
  stage.scene.onlyHeadlight = true;
  compareLighting(stage);
}

TEST(TileShading, ShadowsAreThoseOfOnePoint)
{
  Stage stage;
  stage.trace(7);
  // A light among the objects has six maps.
  stage.scene.lights.push_back(svotest::lightOf(Light::Kind::Point, { 0.1, 0.2, 0.9 }));
  for (const Light& light : stage.scene.lights)
  {
    for (int automatic = 0; automatic < 2; ++automatic)
    {
      FrameSettings settings;
      settings.shadowResolution = 256;
      settings.automaticBias = automatic == 1;
      settings.bias = 1.0;
      settings.frameCoherence = false;
      LayerBudget budget{ 0, 0 };
      ShadowBuffer buffer;
      buffer.prepare(stage.scene,
        svo::mapsOfLight(
          svo::outlinesOf(stage.scene), light, settings.shadowResolution, svo::View()),
        0, settings, budget);
      buffer.markAll();
      buffer.trace(serialFor);
      onEveryInstructionSet(
        [&]
        {
          int dark = 0, lit = 0, partly = 0;
          stage.eachTile(
            [&](TilePoints& points)
            {
              lookAtPoints(stage.frames, stage.view, points);
              eachInstance(points,
                [&](std::uint32_t index, int first, int last, bool)
                {
                  const Instance& instance = stage.scene.instances[index];
                  const double error = worldLeafError(instance, instance.leafGeometry, 7);
                  std::uint8_t asked[TilePoints::Room], found[TilePoints::Room];
                  double extents[TilePoints::Room];
                  for (int i = first; i < last; ++i)
                  {
                    asked[i - first] = i % 5 != 0;
                    extents[i - first] = 0.02 * (i % 4);
                  }
                  buffer.shadows(points, first, last, error, asked, found);
                  float missed[TilePoints::Room];
                  buffer.darkness(points, first, last, error, extents, asked, missed);
                  for (int i = first; i < last; ++i)
                  {
                    const bool expected =
                      asked[i - first] && buffer.shadows(points.point(i), error);
                    ASSERT_EQ(found[i - first] != 0, expected) << "instance " << index;
                    dark += expected;
                    lit += asked[i - first] && !expected;
                    const float share = asked[i - first]
                      ? buffer.darkness(points.point(i), error, extents[i - first])
                      : 0.0f;
                    ASSERT_TRUE(sameBits(missed[i - first], share)) << "instance " << index;
                    partly += share > 0.0f && share < 1.0f;
                    ASSERT_TRUE(automatic || share == (expected ? 1.0f : 0.0f));
                  }
                });
            });
          EXPECT_GT(dark, 100);
          EXPECT_GT(lit, 100);
          EXPECT_TRUE(partly > 100 || !automatic);
        });
    }
  }
}

TEST(TileShading, FilteredFramesAreTheSame)
{
  Stage stage;
  for (const bool antiAliasing : { false, true })
  {
    FrameSettings settings;
    settings.shadowResolution = 256;
    settings.antiAliasing = antiAliasing;
    settings.filterShadows = true;
    const Frame expected = svotest::rendered(stage.scene, stage.view, settings);
    onEveryInstructionSet(
      [&]
      {
        EXPECT_TRUE(
          svotest::identical(expected, svotest::rendered(stage.scene, stage.view, settings)));
      });
    CPUTracer tracer;
    EXPECT_TRUE(svotest::identical(expected,
      svotest::rendered(tracer, stage.scene, stage.view, settings, svotest::raggedFor(7))));
    EXPECT_TRUE(svotest::identical(expected,
      svotest::rendered(tracer, stage.scene, stage.view, settings, svotest::raggedFor(2))));
  }
}

/// Marked tiles are enough: what points look up is the same as in a buffer traced whole.
TEST(TileShading, WhatIsMarkedIsWhatIsLookedUp)
{
  Stage stage;
  stage.trace(7);
  for (const Light& light : stage.scene.lights)
  {
    FrameSettings settings;
    settings.shadowResolution = 512;
    settings.frameCoherence = false;
    LayerBudget budget{ 0, 0 };
    ShadowBuffer whole, marked;
    const svo::LightMaps maps =
      svo::mapsOfLight(svo::outlinesOf(stage.scene), light, settings.shadowResolution, svo::View());
    whole.prepare(stage.scene, maps, 0, settings, budget);
    whole.markAll();
    whole.trace(serialFor);
    marked.prepare(stage.scene, maps, 0, settings, budget);
    stage.eachTile(
      [&](TilePoints& points)
      {
        placePoints(stage.view, points);
        marked.mark(points);
      });
    marked.trace(serialFor);
    EXPECT_LT(marked.rays(), whole.rays());
    stage.eachTile(
      [&](TilePoints& points)
      {
        lookAtPoints(stage.frames, stage.view, points);
        for (int i = 0; i < points.count; ++i)
        {
          ASSERT_EQ(marked.shadows(points.point(i), 0.0), whole.shadows(points.point(i), 0.0));
        }
      });
  }
}
}
