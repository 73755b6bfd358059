// Exact shadows of a tile's points, asked for together, against rays alone.
#include "svoEyeHits.h"
#include "svoIntersect.h"
#include "svoLayeredView.h"
#include "svoLeafError.h"
#include "svoSelectLevel.h"
#include "svoShadowBeam.h"
#include "svoShadowRays.h"
#include "svoTileLook.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

using namespace svotest;

namespace
{
/// Instances of a few meshes, and the octrees that they borrow.
struct Objects
{
  std::vector<Mesh> meshes;
  std::vector<svo::Octree> octrees;
  svo::Scene scene;

  void add(Mesh mesh, int level, const glm::dmat4& place,
    svo::LeafGeometry leaves = svo::LeafGeometry::Triangle)
  {
    this->octrees.push_back(makeOctree(mesh, level));
    this->scene.instances.push_back(
      instanceOf(this->octrees.back(), this->scene.instances.size() + 1, place, leaves));
  }
};

/// A torus over a ground, a mirrored one and a sheared ball in its hole.
Objects rings()
{
  Objects all;
  all.add(square(6.0), 6, movedTo(0, 0, -1.1));
  all.add(torus(40, 24), 8, glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(1, 2, 0)));
  all.add(torus(24, 12), 6, glm::scale(movedTo(0.3, -0.2, 1.6), glm::dvec3(-0.4, 0.4, 0.3)));
  glm::dmat4 shear(1.0);
  shear[1][0] = 0.6;
  all.add(sphere(20, 20), 7, glm::scale(movedTo(0, 0, -0.5) * shear, glm::dvec3(0.45)));
  return all;
}

/// One mesh of a ground and of balls a thousandth as wide: each in very few bricks.
Objects tinyParts()
{
  Mesh mesh = square(400.0);
  const auto add = [&](double radius, const glm::dvec3& centre)
  {
    const Mesh ball = sphere(24, 24);
    const auto first = static_cast<unsigned>(mesh.points.size());
    for (const glm::dvec3& p : ball.points)
    {
      mesh.points.push_back(centre + radius * p);
    }
    for (const glm::uvec3& t : ball.triangles)
    {
      mesh.triangles.push_back(t + first);
    }
  };
  add(0.3, { 0, 0, 0.3 });
  add(0.6, { 1.2, 0.3, 0.6 });
  add(100.0, { 0, 350, 0 });
  Objects all;
  all.add(mesh, 10, glm::dmat4(1.0));
  return all;
}

struct Count
{
  int asked = 0, dark = 0, different = 0, unexplained = 0;
};

/// Points that are listed have the answers that they have as points of a patch.
void expectListAlike(const svo::ShadowRays& rays, const svo::Light& light,
  const svo::TilePatch& patch, double error, std::uint64_t asked, std::uint64_t dark)
{
  std::vector<svo::SurfacePoint> points;
  std::vector<const svo::SurfacePoint*> list;
  points.reserve(svo::ShadowRays::Most);
  std::uint64_t expected = 0;
  svo::eachBit(asked,
    [&](int i)
    {
      expected |= (dark >> i & 1) << points.size();
      points.push_back(patch.point(i));
      list.push_back(&points.back());
    });
  ASSERT_EQ(rays.shadows(light, list.data(), static_cast<int>(list.size()), error), expected);
}

/// Asks for all visible points, tile by tile and one by one.
Count compare(const svo::Scene& scene, const svo::View& view, const svo::Light& light)
{
  svo::LayeredView eye;
  prepareEye(eye, scene, view);
  eye.trace(svo::serialFor, nullptr);
  const svo::RayCasters casters(scene, eye.hits().instances);
  const svo::ShadowRays rays(casters);
  std::vector<svo::SurfaceMatrices> frames;
  double rounding = 0.0;
  for (const svo::Instance& instance : scene.instances)
  {
    frames.emplace_back(instance);
    rounding = std::max(rounding,
      svo::BeamRounding * svo::worldScale(instance.localToWorld) *
        instance.body->octree.rootEdge());
  }
  Count count;
  svo::TilePatch patch;
  svo::TileTriangles triangles;
  const svo::DepthBuffer& depth = eye.hits().depth;
  for (int tile = 0; tile < depth.grid.tilesX * depth.grid.tilesY; ++tile)
  {
    if (!depth.hit[tile])
    {
      continue;
    }
    const svo::TileHits hits =
      svo::hitsOfTile(depth, view, tile % depth.grid.tilesX, tile / depth.grid.tilesX);
    svo::eachPatch(
      view, hits, [](std::uint32_t) { return true; },
      [&](std::uint32_t i) { return eye.hits().base(i); }, patch,
      [&](const svo::TilePatch&)
      {
        svo::lookAtPatch(frames[patch.instance], patch, triangles);
        const svo::Instance& instance = scene.instances[patch.instance];
        const double error =
          svo::worldLeafError(instance, eye.hits().instances.leafGeometry(patch.instance),
            instance.body->octree.level(), eye.hits().instances.placed(patch.instance));
        const std::uint64_t asked = patch.mask & 0xfbfdfeff7fbfdfefull;
        const std::uint64_t dark = rays.shadows(light, patch, error, asked);
        EXPECT_EQ(0u, dark & ~asked);
        expectListAlike(rays, light, patch, error, asked, dark);
        svo::eachBit(asked,
          [&](int i)
          {
            const glm::dvec3 position = patch.position(i);
            const auto alone = [&](const glm::dvec3& at)
            { return rays.shadows(light, at, patch.facet(i), error); };
            const bool isDark = dark >> i & 1;
            ++count.asked;
            count.dark += isDark;
            if (isDark == alone(position))
            {
              return;
            }
            ++count.different;
            // A ray beside it has to have the tile's answer.
            bool explained = false;
            for (int k = 0; k < 27 && !explained; ++k)
            {
              const glm::dvec3 beside(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
              explained = alone(position + rounding * beside) == isDark;
            }
            count.unexplained += !explained;
          });
      });
  }
  return count;
}

void expectAlike(const Objects& objects, const glm::dvec3& eye, const glm::dvec3& at)
{
  const svo::View view = lookAt(eye, 200, 160, 40.0, at);
  for (const LightCase& lit : everyLight())
  {
    SCOPED_TRACE(lit.name);
    const Count count = compare(objects.scene, view, lit.light);
    EXPECT_GT(count.asked, 10000);
    EXPECT_GT(count.dark, 100);
    EXPECT_LT(count.dark, count.asked - 100);
    EXPECT_EQ(0, count.unexplained);
    EXPECT_LE(count.different, count.asked / 10000);
  }
}
}

