// The visible points of a tile, all at once, against the functions for one point, on every
// instruction set of this machine.
#include "svoInstructionSets.h"
#include "svoLayeredView.h"
#include "svoLeafError.h"
#include "svoMapTest.h"
#include "svoReferencePoint.h"
#include "svoReferenceShading.h"
#include "svoShadowBuffer.h"
#include "svoTileLighting.h"
#include "svoTileLook.h"
#include "svoTilePatch.h"
#include "svoTracerScenes.h"
#include "svoWorldSize.h"

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
      Attributes& a = instance.body.own().attributes;
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
    scene.instances[7].body.own().leafGeometry = LeafGeometry::Plane;

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
      { return &i == &scene.instances[7] ? level : i.body->octree.level(); },
      false, budget);
    eye.trace(serialFor, nullptr);
    frames.clear();
    for (const Instance& instance : scene.instances)
    {
      frames.push_back(SurfaceMatrices(instance));
    }
  }

  /// Calls f(patch) for every patch of every tile with hits.
  template <class F>
  void eachPatch(F&& f)
  {
    const DepthBuffer& depth = eye.hits().depth;
    TilePatch patch{};
    for (std::size_t tile = 0; tile < depth.tiles(); ++tile)
    {
      if (depth.hit[tile])
      {
        svo::eachPatch(
          view,
          hitsOfTile(depth, view, static_cast<int>(tile % depth.grid.tilesX),
            static_cast<int>(tile / depth.grid.tilesX)),
          [](std::uint32_t) { return true; }, [&](std::uint32_t i) { return eye.hits().base(i); },
          patch, f);
      }
    }
  }

  /// The same of patches that have been looked at.
  template <class F>
  void eachSeenPatch(F&& f)
  {
    TileTriangles triangles{};
    this->eachPatch(
      [&](TilePatch& patch)
      {
        lookAtPatch(frames[patch.instance], patch, triangles);
        f(patch);
      });
  }
};

/// Both look at the point in single precision, from different places: corners' normals of length 1,
/// weighted, may differ by a hundred roundings.
void expectSameNormal(const glm::vec3& found, const glm::vec3& expected, bool interpolated)
{
  if (!interpolated)
  {
    ASSERT_TRUE(sameBits(found, expected));
    return;
  }
  constexpr float ShortestSum = 0.02f; // of opposed normals; the rest is noise
  ASSERT_LT(glm::distance(found, expected), 100.0f * FloatRounding / ShortestSum);
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
        stage.eachSeenPatch(
          [&](const TilePatch& patch)
          {
            eachBit(patch.mask,
              [&](int i)
              {
                ASSERT_EQ(patch.hits->instance[i], patch.instance);
                ++seen[patch.instance];
                const Primitive primitive = patch.hits->primitive[i];
                const Instance& instance = stage.scene.instances[patch.instance];
                const SurfacePoint expected = surfacePoint(stage.frames[patch.instance], stage.view,
                  patch.x(i), patch.y(i), patch.t(i), primitive);
                const SurfacePoint point = patch.point(i);
                ASSERT_TRUE(sameBits(point.position, expected.position));
                const glm::dvec3 off =
                  glm::abs(patch.origin.position + glm::dvec3(patch.way(i)) - point.position);
                for (int k = 0; k < 3; ++k)
                {
                  ASSERT_LE(off[k], WayError * patch.extent[k]);
                }
                ASSERT_TRUE(sameBits(point.facet, expected.facet)) << patch.instance;
                const bool smooth = instance.body->attributes.normals && !instance.material.flat &&
                  instance.body->attributes.normalAssociation == Association::Point;
                expectSameNormal(
                  point.normal, expected.normal, smooth && !(primitive & NodePrimitive));
                ASSERT_EQ(point.hasColor, expected.hasColor);
                ASSERT_TRUE(!point.hasColor || instance.body->attributes.colorTexture ||
                  glm::distance(point.color, expected.color) < 100.0f * FloatRounding)
                  << patch.instance;
              });
          });
        for (std::size_t i = 0; i < seen.size(); ++i)
        {
          EXPECT_GT(seen[i], 100) << i;
        }
      });
  }
}

