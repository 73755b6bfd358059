// Points against the maps of a light, beside exact rays and closed forms.
#include "svoBallOnGround.h"

#include "svoLayeredView.h"
#include "svoLeafGeometry.h"
#include "svoMapTest.h"
#include "svoReferencePoint.h"
#include "svoShadowBuffer.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace svotest;

namespace
{
/// What is lit by the buffer and not by the rays, or the other way round, more than a pixel away
/// from the edge of the rays' shadow.
struct Comparison
{
  int dark = 0;
  int lit = 0;
  int wrong = 0;
  int wrongNearEdges = 0;
};

Comparison compare(const svo::Scene& scene, const svo::FrameSettings& buffer)
{
  svo::FrameSettings none = buffer;
  none.shadowTechnique = svo::ShadowTechnique::None;
  svo::FrameSettings rays = buffer;
  rays.shadowTechnique = svo::ShadowTechnique::Rays;
  const svo::Frame unshadowed = rendered(scene, Eye, none);
  const svo::Frame exact = rendered(scene, Eye, rays);
  const svo::Frame tested = rendered(scene, Eye, buffer);
  const auto at = [](int x, int y) { return std::size_t(y) * Eye.width + x; };
  const auto reached = [&](int x, int y) { return unshadowed.color[4 * at(x, y)] > 12; };
  const auto isDark = [&](const svo::Frame& frame, int x, int y)
  { return frame.color[4 * at(x, y)] + 5 < unshadowed.color[4 * at(x, y)]; };
  Comparison result;
  for (int y = 1; y + 1 < Eye.height; ++y)
  {
    for (int x = 1; x + 1 < Eye.width; ++x)
    {
      if (!reached(x, y))
      {
        continue;
      }
      const bool dark = isDark(exact, x, y);
      result.dark += dark;
      result.lit += !dark;
      bool edge = false;
      for (int j = -1; j <= 1; ++j)
      {
        for (int i = -1; i <= 1; ++i)
        {
          edge = edge || !reached(x + i, y + j) || isDark(exact, x + i, y + j) != dark ||
            exact.instance[at(x + i, y + j)] != exact.instance[at(x, y)];
        }
      }
      if (isDark(tested, x, y) != dark)
      {
        ++(edge ? result.wrongNearEdges : result.wrong);
      }
    }
  }
  return result;
}
}

TEST(MapTest, AgreesWithShadowRaysAwayFromEdges)
{
  for (const LightCase& c : everyLight())
  {
    for (svo::LeafGeometry leafGeometry :
      { svo::LeafGeometry::Triangle, svo::LeafGeometry::Plane, svo::LeafGeometry::Automatic })
    {
      svo::Scene scene = ballOnGround(leafGeometry);
      scene.lights = { c.light };
      const Comparison found = compare(scene, settingsOf(svo::ShadowTechnique::Buffer));
      EXPECT_GT(found.dark, 300) << c.name;
      EXPECT_GT(found.lit, 2000) << c.name;
      EXPECT_EQ(found.wrong, 0) << c.name << ", leaves " << int(leafGeometry);
      EXPECT_LT(found.wrongNearEdges, (found.dark + found.lit) / 200)
        << c.name << ", leaves " << int(leafGeometry);
    }
  }
}

