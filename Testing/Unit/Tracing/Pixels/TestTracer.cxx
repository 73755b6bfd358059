#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

using namespace svotest;

namespace
{
std::vector<std::uint64_t> bytesOf(const svo::Octree& octree)
{
  const svo::Header& h = octree.header();
  const std::size_t size =
    sizeof(svo::Header) + h.nodeCount * sizeof(svo::Node) + h.listWords * sizeof(std::uint32_t);
  std::vector<std::uint64_t> bytes((size + 7) / 8);
  std::memcpy(bytes.data(), octree.key(), size);
  return bytes;
}

const svo::View Eye = lookAt({ 1, -6, 4 }, 100, 76);

svo::FrameSettings smallBuffers()
{
  svo::FrameSettings settings;
  settings.shadowResolution = 128;
  return settings;
}
}

TEST(Tracer, FramesDoNotDependOnThreads)
{
  for (svo::ShadowTechnique technique :
    { svo::ShadowTechnique::Buffer, svo::ShadowTechnique::Rays })
  {
    svo::FrameSettings settings = smallBuffers();
    settings.shadowTechnique = technique;
    const svo::Frame one = rendered(ballRingAndGround(), Eye, settings);
    for (unsigned threads : { 1u, 2u, 7u })
    {
      svo::CPUTracer tracer;
      const svo::Frame many =
        rendered(tracer, ballRingAndGround(), Eye, settings, raggedFor(threads));
      EXPECT_TRUE(identical(one, many)) << threads;
    }
  }
}

// The heart of frame coherence: whatever is edited, a tracer that keeps layers shows the very bits
// of one that has never seen a frame, and of one that keeps nothing.
TEST(Tracer, KeptLayersNeverChangeAPicture)
{
  for (svo::LeafGeometry leafGeometry : { svo::LeafGeometry::Voxel, svo::LeafGeometry::Plane,
         svo::LeafGeometry::Triangle, svo::LeafGeometry::Automatic })
  {
    svo::Scene scene = ballRingAndGround(leafGeometry);
    svo::View view = Eye;
    svo::FrameSettings settings = smallBuffers();
    svo::CPUTracer keeping;
    svo::FrameSettings forgetful = settings;
    for (int step = 0; step < 12; ++step)
    {
      switch (step)
      {
        case 2:
          scene.instances[1].localToWorld = movedTo(-0.6, 0.1, 1.1);
          break;
        case 3:
          scene.instances[1].localToWorld = movedTo(-0.4, 0.1, 1.1);
          break;
        case 6:
          view = lookAt({ 1.5, -6, 4 }, 100, 76);
          break;
        case 7:
          view = lookAt({ 1.5, -5, 4 }, 90, 76);
          break;
        case 8:
          scene.lights[0].position.x = 1.0;
          break;
        case 9:
          scene.instances.erase(scene.instances.begin() + 1);
          break;
        case 10:
          std::swap(scene.instances[0], scene.instances[1]);
          break;
        case 11:
          settings.layerMemoryLimit = 0;
          break;
        default: // nothing changes: layers are made, then used
          break;
      }
      forgetful = settings;
      forgetful.frameCoherence = false;
      const svo::Frame frame = rendered(keeping, scene, view, settings);
      EXPECT_TRUE(identical(frame, rendered(scene, view, forgetful)))
        << "step " << step << ", leaves " << int(leafGeometry);
    }
  }
}