/// Every hit is in one patch, and patches are no deeper than they may be.
TEST(TileShading, PatchesHaveEveryHitOnce)
{
  Stage stage;
  stage.trace(7);
  const DepthBuffer& depth = stage.eye.hits().depth;
  onEveryInstructionSet(
    [&]
    {
      std::vector<int> times(depth.instance.size());
      int deep = 0;
      stage.eachPatch(
        [&](const TilePatch& patch)
        {
          eachBit(patch.mask,
            [&](int i)
            {
              ++times[patch.hits->instance - depth.instance.data() + i];
              const double deeper = patch.t(i) - patch.t(__builtin_ctzll(patch.mask));
              const double width = worldPixel(stage.view, patch.t(i));
              deep += std::abs(deeper) > 30.0 * width;
              ASSERT_LT(std::abs(deeper), 1.1 * TilePatch::Reach * width);
            });
        });
      EXPECT_GT(deep, 10);
      for (int y = 0; y < 8 * depth.grid.tilesY; ++y)
      {
        for (int x = 0; x < 8 * depth.grid.tilesX; ++x)
        {
          const std::size_t at = depth.at(x, y);
          const bool hit = x < stage.view.width && y < stage.view.height && depth.hit[at >> 6] &&
            depth.instance[at] != NoInstance;
          ASSERT_EQ(times[at], hit ? 1 : 0) << x << ", " << y;
        }
      }
    });
}

/// Lights all points with shadows that take anything, and compares with shade(), bit for bit.
void compareLighting(Stage& stage, int steps)
{
  constexpr float Remaining = 0.3f;
  const Lighting lighting(stage.scene, stage.view);
  onEveryInstructionSet(
    [&]
    {
      TileLight light{};
      TileColors colors{};
      stage.eachSeenPatch(
        [&](const TilePatch& patch)
        {
          const auto missed = [&](std::size_t l, int i)
          { return static_cast<float>((i * 7 + l * 5) % steps) / static_cast<float>(steps - 1); };
          const Instance& instance = stage.scene.instances[patch.instance];
          const bool lit = instance.material.lighting;
          for (std::size_t l = 0; lit && l < lighting.lights.size(); ++l)
          {
            const std::uint64_t reached = arriveLight(lighting, l, instance.material, patch, light);
            ASSERT_EQ(reached & ~patch.mask, 0u);
            for (int i = 0; i < TilePatch::Most; ++i)
            {
              light.share[i] = reached >> i & 1 ? shareOfLight(missed(l, i), Remaining) : 1.0f;
            }
            addLight(lighting.lights[l], patch, l == 0, light);
          }
          finishLight(instance.material, lit, patch, light, colors);
          eachBit(patch.mask,
            [&](int i)
            {
              const glm::vec3 expected =
                shade(lighting, instance, patch.point(i), patch.origin.position, patch.way(i),
                  Remaining, [&](std::size_t l) { return missed(l, i); });
              const glm::vec3 found = colors.rgb(i);
              ASSERT_TRUE(sameBits(expected, found))
                << "instance " << patch.instance << ": " << found.r << ", " << expected.r;
              std::uint8_t bytes[4];
              std::memcpy(bytes, colors.rgba + i, 4);
              ASSERT_EQ(bytes[0], toByte(found.r));
              ASSERT_EQ(bytes[1], toByte(found.g));
              ASSERT_EQ(bytes[2], toByte(found.b));
              ASSERT_EQ(bytes[3], 255);
            });
        });
    });
}

TEST(TileShading, ColoursAreThoseOfShade)
{
  Stage stage;
  stage.trace(7);
  compareLighting(stage, 2);
}

