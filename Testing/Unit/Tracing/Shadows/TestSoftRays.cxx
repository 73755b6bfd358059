// What samples of lights and hemispheres find of each point: as many as in double, whoever else
// asks.
#include "svoEyeHits.h"
#include "svoHemisphereRays.h"
#include "svoLeafError.h"
#include "svoSampleDirections.h"
#include "svoSampleSequence.h"
#include "svoSoftScenes.h"
#include "svoSoftShadow.h"
#include "svoTileLook.h"
#include "svoWorldSize.h"
#include "svoWorldToOctree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

using namespace svotest;

namespace
{
/// Whether a ray meets any caster, in double. It starts off its surface as sampled rays do.
bool meets(const svo::Scene& scene, const svo::Instance& receiver, const glm::dvec3& at,
  const glm::dvec3& facet, const glm::dvec3& along, double length)
{
  return std::any_of(scene.instances.begin(), scene.instances.end(),
    [&](const svo::Instance& caster)
    {
      const double offset =
        std::max(1e-6 * svo::worldVoxel(caster, 0), 1.2e-7 * svo::worldVoxel(receiver, 0));
      const svo::WorldToOctree toOctree(caster.body->octree, caster.localToWorld);
      const svo::Ray ray{ toOctree.point(at + offset * facet), toOctree.vector(along), 0.0,
        std::min(length, 1e300) };
      return svo::occluded(
        caster.body->octree, ray, { caster.body->leafGeometry, svo::MaximumLevel });
    });
}

/// A pixel's nearest hit, in double.
struct Seen
{
  const svo::Instance* instance = nullptr;
  glm::dvec3 position{ 0.0 }, facet{ 0.0 };
};

Seen seenAt(const svo::Scene& scene, const svo::View& view, int x, int y)
{
  Seen seen;
  double nearest = std::numeric_limits<double>::infinity();
  const glm::dvec3 o = view.rayOrigin(x + 0.5, y + 0.5), d = view.rayDirection(x + 0.5, y + 0.5);
  for (const svo::Instance& instance : scene.instances)
  {
    const svo::Hit hit = hitAlone(instance, view, x, y);
    if (hit && hit.t < nearest)
    {
      nearest = hit.t;
      const svo::Surface& surface = *instance.body->octree.surface();
      const glm::uvec3 t = surface.triangles[hit.primitive];
      const glm::dvec3 a(surface.points[t.x]), b(surface.points[t.y]), c(surface.points[t.z]);
      const glm::dmat3 toWorld(instance.localToWorld); // no scale in these scenes
      const glm::dvec3 normal = glm::normalize(toWorld * glm::cross(b - a, c - a));
      seen = { &instance, o + hit.t * d, glm::dot(normal, d) > 0.0 ? -normal : normal };
    }
  }
  return seen;
}
}

// Of each pixel as many rays are blocked as in double, by 4096 samples: of the light, and of the
// hemisphere.
TEST(SoftRays, AsManyRaysAreBlockedAsInDouble)
{
  constexpr int Samples = 4096;
  const svo::View view = lookAt({ 2, -4, 4 }, 20, 12, 50.0, { 0.2, 0.3, 0.5 });
  svo::Scene scene = ballRingAndGround(svo::LeafGeometry::Triangle);
  scene.lights.resize(1);
  scene.lights[0].size = 1.5;
  const std::vector<double> lit = lightShares(scene, view, sampled(Samples));
  const std::vector<double> closed = closedShares(scene, view, sampled(Samples), 2.0);
  const svo::Light& light = scene.lights[0];
  double rays = 0.0, different = 0.0;
  int partly = 0, partlyClosed = 0;
  const svo::PixelRotations ofLight(view, 0), ofOcclusion(view, ~0u);
  for (int y = 0; y < view.height; ++y)
  {
    for (int x = 0; x < view.width; ++x)
    {
      const std::size_t pixel = static_cast<std::size_t>(y) * view.width + x;
      const Seen seen = seenAt(scene, view, x, y);
      if (!seen.instance)
      {
        continue;
      }
      const auto blocked = [&](const glm::vec3& along, float length) {
        return meets(scene, *seen.instance, seen.position, seen.facet, glm::dvec3(along), length);
      };
      const svo::LightCone cone(light, seen.position);
      const svo::Basis basis{ glm::vec3(seen.facet) };
      int above = 0, met = 0, metAround = 0;
      for (int i = 0; i < Samples; ++i)
      {
        float length;
        const svo::SquarePoint sample = svo::sequencePoint(i);
        const glm::vec3 along = cone.direction(sample + ofLight.at(x, y), length);
        if (glm::dot(glm::dvec3(along), seen.facet) > 0.0)
        {
          ++above;
          met += blocked(along, length);
        }
        metAround += blocked(svo::cosineDirection(basis, sample + ofOcclusion.at(x, y)), 2.0f);
      }
      rays += Samples;
      different += Samples * std::abs(closed[pixel] - metAround / double(Samples));
      partlyClosed += metAround > 0 && metAround < Samples;
      if (glm::dot(light.along(seen.position), seen.facet) < 0.0)
      {
        rays += above;
        different += above * std::abs(1.0 - lit[pixel] - met / double(above));
        partly += met > 0 && met < above;
      }
    }
  }
  EXPECT_GT(partly, 10);
  EXPECT_GT(partlyClosed, 50);
  // Rays that pass an edge within what floats tell apart, 1e-6 of a cube's edge: of edges about as
  // long as the cube's own, before a light and a hemisphere that it covers much of. And sums of
  // 4096 floats.
  EXPECT_LE(different, 1e-4 * rays);
}