TEST(ShadowRays, TilesAsRaysAlone)
{
  const Objects objects = rings();
  for (const glm::dvec3& eye :
    { glm::dvec3(3, -5, 3), glm::dvec3(0.2, 0.3, 6), glm::dvec3(5, 4, 0) })
  {
    expectAlike(objects, eye, { 0, 0, 0 });
  }
}

TEST(ShadowRays, CastersThatAreLeftOutAreNotMet)
{
  Objects objects = rings();
  // To the corners of the cubes of these, where their balls end.
  Mesh corners;
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec3 corner(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    for (const glm::dvec3& p : { corner, 0.7 * corner, glm::dvec3(0.8, 0.9, 0.8) * corner })
    {
      corners.points.push_back(p);
    }
    corners.triangles.push_back(glm::uvec3(0, 1, 2) + 3u * i);
  }
  glm::dmat4 sheared = movedTo(0.5, 0.3, 0.2);
  sheared[0][1] = 0.8;
  sheared[2][0] = -0.5;
  objects.add(corners, 6, movedTo(-0.4, 0.2, 0.1));
  objects.add(corners, 6, sheared);
  const svo::Scene& scene = objects.scene;
  const svo::View view = lookAt({ 3, -5, 3 }, 16, 16);
  svo::LayeredView eye;
  prepareEye(eye, scene, view);
  const svo::RayCasters casters(scene, eye.hits().instances);
  const svo::ShadowRays rays(casters);
  // Through every caster, wherever it is.
  const auto met = [&](const glm::dvec3& from, const glm::dvec3& way, double tMin, double tMax)
  {
    bool any = false;
    for (const svo::Instance& instance : scene.instances)
    {
      const svo::WorldToOctree toOctree(instance.body->octree, instance.localToWorld);
      const svo::Ray ray{ toOctree.point(from), toOctree.vector(way), tMin, tMax };
      any = any ||
        svo::occluded(
          instance.body->octree, ray, { svo::LeafGeometry::Triangle, svo::MaximumLevel });
    }
    return any;
  };
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto anywhere = [&](double size)
  { return size * glm::dvec3(unit(random), unit(random), unit(random)); };
  int between = 0, dark = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const glm::dvec3 from = anywhere(2.5), to = from + anywhere(i % 2 ? 0.2 : 4.0);
    const bool blocked = rays.between(from, to, 0.0);
    ASSERT_EQ(blocked, met(from, to - from, 0.0, 1.0)) << i;
    between += blocked;
    const svo::Light light =
      i % 4 < 2 ? lightOf(svo::Light::Kind::Point, to) : lightOf(svo::Light::Kind::Directional, to);
    const bool shadowed = rays.shadows(light, from, glm::vec3(0, 0, 1), 0.0);
    const double last = light.atInfinity() ? 1e300 : 1.0 - 1e-9;
    ASSERT_EQ(shadowed, met(from, -light.along(from), 0.0, last)) << i;
    dark += shadowed;
  }
  EXPECT_GT(between, 1000);
  EXPECT_LT(between, 19000);
  EXPECT_GT(dark, 1000);
  EXPECT_LT(dark, 19000);
}

TEST(ShadowRays, TinyPartsOfALargeMesh)
{
  expectAlike(tinyParts(), { 1.5, -6, 4 }, { 0.8, 0, 0.3 });
}

TEST(ShadowRays, LightsAmongTheCasters)
{
  const Objects objects = rings();
  const svo::View view = lookAt({ 3, -5, 3 }, 200, 160);
  const auto compareWith = [&](const glm::dvec3& light)
  { return compare(objects.scene, view, lightOf(svo::Light::Kind::Point, light)); };
  for (const glm::dvec3& inside :
    { glm::dvec3(0.1, 0.05, 0.3), glm::dvec3(0, 0, -0.5), glm::dvec3(1.0, 0.0, -1.05) })
  {
    const Count count = compareWith(inside);
    EXPECT_GT(count.dark, 100);
    EXPECT_EQ(0, count.unexplained);
    EXPECT_LE(count.different, count.asked / 10000);
  }
  // On the ground, which it then lights or not.
  EXPECT_EQ(0, compareWith({ 1.0, 0.0, -1.1 }).unexplained);
}

TEST(ShadowRays, OtherLeavesOneByOne)
{
  for (const auto leaves : { svo::LeafGeometry::Voxel, svo::LeafGeometry::Plane })
  {
    Objects objects = rings();
    objects.scene.instances[1].body.own().leafGeometry = leaves;
    const Count count = compare(objects.scene, lookAt({ 3, -5, 3 }, 200, 160),
      lightOf(svo::Light::Kind::Directional, { 2, -2, 5 }));
    EXPECT_GT(count.dark, 100);
    EXPECT_EQ(0, count.unexplained);
  }
}
