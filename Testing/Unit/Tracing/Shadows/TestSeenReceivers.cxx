// What the eye sees of rasterised receivers finds in shadow maps what maps that are traced whole
// have.
#include "svoTracerScenes.h"

#include "svoTexelPlace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace svotest;

namespace
{
/// A matte ball on a ground, neither of which receives: else the ground has nearly all of the maps.
svo::Scene ballOnGround(const svo::Light& light)
{
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(square(3.0), 6), 1, glm::dmat4(1.0),
                        svo::LeafGeometry::Automatic),
    instanceOf(
      makeOctree(sphere(40, 64), 6), 2, movedTo(0.0, 0.0, 1.5), svo::LeafGeometry::Automatic) };
  for (svo::Instance& instance : scene.instances)
  {
    instance.receiveShadow = false;
  }
  scene.lights = { light };
  return scene;
}

struct Found
{
  int asked = 0, occluded = 0;
  std::size_t held = 0, heldWhole = 0; // tiles
  std::int64_t rays = 0;
};

/// Looks up what is around points of the scene's receivers that the eye sees.
Found lookUp(const svo::Scene& scene, const svo::View& eye, int resolution)
{
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  svo::FrameSettings settings;
  settings.shadowTechnique = svo::ShadowTechnique::Buffer;
  settings.shadowResolution = resolution;
  settings.wholeShadowBuffers = true;
  svo::CPUTracer whole, some;
  const svo::Frame frame = rendered(whole, scene, eye, settings);
  settings.wholeShadowBuffers = false;
  settings.receiverMaps = true;
  rendered(some, scene, eye, settings);
  Found found;
  found.rays = static_cast<std::int64_t>(some.statistics().shadowRays);
  EXPECT_EQ(some.shadowMaps().size(), whole.shadowMaps().size());
  EXPECT_LE(some.statistics().shadowMemory, whole.statistics().shadowMemory);
  for (std::size_t m = 0; m < std::min(some.shadowMaps().size(), whole.shadowMaps().size()); ++m)
  {
    const svo::ShadowMap &map = some.shadowMaps()[m], &full = whole.shadowMaps()[m];
    found.held += map.texels->held();
    found.heldWhole += full.texels->held();
    for (int k = 0; k < 20000; ++k)
    {
      const svo::Box& box = scene.receivers[static_cast<std::size_t>(k) % scene.receivers.size()];
      const glm::dvec3 x =
        glm::mix(box.low, box.high, glm::dvec3(part(generator), part(generator), part(generator)));
      const glm::dvec4 clip = eye.viewToClip * eye.worldToView * glm::dvec4(x, 1.0);
      const glm::dvec3 seen = 0.5 + 0.5 * glm::dvec3(clip) / clip.w;
      const svo::TexelPlace at = svo::texelPlace(svo::MapGeometry(map.view), x);
      const glm::dvec2 pixel(seen.x * eye.width, seen.y * eye.height);
      if (!(at.inside > 0.0) || clip.w <= 0.0 || !(seen.x > 0.0 && seen.x < 1.0) ||
        !(seen.y > 0.0 && seen.y < 1.0) ||
        seen.z > frame.depth[std::size_t(pixel.y) * eye.width + std::size_t(pixel.x)])
      {
        continue;
      }
      ++found.asked;
      for (int i = 0; i < 49; ++i)
      {
        const int u = std::clamp(static_cast<int>(at.x) + i % 7 - 3, 0, map.view.width - 1);
        const int v = std::clamp(static_cast<int>(at.y) + i / 7 - 3, 0, map.view.width - 1);
        EXPECT_EQ(map.texels->depthAt(u, v), full.texels->depthAt(u, v));
        found.occluded += map.texels->depthAt(u, v) < 1e30f;
      }
      if (testing::Test::HasFailure())
      {
        return found;
      }
    }
  }
  return found;
}
}

TEST(SeenReceivers, OfABodyAllIsAskedFor)
{
  for (const LightCase& c : everyLight())
  {
    SCOPED_TRACE(c.name);
    svo::Scene scene = ballOnGround(c.light);
    scene.receivers = { { { -1.4, -0.6, 0.01 }, { -0.6, 0.6, 0.5 } } };
    const Found found = lookUp(scene, lookAt({ 1, -6, 4 }, 160, 120), 256);
    EXPECT_GT(found.asked, 1000);
    EXPECT_GT(found.occluded, 1000);
    EXPECT_LT(found.held, found.heldWhole / 2);
  }
}

TEST(SeenReceivers, OfAFlatOneTheEyeAsksWhatItSees)
{
  for (const LightCase& c : everyLight())
  {
    SCOPED_TRACE(c.name);
    const svo::View eye = lookAt({ 1, -6, 4 }, 650, 470);
    svo::Scene scene = ballOnGround(c.light);
    scene.instances.push_back( // behind what is seen of the receiver
      instanceOf(makeOctree(square(6.0), 6), 3, movedTo(0.0, 0.0, -0.3)));
    scene.instances.back().receiveShadow = false;
    // The ground hides most of it.
    scene.receivers = { { { -4.0, -4.0, -0.01 }, { 4.0, 4.0, -0.01 } } };
    const Found flat = lookUp(scene, eye, 512);
    EXPECT_GT(flat.asked, 1000);
    EXPECT_GT(flat.occluded, 1000);
    scene.receivers.front().low.z -= 1e-6;
    EXPECT_LT(flat.rays, lookUp(scene, eye, 512).rays);
  }
}

// Of many that fill the picture some are taken whole; of small ones none is.
TEST(SeenReceivers, ManyFlatOnesAreAnsweredToo)
{
  const svo::View eye = lookAt({ 1, -6, 4 }, 320, 240);
  for (const LightCase& c : everyLight())
  {
    for (const bool large : { true, false })
    {
      SCOPED_TRACE(c.name + (large ? ", large" : ", small"));
      svo::Scene scene = ballOnGround(c.light);
      for (int i = 0; i < 64; ++i)
      {
        const double x = large ? -2.0 : -2.0 + 0.5 * (i % 8),
                     y = large ? -2.0 : -2.0 + 0.5 * (i / 8);
        const double edge = large ? 4.0 : 0.4, z = 0.02 + (large ? 0.01 * i : 0.0);
        scene.receivers.push_back({ { x, y, z }, { x + edge, y + edge, z } });
      }
      const Found found = lookUp(scene, eye, 512);
      EXPECT_GT(found.asked, 1000);
      EXPECT_GT(found.occluded, 1000);
    }
  }
}