// A limit of octree memory lets octrees go between frames, and the next one may lie in their place.
TEST(Tracer, AnOctreeInAnotherOnesPlaceIsAnotherOctree)
{
  const std::vector<std::uint64_t> bytes[2] = { bytesOf(makeOctree(sphere(24, 40), 5)),
    bytesOf(makeOctree(torus(40, 24), 5)) };
  std::vector<std::uint64_t> place(std::max(bytes[0].size(), bytes[1].size()));
  svo::CPUTracer tracer;
  for (int step = 0; step < 4; ++step)
  {
    const std::vector<std::uint64_t>& next = bytes[step % 2];
    std::copy(next.begin(), next.end(), place.begin());
    std::string error;
    svo::Scene scene = ballRingAndGround();
    scene.instances.resize(1);
    scene.instances[0].body.own().octree =
      svo::Octree::open(std::shared_ptr<const std::byte>(
                          reinterpret_cast<const std::byte*>(place.data()), [](const void*) {}),
        8 * next.size(), nullptr, error);
    ASSERT_TRUE(scene.instances[0].body->octree) << error;
    EXPECT_TRUE(
      identical(rendered(tracer, scene, Eye, smallBuffers()), rendered(scene, Eye, smallBuffers())))
      << "step " << step;
  }
}

TEST(Tracer, WhatStandsStillIsNotTracedAgain)
{
  svo::Scene scene = ballRingAndGround();
  svo::FrameSettings settings = smallBuffers();
  svo::CPUTracer tracer;
  rendered(tracer, scene, Eye, settings);
  EXPECT_EQ(tracer.statistics().retracedLayers, 9u); // three of the eye and of each light
  EXPECT_GT(tracer.statistics().layerMemory, 0u);
  rendered(tracer, scene, Eye, settings);
  EXPECT_EQ(tracer.statistics().retracedLayers, 0u);
  EXPECT_EQ(tracer.statistics().primaryRays, 0u);
  EXPECT_EQ(tracer.statistics().shadowRays, 0u);
  // One instance moves inside of the others' bounds: its three layers and nothing else.
  scene.instances[1].localToWorld = movedTo(-0.7, 0.0, 1.0);
  rendered(tracer, scene, Eye, settings);
  EXPECT_GE(tracer.statistics().retracedLayers, 3u);
  EXPECT_LT(tracer.statistics().retracedLayers, 9u);
  settings.frameCoherence = false;
  rendered(tracer, scene, Eye, settings);
  rendered(tracer, scene, Eye, settings);
  EXPECT_EQ(tracer.statistics().retracedLayers, 9u);
  EXPECT_EQ(tracer.statistics().layerMemory, 0u);
}

// A light that comes close gets six maps for one; they are no views that nothing has moved in yet.
TEST(Tracer, MapsInThePlaceOfOthersHaveNoLayersOfWhatMoves)
{
  svo::Scene scene = ballRingAndGround();
  scene.instances = { scene.instances[1] };
  scene.lights.resize(1);
  svo::CPUTracer tracer;
  rendered(tracer, scene, Eye, smallBuffers());
  EXPECT_GT(tracer.statistics().layerMemory, 0u);
  for (const glm::dvec3& place : { glm::dvec3(-0.8, 0.0, 2.3), glm::dvec3(2.0, -3.0, 6.0) })
  {
    scene.lights[0].position = place;
    scene.instances[0].localToWorld[3].x += 0.01;
    rendered(tracer, scene, Eye, smallBuffers());
    EXPECT_EQ(tracer.statistics().layerMemory, 0u);
  }
}

TEST(Tracer, KeptLayersStayUnderTheLimit)
{
  svo::FrameSettings settings = smallBuffers();
  settings.layerMemoryLimit = 100000;
  svo::CPUTracer tracer;
  rendered(tracer, ballRingAndGround(), Eye, settings);
  rendered(tracer, ballRingAndGround(), Eye, settings);
  EXPECT_GT(tracer.statistics().layerMemory, 0u);
  EXPECT_LE(tracer.statistics().layerMemory, settings.layerMemoryLimit);
}