// A convex body alone casts nothing on its own lit side: whatever is dark there is acne. The body
// is tilted and flattened, the lights near and far, with every leaf geometry and coarse levels.
TEST(MapTest, ALitConvexBodyHasNoAcne)
{
  const svo::Octree ball = makeOctree(sphere(60, 90), 8);
  const glm::dmat4 placed = movedTo(0.2, 0.1, 0.3) *
    glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(0.3, 1.0, 0.2)) *
    glm::scale(glm::dmat4(1.0), glm::dvec3(1.4, 1.0, 0.8));
  const glm::dmat4 toLocal = glm::inverse(placed);
  // Cosine of the light on the true ellipsoid, or -1 where the pixel misses it.
  const auto trueCosine = [&](const svo::Light& light, int x, int y)
  {
    const glm::dvec3 o(toLocal * glm::dvec4(Eye.rayOrigin(x + 0.5, y + 0.5), 1.0));
    const glm::dvec3 d(toLocal * glm::dvec4(Eye.rayDirection(x + 0.5, y + 0.5), 0.0));
    const double half = glm::dot(o, d), a = glm::dot(d, d);
    const double root = half * half - a * (glm::dot(o, o) - 1.0);
    if (!(root > 0.0))
    {
      return -1.0;
    }
    const glm::dvec3 local = o + (-half - std::sqrt(root)) / a * d;
    const glm::dvec3 position(placed * glm::dvec4(local, 1.0));
    const glm::dvec3 normal =
      glm::normalize(glm::dvec3(glm::transpose(toLocal) * glm::dvec4(local, 0.0)));
    const glm::dvec3 towards = light.kind == svo::Light::Kind::Directional
      ? -light.direction
      : glm::normalize(light.position - position);
    return glm::dot(normal, towards);
  };
  for (const LightCase& c : everyLight())
  {
    for (svo::LeafGeometry leafGeometry : { svo::LeafGeometry::Voxel, svo::LeafGeometry::Plane,
           svo::LeafGeometry::Triangle, svo::LeafGeometry::Automatic })
    {
      for (const auto& [pixelError, filter] : { std::pair{ 0.0, false }, { 1.0, false },
             { 4.0, false }, { 0.0, true }, { 1.0, true }, { 4.0, true } })
      {
        svo::Scene scene;
        scene.instances = { instanceOf(ball, 1, placed, leafGeometry) };
        scene.lights = { c.light };
        svo::FrameSettings settings = settingsOf(svo::ShadowTechnique::Buffer);
        settings.pixelError = pixelError;
        settings.filterShadows = filter;
        const svo::Frame shadowed = rendered(scene, Eye, settings);
        settings.shadowTechnique = svo::ShadowTechnique::None;
        const svo::Frame lit = rendered(scene, Eye, settings);
        int acne = 0;
        int faced = 0;
        // A coarse level may show the far side in the outermost of its voxels.
        const int margin = static_cast<int>(pixelError);
        for (std::size_t i = 0; i < lit.instance.size(); ++i)
        {
          const int x = i % Eye.width;
          const int y = i / Eye.width;
          bool faces = lit.instance[i] == 0;
          for (int k = 0; k < 9 && faces; ++k)
          {
            faces = trueCosine(c.light, x + (k % 3 - 1) * margin, y + (k / 3 - 1) * margin) > 0.1;
          }
          faced += faces;
          acne += faces && shadowed.color[4 * i] < lit.color[4 * i];
        }
        EXPECT_GT(faced, 700) << c.name;
        EXPECT_EQ(acne, 0) << c.name << ", leaves " << int(leafGeometry) << ", pixel error "
                           << pixelError << (filter ? ", filtered" : "");
      }
    }
  }
}

// Octrees in which planes stand beside triangles: rays from the one meet the other, and no more of
// them than where all leaves are planes.
TEST(ShadowRays, ALitBodyOfMixedLeavesShadowsItselfNoMoreThanOneOfPlanes)
{
  const svo::Octree ball = makeOctree(sphere(90, 120), 6);
  ASSERT_GT(ball.longestList(), svo::ShortList);
  for (const LightCase& c : everyLight())
  {
    int acne[2] = { 0, 0 };
    for (int k = 0; k < 2; ++k)
    {
      svo::Scene scene;
      scene.instances = { instanceOf(ball, 1, glm::dmat4(1.0),
        k == 0 ? svo::LeafGeometry::Plane : svo::LeafGeometry::Automatic) };
      scene.lights = { c.light };
      svo::FrameSettings settings = settingsOf(svo::ShadowTechnique::Rays);
      settings.pixelError = 0.0;
      const svo::Frame shadowed = rendered(scene, Eye, settings);
      settings.shadowTechnique = svo::ShadowTechnique::None;
      const svo::Frame lit = rendered(scene, Eye, settings);
      int faced = 0;
      for (std::size_t i = 0; i < lit.instance.size(); ++i)
      {
        const bool faces = lit.instance[i] == 0 && lit.color[4 * i] > 40; // n.l above 0.15
        faced += faces;
        acne[k] += faces && shadowed.color[4 * i] < lit.color[4 * i];
      }
      EXPECT_GT(faced, 600) << c.name;
    }
    EXPECT_LE(acne[1], acne[0]) << c.name;
    EXPECT_LE(acne[1], 10) << c.name;
  }
}

