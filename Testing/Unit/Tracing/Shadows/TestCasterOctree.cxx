// What lights see does not depend on the camera: neither its place nor the octrees that it needs.
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

using namespace svotest;

namespace
{
/// A ring above a ground, under a lamp. The ring of the level that lights are given.
struct LitRing
{
  svo::Octree coarse = makeOctree(torus(64, 32), 6);
  svo::Octree fine = makeOctree(torus(64, 32), 9);
  svo::Scene scene;

  explicit LitRing(svo::LeafGeometry leaves)
  {
    scene.instances = { instanceOf(coarse, 1, movedTo(0, 0, 1.5), leaves),
      instanceOf(makeOctree(square(3.0), 6), 2) };
    scene.instances[0].body.own().casterOctree = coarse;
    scene.lights = { lightOf(svo::Light::Kind::Point, { 2, -1, 8 }) };
  }
};

svo::FrameSettings wholeBuffers()
{
  svo::FrameSettings settings;
  settings.shadowResolution = 512; // no texel looks wide
  settings.pixelError = 1.0;
  settings.wholeShadowBuffers = true;
  return settings;
}

std::vector<svo::ShadowMap> mapsOf(const svo::Scene& scene, const svo::View& view)
{
  svo::CPUTracer tracer;
  rendered(tracer, scene, view, wholeBuffers());
  return tracer.shadowMaps();
}

void expectSame(const std::vector<svo::ShadowMap>& a, const std::vector<svo::ShadowMap>& b)
{
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_EQ(a[i].view.worldToView, b[i].view.worldToView);
    EXPECT_EQ(a[i].view.viewToClip, b[i].view.viewToClip);
    EXPECT_EQ(a[i].base, b[i].base);
    EXPECT_EQ(a[i].texels->tiles, b[i].texels->tiles);
    EXPECT_EQ(a[i].texels->numbers, b[i].texels->numbers);
    EXPECT_EQ(a[i].worldBias, b[i].worldBias);
  }
}

constexpr svo::LeafGeometry AllLeaves[] = { svo::LeafGeometry::Voxel, svo::LeafGeometry::Plane,
  svo::LeafGeometry::Automatic };
}

TEST(CasterOctree, MapsAreTheSameBitsForTwoCameras)
{
  for (const svo::LeafGeometry leaves : AllLeaves)
  {
    const LitRing lit(leaves);
    expectSame(mapsOf(lit.scene, lookAt({ 1, -7, 4 }, 160, 120)),
      mapsOf(lit.scene, lookAt({ -60, 20, 35 }, 320, 200, 25.0)));
  }
}

TEST(CasterOctree, MapsStayWhenTheEyesOctreeIsDeepened)
{
  for (const svo::LeafGeometry leaves : AllLeaves)
  {
    LitRing lit(leaves);
    const auto before = mapsOf(lit.scene, lookAt({ 1, -7, 4 }, 160, 120));
    lit.scene.instances[0].body.own().octree = lit.fine;
    expectSame(before, mapsOf(lit.scene, lookAt({ 1, -4, 3 }, 160, 120)));
  }
}

TEST(CasterOctree, WithoutOneTheLightsSeeWhatTheEyeSees)
{
  LitRing lit(svo::LeafGeometry::Voxel);
  const auto given = mapsOf(lit.scene, lookAt({ 1, -7, 4 }, 160, 120));
  lit.scene.instances[0].body.own().casterOctree = svo::Octree();
  expectSame(given, mapsOf(lit.scene, lookAt({ 1, -7, 4 }, 160, 120)));
  lit.scene.instances[0].body.own().octree = lit.fine;
  EXPECT_NE(
    given[0].texels->numbers, mapsOf(lit.scene, lookAt({ 1, -7, 4 }, 160, 120))[0].texels->numbers);
}

TEST(CasterOctree, DeepeningRetracesTheEyesLayerAlone)
{
  LitRing lit(svo::LeafGeometry::Automatic);
  const svo::View view = lookAt({ 1, -7, 4 }, 160, 120);
  svo::FrameSettings settings;
  svo::CPUTracer tracer;
  rendered(tracer, lit.scene, view, settings);
  rendered(tracer, lit.scene, view, settings);
  EXPECT_EQ(tracer.statistics().retracedLayers, 0u);
  lit.scene.instances[0].body.own().octree = lit.fine;
  rendered(tracer, lit.scene, view, settings);
  EXPECT_EQ(tracer.statistics().retracedLayers, 1u);
}

TEST(CasterOctree, RaysToLightsMeetWhatTheEyeSees)
{
  LitRing lit(svo::LeafGeometry::Automatic);
  svo::FrameSettings settings;
  settings.shadowTechnique = svo::ShadowTechnique::Rays;
  lit.scene.instances[0].body.own().octree = lit.fine;
  const svo::View view = lookAt({ 1, -7, 4 }, 160, 120);
  const svo::Frame given = rendered(lit.scene, view, settings);
  lit.scene.instances[0].body.own().casterOctree = svo::Octree();
  EXPECT_TRUE(identical(given, rendered(lit.scene, view, settings)));
}

TEST(CasterOctree, OfCopiesThatShareABodyItIsThatOfEach)
{
  LitRing lit(svo::LeafGeometry::Automatic);
  lit.scene.instances[0].body.own().octree = lit.fine;
  for (std::uint64_t i = 0; i < 3; ++i)
  {
    lit.scene.instances.push_back(lit.scene.instances[0]);
    lit.scene.instances.back().id = 10 + i;
    lit.scene.instances.back().localToWorld = movedTo(0.4, 0.3, 1.8 + 0.3 * double(i));
  }
  ASSERT_EQ(lit.scene.instances[0].body.holders(), 4u);
  const svo::View view = lookAt({ 1, -7, 4 }, 160, 120);
  const auto together = mapsOf(lit.scene, view);
  EXPECT_EQ(lit.scene.instances[0].body->octree.id(), lit.fine.id());
  for (svo::Instance& one : lit.scene.instances)
  {
    one.body = svo::Shared<svo::Body>(*one.body);
  }
  expectSame(together, mapsOf(lit.scene, view));
  for (svo::Instance& one : lit.scene.instances)
  {
    svo::Body& body = one.body.own();
    body.octree = body.casterOctree ? body.casterOctree : body.octree;
    body.casterOctree = svo::Octree();
  }
  expectSame(together, mapsOf(lit.scene, view));
}
