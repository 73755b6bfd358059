// How deep octrees have to be: from pixels and texels, before there is any octree.
#include "svoTracerScenes.h"

#include "svoCasters.h"
#include "svoLightView.h"
#include "svoNeededLevels.h"
#include "svoSelectLevel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace svotest;

namespace
{
constexpr int Deepest = 11;
constexpr int Coarsest = 4;

/// A mesh of the given half size about the origin, of which there is no octree yet.
svo::Instance unbuilt(std::uint64_t id, double half, const glm::dmat4& localToWorld)
{
  svo::Instance instance;
  instance.id = id;
  instance.localToWorld = localToWorld;
  instance.body.own().box = { glm::dvec3(-half), glm::dvec3(half) };
  instance.body.own().deepestLevel = Deepest;
  return instance;
}

svo::Scene oneThing(double half = 1.0)
{
  svo::Scene scene;
  scene.instances = { unbuilt(1, half, glm::dmat4(1.0)) };
  return scene;
}

svo::FrameSettings noShadows(double pixelError = 1.0)
{
  svo::FrameSettings settings;
  settings.shadowTechnique = svo::ShadowTechnique::None;
  settings.pixelError = pixelError;
  return settings;
}

svo::View seenFrom(double distance)
{
  return lookAt({ 0.0, -distance, 0.0 }, 400, 400);
}

int eyeLevel(const svo::Scene& scene, const svo::View& view, const svo::FrameSettings& settings)
{
  return svo::neededLevels(scene, view, settings)[0].eye;
}
}

TEST(NeededLevels, AreNeverLessThanTheLevelAtWhichRaysStop)
{
  // A real octree of the deepest level: where its rays stop is what a built one must have.
  const Mesh mesh = sphere(24, 48);
  const svo::Octree octree = makeOctree(mesh, Deepest);
  for (double distance = 1.5; distance < 400.0; distance *= 1.1)
  {
    for (const double pixelError : { 0.5, 1.0, 3.0 })
    {
      const svo::View view = seenFrom(distance);
      const svo::Instance deep = instanceOf(octree, 1);
      const svo::LocalView local = svo::makeLocalView(octree, deep.localToWorld, view);
      if (local.rect.empty())
      {
        continue;
      }
      const int stops = svo::selectLevel(deep, local, view, pixelError);
      const int needed = eyeLevel(oneThing(), view, noShadows(pixelError));
      EXPECT_GE(needed, stops) << distance << ' ' << pixelError;
      EXPECT_LE(needed, std::max(stops + 1, Coarsest)) << distance;
    }
  }
}

TEST(NeededLevels, GrowAsTheCameraComesCloserUpToTheDeepest)
{
  int last = 0;
  std::set<int> levels;
  for (double distance = 2000.0; distance > 0.5; distance *= 0.8)
  {
    const int level = eyeLevel(oneThing(), seenFrom(distance), noShadows());
    EXPECT_GE(level, last) << distance;
    last = level;
    levels.insert(level);
  }
  EXPECT_EQ(levels, (std::set<int>{ 4, 5, 6, 7, 8, 9, 10, 11 }));
}

TEST(NeededLevels, AnInstancesOwnPixelErrorCounts)
{
  svo::Scene scene = oneThing();
  const svo::View view = seenFrom(20.0);
  const int before = eyeLevel(scene, view, noShadows());
  scene.instances[0].pixelError = 16.0;
  EXPECT_LT(eyeLevel(scene, view, noShadows()), before);
  scene.instances[0].pixelError = 0.0;
  EXPECT_EQ(eyeLevel(scene, view, noShadows()), Deepest);
}

TEST(NeededLevels, APixelErrorOfZeroNeedsTheDeepestForEyeAndLights)
{
  svo::Scene scene = oneThing();
  scene.lights = { lightOf(svo::Light::Kind::Point, { 50, -20, 80 }) };
  svo::FrameSettings settings;
  settings.pixelError = 0.0;
  settings.shadowResolution = 64;
  const auto needed = svo::neededLevels(scene, seenFrom(300.0), settings);
  EXPECT_EQ(needed[0].eye, Deepest);
  EXPECT_EQ(needed[0].lights, Deepest);
}