// A wall stands on the ground, the light comes from its other side: the ground is dark from where
// it meets the wall on.
TEST(MapTest, AContactShadowStartsWithinTwoVoxels)
{
  svo::Scene scene;
  const int level = 7;
  Mesh wall = square(2.0);
  for (glm::dvec3& p : wall.points)
  {
    p = { p.x, 0.0, p.y + 2.0 };
  }
  for (const auto& [leafGeometry, filter] :
    { std::pair{ svo::LeafGeometry::Plane, false }, { svo::LeafGeometry::Triangle, false },
      { svo::LeafGeometry::Plane, true }, { svo::LeafGeometry::Triangle, true } })
  {
    scene.instances = { instanceOf(
                          makeOctree(square(3.0), level), 1, glm::dmat4(1.0), leafGeometry),
      instanceOf(makeOctree(wall, level), 2, glm::dmat4(1.0), leafGeometry) };
    scene.lights = { lightOf(svo::Light::Kind::Directional, { 0.0, 2.0, 3.0 }) };
    const double voxel = scene.instances[0].body->octree.header().voxelSize;
    svo::FrameSettings settings = settingsOf(svo::ShadowTechnique::Buffer);
    settings.shadowResolution = 2048;
    settings.pixelError = 0.0;
    settings.filterShadows = filter;
    // From straight above a strip beside the wall.
    const svo::View view = [&]
    {
      svo::View v;
      svo::makeView(
        glm::lookAt(glm::dvec3(0, -0.25, 1.0), glm::dvec3(0, -0.25, 0.0), glm::dvec3(0, 1, 0)),
        glm::ortho(-0.25, 0.25, -0.25, 0.25, 0.1, 10.0), 64, 64, v);
      return v;
    }();
    const svo::Frame frame = rendered(scene, view, settings);
    int grounds = 0;
    for (int y = 0; y < 64; ++y)
    {
      for (int x = 0; x < 64; ++x)
      {
        const std::size_t at = std::size_t(y) * 64 + x;
        const double distance = -view.rayOrigin(x + 0.5, y + 0.5).y;
        if (frame.instance[at] == 0 && distance > 2.0 * voxel)
        {
          ++grounds;
          EXPECT_EQ(frame.color[4 * at], 0) << distance / voxel << " voxels from the wall";
        }
      }
    }
    EXPECT_GT(grounds, 1500);
  }
}

// The paper's test has no bias at all, so a lit surface shadows itself; a bias in voxels of the
// caster mends that.
TEST(MapTest, WithoutAutomaticBiasTheTestIsThePapers)
{
  svo::Scene scene = ballOnGround(svo::LeafGeometry::Voxel);
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 2, -2, 5 }) };
  svo::FrameSettings settings = settingsOf(svo::ShadowTechnique::Buffer);
  settings.automaticBias = false;
  const int bare = compare(scene, settings).wrong;
  settings.bias = 6.0;
  const int biased = compare(scene, settings).wrong;
  EXPECT_GT(bare, 500);
  EXPECT_LT(biased, bare / 20);
}

/// Facets of a convex body that face the light, however little, are lit: inside one texel they
/// may be deeper than eight texels are wide.
TEST(MapTest, AConvexBodyInGrazingLightDoesNotShadowItself)
{
  using namespace svo;
  // Facets at all angles to the light; with shared normals, as smooth surfaces have them.
  const svotest::Mesh ball = svotest::sphere(9, 12);
  const Octree octree = svotest::makeOctree(ball, 9);
  std::vector<float> normals;
  for (const glm::dvec3& point : ball.points)
  {
    for (int a = 0; a < 3; ++a)
    {
      normals.push_back(static_cast<float>(point[a]));
    }
  }
  int grazing = 0;
  for (int turn = 0; turn < 24; ++turn)
  {
    const double angle = 0.02 * turn;
    Scene scene;
    scene.instances = { svotest::instanceOf(octree, 1,
      glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0.3, 1.0, 0.2)), LeafGeometry::Automatic) };
    scene.instances[0].body.own().attributes.normals = normals.data();
    scene.instances[0].body.own().attributes.normalAssociation = Association::Point;
    scene.lights = { svotest::lightOf(Light::Kind::Point, { 1.0, -4.0, 1.5 }) };
    const View view = svotest::lookAt({ 3.0, 1.0, 0.5 }, 256, 256, 50.0);
    FrameSettings settings;
    settings.shadowResolution = 512;
    settings.frameCoherence = false;
    LayerBudget budget{ 0, 0 };
    LayeredView eye;
    eye.prepare(
      scene, view, [](const Instance&) { return true; },
      [](const Instance& i, const LocalView&) { return i.body->octree.level(); }, false, budget);
    eye.trace(serialFor, nullptr);
    ShadowBuffer buffer;
    buffer.prepare(scene,
      svo::mapsOfLight(
        svo::outlinesOf(scene), scene.lights[0], settings.shadowResolution, svo::View()),
      0, settings, budget);
    buffer.markAll();
    buffer.trace(serialFor);
    const SurfaceMatrices matrices(scene.instances[0]);
    const DepthBuffer& depth = eye.hits().depth;
    int wrong = 0;
    for (int y = 0; y < view.height; ++y)
    {
      for (int x = 0; x < view.width; ++x)
      {
        const std::size_t at = depth.at(x, y);
        if (!depth.hit[at >> 6] || depth.instance[at] == NoInstance)
        {
          continue;
        }
        const SurfacePoint point = surfacePoint(
          matrices, view, x + 0.5, y + 0.5, eye.hits().base(0) + depth.t[at], depth.primitive[at]);
        const glm::dvec3 towards = glm::normalize(scene.lights[0].position - point.position);
        const double cosine = glm::dot(glm::dvec3(point.facet), towards);
        if (cosine > 0.02)
        {
          grazing += cosine < 0.08;
          wrong += svo::MapTest(buffer.maps()).shadows(point, 0.0) ||
            svo::MapTest(buffer.maps()).darkness(point, 0.0, 0.0) > 0.0f;
        }
      }
    }
    EXPECT_EQ(wrong, 0) << "turned by " << angle;
  }
  EXPECT_GT(grazing, 1000) << "too few to say anything";
}