TEST(TileShading, ColoursInPartialShadowsAreThoseOfShade)
{
  Stage stage;
  stage.trace(7);
  compareLighting(stage, 9);
}

TEST(TileShading, ColoursUnderAHeadlightAloneAreThoseOfShade)
{
  Stage stage;
  stage.trace(7);
  stage.scene.lights.resize(1);
  stage.scene.onlyHeadlight = true;
  compareLighting(stage, 2);
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
          stage.eachSeenPatch(
            [&](const TilePatch& patch)
            {
              const Instance& instance = stage.scene.instances[patch.instance];
              const double error = worldLeafError(instance, instance.body->leafGeometry, 7);
              const std::uint64_t asked = patch.mask & 0xf7bdef7bdef7bdefu;
              double extents[TilePatch::Most];
              for (int i = 0; i < TilePatch::Most; ++i)
              {
                extents[i] = 0.02 * (i % 4);
              }
              const std::uint64_t found = MapTest(buffer.maps()).shadows(patch, error, asked);
              ASSERT_EQ(found & ~asked, 0u);
              float missed[TilePatch::Most];
              MapTest(buffer.maps()).darkness(patch, error, extents, asked, missed);
              eachBit(patch.mask,
                [&](int i)
                {
                  const bool isAsked = asked >> i & 1;
                  const bool expected =
                    isAsked && MapTest(buffer.maps()).shadows(patch.point(i), error);
                  ASSERT_EQ((found >> i & 1) != 0, expected) << "instance " << patch.instance;
                  dark += expected;
                  lit += isAsked && !expected;
                  const float share = isAsked
                    ? MapTest(buffer.maps()).darkness(patch.point(i), error, extents[i])
                    : 0.0f;
                  ASSERT_TRUE(sameBits(missed[i], share)) << "instance " << patch.instance;
                  partly += share > 0.0f && share < 1.0f;
                  ASSERT_TRUE(automatic || share == (expected ? 1.0f : 0.0f));
                });
            });
          EXPECT_GT(dark, 100);
          EXPECT_GT(lit, 100);
          EXPECT_TRUE(partly > 100 || !automatic);
        });
    }
  }
}

TEST(TileShading, FramesAreTheSame)
{
  Stage stage;
  for (const int kind : { 0, 1, 2 })
  {
    FrameSettings settings;
    settings.shadowResolution = 256;
    settings.antiAliasing = kind == 2;
    settings.filterShadows = kind > 0;
    settings.writeNormals = settings.writeLight = true;
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
    svo::LightTiles noted;
    stage.eachPatch([&](const TilePatch& patch) { marked.mark(patch, { 7, 3 }, noted); });
    EXPECT_EQ(7, noted.at(0).light);
    EXPECT_EQ(3, noted.at(0).group);
    const std::uint64_t before = svo::nextTileVersion();
    marked.trace(serialFor);
    const std::uint64_t after = svo::nextTileVersion();
    for (const svo::LightTile& tile : noted)
    {
      EXPECT_TRUE(marked.changedSince(tile, before));
      EXPECT_FALSE(marked.changedSince(tile, after));
    }
    FrameStatistics few, all;
    marked.addStatistics(few);
    whole.addStatistics(all);
    EXPECT_LT(few.shadowRays, all.shadowRays);
    stage.eachSeenPatch(
      [&](const TilePatch& patch)
      {
        ASSERT_EQ(MapTest(marked.maps()).shadows(patch, 0.0, patch.mask),
          MapTest(whole.maps()).shadows(patch, 0.0, patch.mask));
        eachBit(patch.mask,
          [&](int i)
          {
            ASSERT_TRUE(marked.knows(patch.position(i)));
            ASSERT_EQ(MapTest(marked.maps()).shadows(patch.point(i), 0.0),
              MapTest(whole.maps()).shadows(patch.point(i), 0.0));
          });
      });
  }
}
}
