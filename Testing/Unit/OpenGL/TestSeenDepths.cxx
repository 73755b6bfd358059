// A caster that something seen lies behind, as its light sees the two, is never left out, and
// nothing seen lies deeper in a sun's light than is said: against points of receivers, one by one.
#include "svoSeenDepths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace
{
using svo::Light;
using svo::Outline;

class Scene
{
public:
  explicit Scene(unsigned seed)
    : Random(seed)
  {
    for (int i = 0; i < 60; ++i)
    {
      Outline outline{};
      // Some are smaller than a tile.
      const glm::dvec3 half =
        (seed % 2 && i % 5 < 3 ? 0.03 : 1.0) * (0.1 + 0.4 * glm::abs(this->vector()));
      outline.mesh = outline.cube = { -half, half };
      outline.mesh.high.z = i % 7 == 0 ? outline.mesh.low.z : outline.mesh.high.z; // flat
      outline.cube = outline.mesh;
      outline.localToWorld =
        glm::rotate(glm::translate(glm::dmat4(1.0), (i % 4 == 0 ? 2.0 : 6.0) * this->vector()),
          3.0 * this->number(), this->way());
      outline.casts = 1;
      outline.receives = i % 3 > 0;
      this->outlines.push_back(outline);
    }
    for (std::size_t i = 0; i < this->outlines.size(); ++i)
    {
      this->casters.push_back(i % 4 == 0);
    }
  }
  double number() { return this->Uniform(this->Random); }
  glm::dvec3 vector()
  {
    const double x = this->number(), y = this->number();
    return { x, y, this->number() };
  }
  glm::dvec3 way() { return glm::normalize(this->vector() + glm::dvec3(0.0, 0.0, 1.5)); }
  /// In its box.
  glm::dvec3 pointOf(const Outline& outline)
  {
    const glm::dvec3 at = 0.5 * (this->vector() + 1.0);
    return glm::dvec3(outline.localToWorld *
      glm::dvec4(outline.mesh.low + at * (outline.mesh.high - outline.mesh.low), 1.0));
  }

  std::vector<Outline> outlines;
  std::vector<std::uint8_t> casters;

private:
  std::mt19937 Random;
  std::uniform_real_distribution<double> Uniform{ -1.0, 1.0 };
};

/// Whether the segment meets the outline's box.
bool meets(const Outline& outline, const glm::dvec3& from, const glm::dvec3& to)
{
  const glm::dmat4 toLocal = glm::affineInverse(outline.localToWorld);
  const glm::dvec3 a(toLocal * glm::dvec4(from, 1.0)), b(toLocal * glm::dvec4(to, 1.0));
  double first = 0.0, last = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = (outline.mesh.low[axis] - a[axis]) / (b[axis] - a[axis]);
    const double high = (outline.mesh.high[axis] - a[axis]) / (b[axis] - a[axis]);
    first = std::max(first, std::min(low, high));
    last = std::min(last, std::max(low, high));
  }
  return first <= last;
}

bool sees(const svo::View& eye, const glm::dvec3& point)
{
  const glm::dvec4 clip = eye.viewToClip * eye.worldToView * glm::dvec4(point, 1.0);
  return clip.w > 0.0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w &&
    std::abs(clip.z) <= clip.w;
}

std::vector<Light> lightsOf(Scene& scene)
{
  Light sun;
  sun.kind = Light::Kind::Directional;
  sun.direction = -scene.way();
  Light above;
  above.kind = Light::Kind::Point;
  above.position = 20.0 * scene.way();
  Light within = above;
  within.position = 2.0 * scene.vector();
  Light spot = above;
  spot.direction = -glm::normalize(spot.position);
  spot.kind = Light::Kind::Spot;
  spot.coneAngle = 8.0;
  return { sun, above, within, spot };
}

svo::View eyeOf(Scene& scene, bool parallel)
{
  svo::View eye;
  const glm::dmat4 toView =
    glm::lookAt(8.0 * scene.vector(), scene.vector(), glm::dvec3(0.3, 0.2, 0.9));
  EXPECT_TRUE(svo::makeView(toView,
    parallel ? glm::ortho(-2.0, 2.0, -1.5, 1.5, 0.5, 30.0) : glm::perspective(0.4, 1.5, 0.01, 40.0),
    640, 480, eye));
  return eye;
}

struct Tally
{
  int behind = 0, spared = 0;
};

