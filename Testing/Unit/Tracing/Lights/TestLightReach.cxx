// Rays to all of a light with a size are looked up where LightReach says, and no wider than that.
#include "svoCasters.h"
#include "svoLightReach.h"
#include "svoLightView.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace svotest;

namespace
{
struct Rectangle
{
  glm::dvec2 low{ std::numeric_limits<double>::infinity() };
  glm::dvec2 high{ -std::numeric_limits<double>::infinity() };
  bool holds(const glm::dvec2& p, double margin) const
  {
    return glm::all(glm::greaterThanEqual(p, low - margin)) &&
      glm::all(glm::lessThanEqual(p, high + margin));
  }
};

svo::Light sized(svo::Light::Kind kind, const glm::dvec3& position, double size)
{
  svo::Light light = lightOf(kind, position);
  light.size = size;
  return light;
}
}

TEST(LightReach, HoldsRaysToAllOfTheLightAsFarAsSomethingCasts)
{
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(sphere(20, 20), 5), 1, movedTo(0.3, 0.2, 1.5)) };
  const std::vector<svo::Outline> outlines = svo::outlinesOf(scene);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const svo::Light& light : { sized(svo::Light::Kind::Directional, { 0.4, -0.3, 1.0 }, 12.0),
         sized(svo::Light::Kind::Point, { 1.0, -2.0, 6.0 }, 0.7) })
  {
    const std::vector<std::uint8_t> casters = svo::castersOf(outlines, light);
    const svo::LightReach reach(light, outlines, casters);
    const std::vector<svo::View> views =
      svo::fitLight(outlines, casters, light, svo::LightReach(light, outlines, casters), 512);
    ASSERT_EQ(views.size(), 1u);
    const glm::dmat4 toClip = views[0].viewToClip * views[0].worldToView;
    int aside = 0;
    for (int k = 0; k < 20000; ++k)
    {
      const glm::dvec3 point(8.0 * part(generator) - 4.0, 8.0 * part(generator) - 4.0, 0.0);
      Rectangle looked, own;
      reach.add(toClip, point, looked.low, looked.high);
      svo::LightReach().add(toClip, point, own.low, own.high);
      const glm::dvec3 towards = -light.along(point), axis = glm::normalize(towards);
      const glm::dvec3 x = glm::normalize(glm::cross(axis, { 0.1, 1.0, 0.2 }));
      const double angle = 2.0 * Pi * part(generator);
      const glm::dvec3 side = std::cos(angle) * x + std::sin(angle) * glm::cross(axis, x);
      const double sine = light.radius() / glm::length(towards);
      const double rim =
        light.atInfinity() ? light.spread() : light.radius() / std::sqrt(1.0 - sine * sine);
      // As far as the nearest caster is from the light.
      const double end = light.atInfinity()
        ? glm::dot(light.direction, point) - reach.nearest()
        : 1.0 - std::max(reach.nearest(), light.radius()) / glm::length(towards);
      const glm::dvec4 clip = toClip *
        glm::dvec4(point + std::max(end, 0.0) * part(generator) * (towards + rim * side), 1.0);
      const glm::dvec2 at = glm::dvec2(clip) / clip.w;
      EXPECT_TRUE(looked.holds(at, 1e-9));
      aside += !own.holds(at, 1e-3);
    }
    EXPECT_GT(aside, 10000);
  }
}

TEST(LightReach, OfAPointIsItsOwnPlace)
{
  Rectangle looked;
  svo::LightReach().add(glm::dmat4(1.0), { 0.2, -0.4, 0.3 }, looked.low, looked.high);
  EXPECT_EQ(looked.low, glm::dvec2(0.2, -0.4));
  EXPECT_EQ(looked.high, looked.low);
}

TEST(LightReach, ASpotsMapHoldsWhatIsBesideItsCone)
{
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(square(3.0), 5), 1, movedTo(0.0, 0.0, 3.0)) };
  const std::vector<svo::Outline> outlines = svo::outlinesOf(scene);
  svo::Light light = sized(svo::Light::Kind::Spot, { 0.0, 0.0, 6.0 }, 0.0);
  light.direction = { 0.0, 0.0, -1.0 };
  light.coneAngle = 20.0;
  const std::vector<std::uint8_t> casters(1, 1);
  const auto holds = [&](const glm::dvec3& p)
  {
    const std::vector<svo::View> views =
      svo::fitLight(outlines, casters, light, svo::LightReach(light, outlines, casters), 512);
    const glm::dvec4 clip = views[0].viewToClip * views[0].worldToView * glm::dvec4(p, 1.0);
    return std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
  };
  const glm::dvec3 inside(1.0, 0.0, 3.0), beside(1.4, 0.0, 3.0); // the cone ends at 1.09
  EXPECT_TRUE(holds(inside));
  EXPECT_FALSE(holds(beside));
  light.size = 0.5;
  EXPECT_TRUE(holds(beside));
}