// Wiping and writing the tracer's frame gives what a new one gets.
TEST(Tracer, AFrameUsedAgainHasNothingLeftOfTheLastPicture)
{
  svo::Scene scene = ballRingAndGround();
  svo::FrameSettings settings = smallBuffers();
  settings.writeNormals = true;
  svo::CPUTracer tracer;
  rendered(tracer, scene, Eye, settings);
  scene.instances.resize(2);
  scene.instances[0].visible = false;
  scene.instances[1].localToWorld = movedTo(0.5, 0.0, 2.0);
  EXPECT_TRUE(identical(rendered(tracer, scene, Eye, settings), rendered(scene, Eye, settings)));
  settings.writeNormals = false;
  EXPECT_TRUE(rendered(tracer, scene, Eye, settings).normals.empty());
}

TEST(Tracer, CoveredHoldsEveryHitAndNoMoreThanItsTiles)
{
  svo::Scene scene = ballRingAndGround();
  scene.instances = { scene.instances[1] };
  const svo::Frame frame = rendered(scene, Eye, smallBuffers());
  svo::PixelRect seen{ frame.width, frame.height, 0, 0 };
  for (int y = 0; y < frame.height; ++y)
  {
    for (int x = 0; x < frame.width; ++x)
    {
      if (frame.instance[std::size_t(y) * frame.width + x] != ~0u)
      {
        seen = { std::min(seen.x0, x), std::min(seen.y0, y), std::max(seen.x1, x + 1),
          std::max(seen.y1, y + 1) };
      }
    }
  }
  EXPECT_EQ(frame.covered.x0, seen.x0 / 8 * 8);
  EXPECT_EQ(frame.covered.y0, seen.y0 / 8 * 8);
  EXPECT_EQ(frame.covered.x1, std::min((seen.x1 + 7) / 8 * 8, frame.width));
  EXPECT_EQ(frame.covered.y1, std::min((seen.y1 + 7) / 8 * 8, frame.height));
}

TEST(Tracer, AnEyeInsideAnObjectSeesItsInsideEverywhere)
{
  svo::Scene scene = ballRingAndGround();
  scene.instances = { instanceOf(makeOctree(sphere(24, 40), 7), 1,
    glm::scale(glm::dmat4(1.0), glm::dvec3(4.0)), svo::LeafGeometry::Automatic) };
  const svo::Frame frame =
    rendered(scene, lookAt({ 0.3, -1.0, 0.2 }, 64, 48, 100.0), smallBuffers());
  for (std::uint32_t instance : frame.instance)
  {
    EXPECT_EQ(instance, 0u);
  }
}

TEST(Tracer, AnInvisibleInstanceOnlyCasts)
{
  svo::Scene scene = ballRingAndGround();
  scene.lights.resize(1);
  svo::FrameSettings settings = smallBuffers();
  scene.instances.resize(2);
  scene.instances[1].visible = false;
  const svo::Frame shadowed = rendered(scene, Eye, settings);
  scene.instances[1].castShadow = false;
  const svo::Frame lit = rendered(scene, Eye, settings);
  int darker = 0;
  for (std::size_t i = 0; i < lit.instance.size(); ++i)
  {
    EXPECT_EQ(lit.instance[i], shadowed.instance[i]);
    EXPECT_NE(lit.instance[i], 1u);
    darker += shadowed.color[4 * i] < lit.color[4 * i];
  }
  EXPECT_GT(darker, 100);
}

TEST(Tracer, AnInstanceMayHaveItsOwnPixelError)
{
  using namespace svo;
  // Cubes stop at the level that the error allows, so that pictures differ.
  const Octree octree = svotest::makeOctree(svotest::sphere(30, 40), 8);
  const View view = svotest::lookAt({ 4, 0, 1 }, 96, 96);
  const auto picture = [&](double ofFrame, double ofInstance)
  {
    Scene scene;
    scene.instances = { svotest::instanceOf(octree, 1, glm::dmat4(1.0), LeafGeometry::Voxel) };
    scene.instances[0].pixelError = ofInstance;
    FrameSettings settings;
    settings.pixelError = ofFrame;
    return svotest::rendered(scene, view, settings);
  };
  const Frame fine = picture(0.0, -1.0);
  const Frame coarse = picture(12.0, -1.0);
  EXPECT_FALSE(svotest::identical(fine, coarse));
  EXPECT_TRUE(svotest::identical(picture(12.0, 0.0), fine));
  EXPECT_TRUE(svotest::identical(picture(0.0, 12.0), coarse));
}