namespace
{
/// A wide light, low over a large ground that is seen from aside: of some tiles the way to their
/// casters is shorter than they are.
svo::Scene longTiles()
{
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(square(60.0), 6), 1) };
  scene.instances[0].castShadow = false;
  const svo::Octree ball = makeOctree(sphere(12, 16), 5);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (std::uint64_t i = 0; i < 150; ++i)
  {
    const double x = 3.0 * unit(random) - 9.0, y = 4.0 * unit(random), z = 6.5 + 2.0 * unit(random);
    scene.instances.push_back(
      instanceOf(ball, 2 + i, glm::scale(movedTo(x, y, z), glm::dvec3(0.15))));
    scene.instances.back().visible = false;
  }
  scene.lights = { disc({ 1.0, 0.0, 0.2 }, 60.0) };
  return scene;
}
}

// A point's answer is the same whoever else of its tile asks.
TEST(SoftRays, AnswersDoNotDependOnWhoElseAsks)
{
  svo::Scene balls = ballRingAndGround(svo::LeafGeometry::Triangle);
  balls.lights[0].size = 1.0;
  for (const auto& [scene, view] : { std::pair(longTiles(), lookAt({ -40, 0, 2.5 }, 32, 32, 12.0)),
         std::pair(balls, lookAt({ 3, -6, 3 }, 80, 64)) })
  {
    svo::LayeredView eye;
    prepareEye(eye, scene, view);
    eye.trace(svo::serialFor, nullptr);
    const svo::RayCasters casters(scene, eye.hits().instances);
    const svo::ShadowRays exact(casters);
    const svo::PixelRotations rotations(view, 0);
    const svo::SoftShadow soft(scene.lights[0], exact, casters, rotations, 16);
    const svo::HemisphereRays around(casters, 1.0, rotations, 16);
    const auto closed = [&](const svo::ShadowQuery& query, float* shares)
    {
      std::fill_n(shares, 64, 0.0f);
      around.each(query, [&](int i, const glm::vec3&, float blocked) { shares[i] += blocked; });
    };
    std::vector<svo::SurfaceMatrices> frames(scene.instances.begin(), scene.instances.end());
    const svo::DepthBuffer& depth = eye.hits().depth;
    svo::TilePatch patch;
    svo::TileTriangles triangles;
    int partly = 0, different = 0;
    for (int tile = 0; tile < depth.grid.tilesX * depth.grid.tilesY; ++tile)
    {
      if (!depth.hit[tile])
      {
        continue;
      }
      const svo::TileHits hits =
        svo::hitsOfTile(depth, view, tile % depth.grid.tilesX, tile / depth.grid.tilesX);
      const auto ask = [&, &scene = scene](const svo::TilePatch&)
      {
        svo::lookAtPatch(frames[patch.instance], patch, triangles);
        const svo::PointErrors errors{ 0.0,
          svo::worldLeafError(scene.instances[patch.instance], svo::LeafGeometry::Triangle,
            scene.instances[patch.instance].body->octree.level()) };
        std::uint64_t count = 0;
        float all[2][svo::TilePatch::Most], alone[svo::TilePatch::Most];
        const svo::ShadowQuery together{ patch, errors, nullptr, patch.mask, count };
        soft.test(together, all[0]);
        closed(together, all[1]);
        svo::eachBit(patch.mask,
          [&](int i)
          {
            const svo::ShadowQuery one{ patch, errors, nullptr, std::uint64_t(1) << i, count };
            soft.test(one, alone);
            different += alone[i] != all[0][i];
            partly += alone[i] > 0.0f && alone[i] < 1.0f;
            closed(one, alone);
            different += alone[i] != all[1][i];
          });
      };
      svo::eachPatch(
        view, hits, [](std::uint32_t) { return true; },
        [&](std::uint32_t i) { return eye.hits().base(i); }, patch, ask);
    }
    EXPECT_EQ(0, different);
    EXPECT_GT(partly, 50);
  }
}