TEST(NeededLevels, WhatIsOutOfThePictureNeedsTheCoarsest)
{
  svo::Scene scene = oneThing();
  scene.instances[0].localToWorld = movedTo(0, -30, 0); // behind the eye
  EXPECT_EQ(eyeLevel(scene, seenFrom(4.0), noShadows()), Coarsest);
  scene.instances[0].localToWorld = glm::dmat4(1.0);
  scene.instances[0].visible = false;
  EXPECT_EQ(eyeLevel(scene, seenFrom(4.0), noShadows()), Coarsest);
}

TEST(NeededLevels, AnUnknownViewAndAnUnknownBoxNeedTheDeepest)
{
  svo::Scene scene = oneThing();
  EXPECT_EQ(eyeLevel(scene, svo::View(), noShadows()), Deepest);
  scene.instances[0].body.own().box = svo::Box();
  EXPECT_EQ(eyeLevel(scene, seenFrom(300.0), noShadows()), Deepest);
}

TEST(NeededLevels, CoordinatesWithoutMeasureNeedTheDeepest)
{
  for (const double half : { 1e160, 1e300 })
  {
    EXPECT_EQ(eyeLevel(oneThing(half), seenFrom(4.0), noShadows()), Deepest);
  }
}

TEST(NeededLevels, LightsNeedTheSameWhereverTheEyeIs)
{
  svo::Scene scene = oneThing();
  scene.instances.push_back(unbuilt(2, 0.1, movedTo(3, 0, 0)));
  for (const auto kind :
    { svo::Light::Kind::Directional, svo::Light::Kind::Point, svo::Light::Kind::Spot })
  {
    scene.lights = { lightOf(kind, { 3, -5, 9 }) };
    svo::FrameSettings settings;
    settings.shadowResolution = 256;
    const auto first = svo::neededLevels(scene, seenFrom(400.0), settings);
    EXPECT_GT(first[0].lights, first[1].lights); // the small one has fewer texels
    EXPECT_LT(first[0].lights, Deepest);
    // Nearer than that their texels would look wide: the maps are fitted to what is seen.
    for (double distance = 5.0; distance < 400.0; distance *= 1.3)
    {
      const auto needed = svo::neededLevels(scene, seenFrom(distance), settings);
      for (std::size_t i = 0; i < 2; ++i)
      {
        EXPECT_EQ(needed[i].lights, first[i].lights) << distance;
        EXPECT_GE(needed[i].eye, needed[i].lights) << distance;
      }
    }
  }
}

TEST(NeededLevels, LightsNeedMoreWhereTheirMapsAreFittedToWhatIsSeen)
{
  svo::Scene scene = oneThing();
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 3, -5, 9 }) };
  svo::FrameSettings settings;
  settings.shadowResolution = 256;
  const int far = svo::neededLevels(scene, seenFrom(4.0), settings)[0].lights;
  EXPECT_GT(svo::neededLevels(scene, seenFrom(1.1), settings)[0].lights, far);
}

TEST(NeededLevels, LightsNeedWhatTheirTexelsResolve)
{
  // What the tracer would take of the deepest octree, in the views that it fits to it.
  const svo::Octree octree = makeOctree(sphere(24, 48), Deepest);
  for (const auto kind :
    { svo::Light::Kind::Directional, svo::Light::Kind::Point, svo::Light::Kind::Spot })
  {
    for (int resolution = 32; resolution <= 4096; resolution *= 2)
    {
      svo::Scene built;
      built.instances = { instanceOf(octree, 1) };
      built.lights = { lightOf(kind, { 3, -5, 9 }) };
      int stops = 0;
      const auto outlines = svo::outlinesOf(built);
      const auto casters = svo::castersOf(outlines, built.lights[0]);
      for (const svo::View& view : svo::fitLight(outlines, casters, built.lights[0], resolution))
      {
        const auto local = svo::makeLocalView(octree, glm::dmat4(1.0), view);
        stops = std::max(stops, svo::selectLevel(built.instances[0], local, view, 1.0));
      }
      svo::Scene scene = oneThing();
      scene.lights = built.lights;
      svo::FrameSettings settings;
      settings.shadowResolution = resolution;
      const int needed = svo::neededLevels(scene, seenFrom(400.0), settings)[0].lights;
      EXPECT_GE(needed, stops) << resolution;
      EXPECT_LE(needed, std::max(stops + 1, Coarsest)) << resolution;
    }
  }
}

