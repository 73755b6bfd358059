// Translucent casters against a reference in double precision: the product, over the casters, of
// what each leaves of a ray from the light, by the nearest hit of one ray and the colours there.
#include "svoCPUTracer.h"
#include "svoCasters.h"
#include "svoIntersect.h"
#include "svoLightDetail.h"
#include "svoTracerScenes.h"
#include "svoTranslucentGroups.h"
#include "svoWorldToOctree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace svotest;

namespace
{
const svo::View Eye = lookAt({ 1, -6, 5 }, 160, 120);

/// Casters over a ground that is all that is seen, and the arrays that they borrow.
struct Objects
{
  svo::Scene scene;
  std::vector<unsigned char> byPoint, byCell, table;
  std::vector<float> coordinates;

  Objects()
  {
    this->scene.instances = { instanceOf(makeOctree(square(6.0), 7), 1) };
    this->scene.instances.front().castShadow = false;
  }

  svo::Instance& add(const Mesh& mesh, const glm::dmat4& place, float opacity)
  {
    std::vector<svo::Instance>& all = this->scene.instances;
    all.push_back(instanceOf(makeOctree(mesh, 8), all.size() + 1, place));
    all.back().visible = all.back().receiveShadow = false;
    all.back().opacity = opacity;
    return all.back();
  }

  /// One of each way to be translucent, some in front of others, one that is opaque.
  void addAll()
  {
    const Mesh ball = sphere(40, 60), ring = torus(60, 30);
    const auto small = [](double x, double y, double z, double size)
    { return glm::scale(movedTo(x, y, z), glm::dvec3(size)); };
    this->scene.instances.reserve(10);
    this->add(ball, small(0.0, 0.0, 1.4, 0.5), 0.5f);
    this->add(ring, small(0.5, 0.2, 0.7, 0.5), 0.25f);
    this->add(ball, small(-0.7, -0.6, 0.5, 0.3), 1.0f);
    const auto alpha = [](std::size_t i) { return static_cast<unsigned char>(i * 7 % 256); };
    svo::Instance& points = this->add(ball, small(1.2, -0.8, 1.0, 0.5), 0.9f);
    for (std::size_t i = 0; i < ball.points.size(); ++i)
    {
      const double z = ball.points[i].z;
      this->byPoint.insert(
        this->byPoint.end(), { 9, 8, 7, static_cast<unsigned char>(127.5 + 127.0 * z) });
    }
    points.mappedOpacity = true;
    points.body.own().attributes.colors = this->byPoint.data();
    points.body.own().attributes.colorAssociation = svo::Association::Point;
    svo::Instance& cells = this->add(square(0.6), movedTo(-1.2, 0.9, 0.8), 1.0f);
    this->byCell = { 1, 2, 3, 40, 1, 2, 3, 200 };
    cells.mappedOpacity = true;
    cells.body.own().attributes.colors = this->byCell.data();
    cells.body.own().attributes.colorAssociation = svo::Association::Cell;
    svo::Instance& texels = this->add(ring, small(-1.3, -0.9, 1.1, 0.5), 1.0f);
    for (const glm::dvec3& p : ring.points)
    {
      this->coordinates.push_back(static_cast<float>(0.5 + 0.3 * p.x));
      this->coordinates.push_back(0.0f);
    }
    for (std::size_t i = 0; i < 16; ++i)
    {
      this->table.insert(this->table.end(), { 5, 5, 5, alpha(i) });
    }
    texels.mappedOpacity = true;
    texels.body.own().attributes.colorAssociation = svo::Association::Point;
    texels.body.own().attributes.colorCoordinates = this->coordinates.data();
    texels.body.own().attributes.colorTexture = this->table.data();
    texels.body.own().attributes.colorTextureSize = 8;
  }
};

double alphaAt(const svo::Instance& instance, const svo::Hit& hit, const glm::dvec3& at)
{
  const svo::Attributes& a = instance.body->attributes;
  const svo::Surface& surface = *instance.body->octree.surface();
  const glm::uvec3 t = surface.triangles[hit.primitive];
  const glm::dvec3 p(surface.points[t.x]), e1(glm::dvec3(surface.points[t.y]) - p),
    e2(glm::dvec3(surface.points[t.z]) - p), n = glm::cross(e1, e2), way = at - p;
  const double v = glm::dot(glm::cross(way, e2), n) / glm::dot(n, n);
  const double w = glm::dot(glm::cross(e1, way), n) / glm::dot(n, n);
  const auto mix = [&](double x, double y, double z) { return (1 - v - w) * x + v * y + w * z; };
  if (a.colorCoordinates)
  {
    const auto x = [&](unsigned i) { return static_cast<double>(a.colorCoordinates[2 * i]); };
    const int texel = std::clamp(static_cast<int>(mix(x(t.x), x(t.y), x(t.z)) * a.colorTextureSize),
      0, a.colorTextureSize - 1);
    return a.colorTexture[4 * texel + 3] / 255.0;
  }
  const auto alpha = [&](unsigned i) { return a.colors[4 * i + 3] / 255.0; };
  return a.colorAssociation == svo::Association::Cell
    ? alpha(surface.cells.empty() ? hit.primitive : surface.cells[hit.primitive])
    : mix(alpha(t.x), alpha(t.y), alpha(t.z));
}

/// What reaches a point of the ground, 0..1.
double reached(const svo::Scene& scene, const svo::Light& light, const glm::dvec3& point)
{
  double left = 1.0;
  for (const svo::Instance& instance : scene.instances)
  {
    if (!instance.castShadow)
    {
      continue;
    }
    const glm::dvec3 from =
      light.atInfinity() ? point - 50.0 * glm::normalize(light.direction) : light.position;
    const svo::WorldToOctree toOctree(instance.body->octree, instance.localToWorld);
    const svo::Ray ray{ toOctree.point(from), toOctree.vector(point - from), 0.0, 1.0 - 1e-6 };
    const svo::Hit hit = svo::intersect(
      instance.body->octree, ray, { svo::LeafGeometry::Triangle, svo::MaximumLevel });
    if (hit)
    {
      left *= 1.0 -
        instance.opacity *
          (instance.mappedOpacity ? alphaAt(instance, hit, ray.origin + hit.t * ray.direction)
                                  : 1.0);
    }
  }
  return left;
}

/// The reference for each pixel, and what the tracer says: shadowed over unshadowed.
struct Answers
{
  std::vector<double> expected, found;