void compare(Scene& scene, const Light& light, const svo::View& eye, Tally& tally)
{
  const svo::SeenDepths depths(scene.outlines, scene.casters, light, eye);
  std::vector<glm::dvec3> seen;
  for (const Outline& receiver : scene.outlines)
  {
    for (int i = 0; receiver.receives && i < 20; ++i)
    {
      const glm::dvec3 point = scene.pointOf(receiver);
      const glm::dvec3 from = point - light.position;
      const bool lit = !light.hasCone() ||
        glm::dot(from, light.direction) >
          glm::length(from) * std::cos(glm::radians(light.coneAngle));
      if (lit && sees(eye, point))
      {
        seen.push_back(point);
      }
    }
  }
  for (const glm::dvec3& point : seen)
  {
    if (light.atInfinity())
    {
      ASSERT_GE(depths.last(), glm::dot(light.direction, point));
    }
  }
  for (std::size_t i = 0; i < scene.outlines.size(); i += 4)
  {
    const Outline& caster = scene.outlines[i];
    const bool said = depths.behind(caster);
    tally.spared += !said;
    for (const glm::dvec3& point : seen)
    {
      const glm::dvec3 start =
        light.atInfinity() ? point - 100.0 * light.direction : light.position;
      if (meets(caster, start, point))
      {
        ++tally.behind;
        ASSERT_TRUE(said);
      }
    }
  }
}

TEST(SeenDepths, NobodyIsLeftOutWhoseShadowMayBeSeen)
{
  std::array<Tally, 4> tallies;
  for (unsigned seed = 0; seed < 40; ++seed)
  {
    Scene scene(seed);
    const svo::View eye = eyeOf(scene, seed % 4 == 3);
    const std::vector<Light> lights = lightsOf(scene);
    for (std::size_t i = 0; i < lights.size(); ++i)
    {
      compare(scene, lights[i], eye, tallies[i]);
      ASSERT_FALSE(HasFatalFailure()) << "seed " << seed << ", light " << i;
    }
  }
  for (const Tally& tally : tallies)
  {
    EXPECT_GT(tally.behind, 100);
    EXPECT_GT(tally.spared, 40 * 15 / 8) << "it is of use";
  }
}

/// However near to a light, beside what lies however far.
TEST(SeenDepths, CastersBesideALightAreKept)
{
  Scene scene(3);
  Outline shade = scene.outlines[1], card = scene.outlines[1], terrain = scene.outlines[1];
  shade.mesh = shade.cube = { glm::dvec3(-0.1, -0.1, -0.2), glm::dvec3(0.1, 0.1, -0.1) };
  card.mesh = card.cube = { glm::dvec3(-0.1, -0.1, -0.5), glm::dvec3(0.1, 0.1, -0.4) };
  terrain.mesh = terrain.cube = { glm::dvec3(-1e7, -1e7, -20.0), glm::dvec3(1e7, 1e7, -16.0) };
  shade.localToWorld = card.localToWorld = terrain.localToWorld = glm::dmat4(1.0);
  const std::vector<Outline> outlines{ shade, card, terrain };
  svo::View eye;
  ASSERT_TRUE(svo::makeView(
    glm::lookAt(glm::dvec3(0.0, -3.0, -0.3), glm::dvec3(0.0, 0.0, -0.4), glm::dvec3(0, 0, 1)),
    glm::perspective(0.4, 1.5, 0.01, 4.0), 640, 480, eye));
  Light bulb;
  bulb.kind = Light::Kind::Point;
  bulb.position = glm::dvec3(0.0);
  const svo::SeenDepths depths(outlines, { 1, 1, 1 }, bulb, eye);
  EXPECT_TRUE(depths.behind(shade)) << "the card lies in its shadow";
  EXPECT_TRUE(depths.behind(card)) << "and in its own";
}

TEST(SeenDepths, NothingSeenLeavesAllOut)
{
  Scene scene(1);
  for (Outline& outline : scene.outlines)
  {
    outline.receives = 0;
  }
  const svo::View eye = eyeOf(scene, false);
  for (const Light& light : lightsOf(scene))
  {
    const svo::SeenDepths depths(scene.outlines, scene.casters, light, eye);
    EXPECT_FALSE(depths.behind(scene.outlines[0]));
    EXPECT_EQ(depths.last(), -INFINITY);
  }
}

/// Without a view of the light nobody knows.
TEST(SeenDepths, WithoutCastersNobodyIsLeftOut)
{
  Scene scene(2);
  scene.casters.assign(scene.outlines.size(), 0);
  const svo::View eye = eyeOf(scene, false);
  for (const Light& light : lightsOf(scene))
  {
    EXPECT_TRUE(
      svo::SeenDepths(scene.outlines, scene.casters, light, eye).behind(scene.outlines[0]));
  }
}
}