TEST(NeededLevels, NoOctreeIsCoarserThanItsMesh)
{
  const svo::Box cube{ glm::dvec3(-1e-30), glm::dvec3(1e-30) };
  EXPECT_EQ(svo::coarsestLevel(cube, 12), Coarsest);
  // Eight triangles a brick of 16 voxels: half a triangle a voxel, on six faces of 2^level voxels.
  for (int level = Coarsest; level <= svo::MaximumLevel; ++level)
  {
    const auto most = static_cast<std::size_t>(std::ldexp(3.0, 2 * level));
    EXPECT_EQ(svo::coarsestLevel(cube, most), level);
    EXPECT_EQ(svo::coarsestLevel(cube, most + 1), std::min(level + 1, svo::MaximumLevel));
  }
  EXPECT_EQ(svo::coarsestLevel(svo::Box(), 1000), Coarsest);
  const svo::Box line{ glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 0.0) };
  EXPECT_LE(svo::coarsestLevel(line, 1000000000), svo::MaximumLevel);

  svo::Scene scene = oneThing();
  scene.lights = { lightOf(svo::Light::Kind::Point, { 3, -5, 9 }) };
  svo::FrameSettings settings;
  settings.shadowResolution = 16;
  EXPECT_EQ(svo::neededLevels(scene, seenFrom(400.0), settings)[0].lights, Coarsest);
  scene.instances[0].body.own().triangles = 100000; // level 8
  const auto needed = svo::neededLevels(scene, seenFrom(400.0), settings);
  EXPECT_EQ(needed[0].lights, 8);
  EXPECT_EQ(needed[0].eye, 8);
  scene.instances[0].body.own().triangles = 100000000;
  EXPECT_EQ(eyeLevel(scene, seenFrom(400.0), settings), Deepest);
}

TEST(NeededLevels, NoOctreeIsFinerThanItsMeshWhereTrianglesAreExact)
{
  svo::Scene scene = oneThing();
  const svo::View close = seenFrom(1.5);
  ASSERT_GT(eyeLevel(scene, close, noShadows()), 6);
  scene.instances[0].body.own().detailLevel = 6;
  EXPECT_EQ(eyeLevel(scene, close, noShadows()), 6);
  EXPECT_EQ(eyeLevel(scene, seenFrom(390.0), noShadows()), Coarsest); // where less will do
  scene.instances[0].body.own().triangles = 1000000; // no coarser than the mesh all the same
  EXPECT_GT(eyeLevel(scene, close, noShadows()), 6);
  scene.instances[0].body.own().triangles = 0;
  // Those who have the size of voxels in mind get it.
  EXPECT_EQ(eyeLevel(scene, close, noShadows(0.0)), Deepest);
  svo::FrameSettings biased = noShadows();
  biased.bias = 1.0;
  EXPECT_GT(eyeLevel(scene, close, biased), 6);
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 3.0, 2.0, 10.0 }) };
  svo::FrameSettings settings;
  EXPECT_EQ(svo::neededLevels(scene, close, settings)[0].lights, 6);
  settings.shadowTechnique = svo::ShadowTechnique::Rays;
  EXPECT_EQ(eyeLevel(scene, close, settings), Deepest);
}

TEST(NeededLevels, RaysToLightsNeedTheDeepestOfCastersOnly)
{
  svo::Scene scene = oneThing();
  scene.instances.push_back(unbuilt(2, 1.0, movedTo(3, 0, 0)));
  scene.instances[1].castShadow = false;
  scene.lights = { lightOf(svo::Light::Kind::Point, { 3, -5, 9 }) };
  svo::FrameSettings settings;
  settings.shadowTechnique = svo::ShadowTechnique::Rays;
  const auto needed = svo::neededLevels(scene, seenFrom(400.0), settings);
  EXPECT_EQ(needed[0].eye, Deepest);
  EXPECT_EQ(needed[0].lights, 0);
  EXPECT_LT(needed[1].eye, Deepest);
}