  /// Largest change of the reference within so many pixels of one.
  double change(int x, int y, int reach) const
  {
    double most = 0.0;
    for (int j = std::max(y - reach, 0); j <= std::min(y + reach, Eye.height - 1); ++j)
    {
      for (int i = std::max(x - reach, 0); i <= std::min(x + reach, Eye.width - 1); ++i)
      {
        most = std::max(
          most, std::abs(this->expected[j * Eye.width + i] - this->expected[y * Eye.width + x]));
      }
    }
    return most;
  }
};

Answers ask(svo::Scene scene, const svo::Light& light, svo::FrameSettings settings)
{
  scene.lights = { light };
  settings.writeLight = true;
  const svo::Frame shadowed = rendered(scene, Eye, settings);
  settings.shadowTechnique = svo::ShadowTechnique::None;
  const svo::Frame plain = rendered(scene, Eye, settings);
  Answers answers;
  for (int y = 0; y < Eye.height; ++y)
  {
    for (int x = 0; x < Eye.width; ++x)
    {
      const std::size_t i = std::size_t(y) * Eye.width + x;
      const glm::dvec3 o = Eye.rayOrigin(x + 0.5, y + 0.5), d = Eye.rayDirection(x + 0.5, y + 0.5);
      const bool hit = plain.instance[i] == 0 && plain.light[3 * i] > 0.01f;
      answers.expected.push_back(hit ? reached(scene, light, o - o.z / d.z * d) : 1.0);
      answers.found.push_back(hit ? shadowed.light[3 * i] / plain.light[3 * i] : 1.0);
    }
  }
  return answers;
}

svo::FrameSettings settingsOf(svo::ShadowTechnique technique, bool filter = false)
{
  svo::FrameSettings settings;
  settings.shadowTechnique = technique;
  settings.shadowResolution = 1024;
  settings.filterShadows = filter;
  return settings;
}

/// Pixels whose shadow is neither none nor whole, for a sound reference.
int partly(const Answers& answers)
{
  return static_cast<int>(std::count_if(answers.expected.begin(), answers.expected.end(),
    [](double left) { return left > 0.02 && left < 0.98; }));
}
}