TEST(Tracer, AnOffsetOfAllMovesTheWindowDepthAlone)
{
  svo::Scene scene = ballRingAndGround();
  const svo::Frame plain = rendered(scene, Eye, smallBuffers());
  for (svo::Instance& instance : scene.instances)
  {
    instance.depthOffset.units = 0.125f;
  }
  const svo::Frame moved = rendered(scene, Eye, smallBuffers());
  EXPECT_EQ(plain.color, moved.color);
  for (std::size_t i = 0; i < plain.depth.size(); ++i)
  {
    EXPECT_NEAR(moved.depth[i], std::min(plain.depth[i] + 0.125f, 1.0f), 1e-6);
  }
}

TEST(Tracer, BadInputIsAPictureWithoutIt)
{
  svo::Scene scene = ballRingAndGround();
  const svo::Frame expected = rendered(scene, Eye, smallBuffers());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  svo::Instance bad = scene.instances[1];
  bad.id = 50;
  bad.localToWorld = glm::dmat4(nan);
  scene.instances.push_back(bad);
  bad.localToWorld = glm::dmat4(std::numeric_limits<double>::infinity());
  scene.instances.push_back(bad);
  bad.localToWorld = glm::dmat4(1.0);
  bad.body.own().octree = svo::Octree();
  scene.instances.push_back(bad);
  bad.body.own().octree = makeOctree(Mesh(), 5);
  ASSERT_TRUE(bool(bad.body->octree));
  scene.instances.push_back(bad);
  const svo::Frame frame = rendered(scene, Eye, smallBuffers());
  EXPECT_EQ(frame.instance, expected.instance);
  EXPECT_EQ(frame.depth, expected.depth);

  const svo::Frame nothing = rendered(svo::Scene(), Eye, smallBuffers());
  EXPECT_TRUE(nothing.covered.empty());
  EXPECT_EQ(nothing.depth.size(), std::size_t(100 * 76));
  svo::View none;
  EXPECT_TRUE(rendered(ballRingAndGround(), none, smallBuffers()).color.empty());
  scene.lights.clear();
  EXPECT_EQ(rendered(scene, Eye, smallBuffers()).instance, expected.instance);
}

TEST(Tracer, LightBeyondOneIsKeptWhereItIsAskedFor)
{
  svo::Scene scene = ballRingAndGround();
  for (svo::Light& light : scene.lights)
  {
    light.color *= 3.0f;
  }
  for (const bool smooth : { false, true })
  {
    svo::FrameSettings settings = smallBuffers();
    settings.antiAliasing = smooth;
    const svo::Frame plain = rendered(scene, Eye, settings);
    EXPECT_TRUE(plain.light.empty());
    settings.writeLight = true;
    const svo::Frame bright = rendered(scene, Eye, settings);
    ASSERT_EQ(bright.light.size(), 3 * bright.depth.size());
    int beyond = 0;
    int differ = 0;
    for (std::size_t i = 0; i < bright.depth.size(); ++i)
    {
      for (int c = 0; c < 3 && bright.color[4 * i + 3] == 255; ++c)
      {
        const float light = bright.light[3 * i + c];
        beyond += light > 1.0f;
        EXPECT_EQ(bright.color[4 * i + c], int(std::min(light, 1.0f) * 255.0f + 0.5f));
        differ += bright.color[4 * i + c] != plain.color[4 * i + c];
      }
    }
    EXPECT_GT(beyond, 100);
    // Only pixels of several samples, of which some are cut and some are not.
    EXPECT_LE(differ, smooth ? 2000 : 0);
  }
}