/// Two bodies side by side make a map with texels that are longer than wide: planes are followed
/// over the longer edge.
TEST(MapTest, FacetsInSlantingLightAreLitWhereTexelsAreNotSquare)
{
  const svo::Octree ball = makeOctree(sphere(9, 12), 8);
  svo::FrameSettings settings = settingsOf(svo::ShadowTechnique::Buffer);
  settings.shadowResolution = 512;
  svo::FrameSettings unshadowed = settingsOf(svo::ShadowTechnique::None);
  const svo::View view = lookAt({ 3, -4, 2 }, 256, 256);
  int faced = 0;
  for (int turn = 0; turn < 24; ++turn)
  {
    svo::Scene scene;
    scene.instances = { instanceOf(ball, 1), instanceOf(ball, 2, movedTo(8, 0, 0)) };
    scene.instances[1].visible = false;
    const double angle = 0.13 * turn;
    scene.lights = { lightOf(
      svo::Light::Kind::Directional, { 0.3, -std::cos(angle), std::sin(angle) }) };
    const svo::Frame lit = rendered(scene, view, unshadowed);
    const svo::Frame shadowed = rendered(scene, view, settings);
    int wrong = 0;
    for (std::size_t i = 0; i < lit.instance.size(); ++i)
    {
      faced += lit.instance[i] == 0 && lit.color[4 * i] > 0;
      wrong += shadowed.color[4 * i] != lit.color[4 * i];
    }
    EXPECT_EQ(wrong, 0) << "turned by " << angle;
  }
  EXPECT_GT(faced, 100000);
}

/// A sheet whose normals stand on the wrong side, as cell normals do under a mirroring matrix: VTK
/// lights the side that is turned away, and so do rays.
TEST(MapTest, FacetsThatTurnTheirBacksOnALightAreNotSpeckled)
{
  Mesh sheet = sphere(32, 32);
  sheet.triangles.resize(sheet.triangles.size() * 5 / 8); // open, so that its inside is seen
  std::vector<float> normals;
  for (const glm::uvec3& t : sheet.triangles)
  {
    const glm::vec3 inwards(-glm::normalize(
      glm::cross(sheet.points[t.y] - sheet.points[t.x], sheet.points[t.z] - sheet.points[t.x])));
    normals.insert(normals.end(), { inwards.x, inwards.y, inwards.z });
  }
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(sheet, 8), 1) };
  scene.instances[0].body.own().attributes.normals = normals.data();
  scene.instances[0].body.own().attributes.normalAssociation = svo::Association::Cell;
  int lit = 0;
  for (const glm::dvec3& from :
    { glm::dvec3(2, -2, 5), glm::dvec3(-2, 3, -1), glm::dvec3(4, 1, -3) })
  {
    scene.lights = { lightOf(svo::Light::Kind::Directional, from) };
    const Comparison found = compare(scene, settingsOf(svo::ShadowTechnique::Buffer));
    lit += found.lit;
    EXPECT_EQ(found.wrong, 0) << "light from " << from.x;
  }
  EXPECT_GT(lit, 2000) << "too few to say anything";
}