TEST(TranslucentShadows, RaysMultiplyWhatEachCasterLeaves)
{
  Objects objects;
  objects.addAll();
  for (const LightCase& c : everyLight())
  {
    const Answers answers = ask(objects.scene, c.light, settingsOf(svo::ShadowTechnique::Rays));
    EXPECT_GT(partly(answers), 1000) << c.name;
    int wrong = 0;
    for (std::size_t i = 0; i < answers.found.size(); ++i)
    {
      wrong += std::abs(answers.found[i] - answers.expected[i]) > 1e-3;
    }
    // Only where a ray passes an edge, of a caster or of a cell or texel of its colours.
    EXPECT_LE(wrong, 6) << c.name;
  }
}

TEST(TranslucentShadows, BuffersDoAwayFromEdges)
{
  Objects objects;
  objects.addAll();
  for (const LightCase& c : everyLight())
  {
    for (const bool filter : { false, true })
    {
      const Answers answers =
        ask(objects.scene, c.light, settingsOf(svo::ShadowTechnique::Buffer, filter));
      int asked = 0, partial = 0, wrong = 0;
      for (int y = 0; y < Eye.height; ++y)
      {
        for (int x = 0; x < Eye.width; ++x)
        {
          const std::size_t i = std::size_t(y) * Eye.width + x;
          if (answers.change(x, y, 1) < 0.1)
          {
            ++asked;
            partial += answers.expected[i] > 0.02 && answers.expected[i] < 0.98;
            // A texel is narrower than a pixel: what changes by less than a tenth from pixel to
            // pixel is off by less than that.
            wrong += std::abs(answers.found[i] - answers.expected[i]) > 0.05;
          }
        }
      }
      EXPECT_GT(partial, 700) << c.name;
      EXPECT_LE(wrong, asked / 2000) << c.name << (filter ? ", filtered" : "");
    }
  }
}

// From nothing to opaque: the share that is missed is the opacity, and at the end the picture is
// that of an opaque caster.
TEST(TranslucentShadows, AFadeIsLinearAndEndsOpaque)
{
  for (const svo::ShadowTechnique technique :
    { svo::ShadowTechnique::Buffer, svo::ShadowTechnique::Rays })
  {
    for (const bool filter : { false, true })
    {
      Objects objects;
      svo::Instance& ring =
        objects.add(torus(60, 30), glm::scale(movedTo(0, 0, 1), glm::dvec3(0.7)), 1.0f);
      svo::Scene& scene = objects.scene;
      scene.lights = { everyLight().front().light };
      svo::FrameSettings settings = settingsOf(technique, filter);
      settings.writeLight = true;
      const svo::Frame opaque = rendered(scene, Eye, settings);
      scene.instances.back().castShadow = false;
      const svo::Frame none = rendered(scene, Eye, settings);
      ring.castShadow = true;
      svo::CPUTracer tracer; // one for all frames of the fade
      for (const float opacity : { 0.0f, 0.25f, 0.5f, 0.99f, 0.9999999f })
      {
        ring.opacity = opacity;
        const svo::Frame frame = rendered(tracer, scene, Eye, settings);
        double most = 0.0;
        for (std::size_t i = 0; i < frame.light.size(); ++i)
        {
          const double expected =
            none.light[i] + double(opacity) * (double(opaque.light[i]) - none.light[i]);
          most = std::max(most, std::abs(frame.light[i] - expected));
        }
        EXPECT_LT(most, 1e-6) << opacity;
      }
    }
  }
}

// What is kept from frame to frame knows of opacities and of colours that change in place.
TEST(TranslucentShadows, KeptFramesAreThoseOfANewTracer)
{
  for (const svo::ShadowTechnique technique :
    { svo::ShadowTechnique::Buffer, svo::ShadowTechnique::Rays })
  {
    for (const bool filter : { false, true })
    {
      Objects objects;
      objects.addAll();
      svo::Scene& scene = objects.scene;
      scene.lights = { everyLight()[0].light, everyLight()[2].light };
      scene.lights[1].id = 78;
      svo::FrameSettings settings = settingsOf(technique, filter);
      settings.shadowResolution = 256;
      svo::CPUTracer tracer;
      svo::Frame kept;
      const auto render = [&](const std::string& what)
      {
        const svo::Frame before =
          std::exchange(kept, rendered(tracer, scene, Eye, settings, raggedFor(3)));
        EXPECT_TRUE(identical(kept, rendered(scene, Eye, settings))) << what;
        EXPECT_FALSE(before.width > 0 && identical(kept, before)) << what << ": it is seen";
      };
      render("the first");
      scene.instances[1].opacity = 0.8f;
      render("another opacity");
      for (std::size_t i = 3; i < objects.byPoint.size(); i += 4)
      {
        objects.byPoint[i] = static_cast<unsigned char>(255 - objects.byPoint[i]);
      }
      scene.instances[4].body.own().attributes.version += 1;
      render("other colours");
      scene.instances[2].localToWorld = movedTo(0.3, 0.0, 0.0) * scene.instances[2].localToWorld;
      render("another place");
      scene.instances[1].opacity = 1.0f;
      render("opaque");
      scene.instances[5].castShadow = false;
      render("one that casts nothing");
    }
  }
}

TEST(TranslucentShadows, GroupsKeepApartWhatLiesOverEachOther)
{
  const svo::Light sun = lightOf(svo::Light::Kind::Directional, { 0, 0, 5 });
  const auto groupsOf = [&](const std::vector<glm::dvec3>& places, int& groups)
  {
    Objects objects;
    for (const glm::dvec3& p : places)
    {
      objects.add(sphere(12, 16), glm::scale(movedTo(p.x, p.y, p.z), glm::dvec3(0.2)), 0.5f);
    }
    const std::vector<svo::Outline> outlines = svo::outlinesOf(objects.scene);
    std::vector<std::uint8_t> casters = svo::castersOf(outlines, sun);
    const std::vector<svo::View> views = svo::mapsOfLight(outlines, sun, 512, svo::View()).views;
    groups = svo::groupTranslucent(outlines, views, casters);
    EXPECT_EQ(casters.front(), 0); // the ground casts nothing
    return std::vector<int>(casters.begin() + 1, casters.end());
  };
  int groups = 0;
  EXPECT_EQ(
    groupsOf({ { -1, 0, 1 }, { 0, 0, 1 }, { 1, 0, 2 } }, groups), (std::vector<int>{ 2, 2, 2 }));
  EXPECT_EQ(groups, 1);
  EXPECT_EQ(groupsOf({ { 0, 0, 1 }, { 0, 0, 2 }, { 1, 0, 2 }, { 0.1, 0, 3 } }, groups),
    (std::vector<int>{ 2, 3, 2, 4 }));
  EXPECT_EQ(groups, 3);
  const std::vector<int> many = groupsOf(
    { { 0, 0, 1 }, { 0, 0, 2 }, { 0, 0, 3 }, { 0, 0, 4 }, { 0, 0, 5 }, { 0, 0, 6 } }, groups);
  EXPECT_EQ(many, (std::vector<int>{ 2, 3, 4, 5, 2, 3 }));
  EXPECT_EQ(groups, svo::MostTranslucentGroups);
}

// Of more casters over each other than there are groups, each light ray knows the nearest one of
// each group: nothing else is lost.
TEST(TranslucentShadows, MoreCastersThanGroups)
{
  const svo::Light sun = lightOf(svo::Light::Kind::Directional, { 0, 0, 5 });
  Objects objects;
  objects.scene.instances.reserve(8);
  for (int i = 0; i < 6; ++i)
  {
    objects.add(square(0.5), movedTo(0.0, 0.0, 0.5 + 0.3 * i), 0.2f);
  }
  const Answers buffers = ask(objects.scene, sun, settingsOf(svo::ShadowTechnique::Buffer));
  const Answers rays = ask(objects.scene, sun, settingsOf(svo::ShadowTechnique::Rays));
  const double least = *std::min_element(buffers.found.begin(), buffers.found.end());
  EXPECT_NEAR(least, std::pow(0.8, svo::MostTranslucentGroups), 1e-5);
  EXPECT_NEAR(*std::min_element(rays.found.begin(), rays.found.end()), std::pow(0.8, 6), 1e-5);
}

TEST(TranslucentShadows, IntensityCountsLast)
{
  const svo::Light sun = lightOf(svo::Light::Kind::Directional, { 0, 0, 5 });
  Objects objects;
  objects.scene.instances.reserve(8);
  objects.add(square(0.5), movedTo(0.0, 0.0, 0.5), 0.5f);
  objects.add(square(0.5), movedTo(0.0, 0.0, 1.0), 0.5f);
  svo::FrameSettings settings = settingsOf(svo::ShadowTechnique::Buffer);
  settings.shadowIntensity = 0.6;
  const Answers answers = ask(objects.scene, sun, settings);
  EXPECT_NEAR(
    *std::min_element(answers.found.begin(), answers.found.end()), 1.0 - 0.6 * 0.75, 1e-5);
}
