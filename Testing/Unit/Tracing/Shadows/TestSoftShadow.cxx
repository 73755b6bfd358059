// Shadows of lights with a size against closed forms, and energy.
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

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace svotest;

namespace
{
/// Of shares of samples: svo::sampleShare() has them in 4096ths; and of floats.
constexpr double Rounding = 0.5 / 4096 + 1e-6;

/// Where the half plane lies from its edge.
glm::dvec3 beyondEdge(double angle)
{
  return { std::cos(angle), std::sin(angle), 0.0 };
}

/// A half plane at height 1, as far as it matters: what lies beyond its edge through the z axis.
svo::Instance halfPlane(double angle)
{
  return caster(
    square(20.0), glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0, 0, 1)) * movedTo(20, 0, 1));
}

/// What of a light arrives at a point of the plane z = 0 under halfPlane(angle).
double pastEdge(const svo::Light& light, const glm::dvec3& point, double angle)
{
  const glm::dvec3 towards = -light.along(point), axis = glm::normalize(towards);
  const glm::dvec3 beyond = beyondEdge(angle);
  const double sine =
    glm::dot(glm::normalize(beyond + glm::dvec3(0, 0, glm::dot(point, beyond))), axis);
  if (light.atInfinity())
  {
    return segmentShare(sine / (std::sqrt(1.0 - sine * sine) * light.spread()));
  }
  const double share = light.size / glm::length(towards);
  return capShare(sine, std::sqrt(1.0 - share * share));
}

/// Of the light over a half plane whose edge is turned, around where the edge's middle has its
/// shadow; `width`: of what is looked at, to each side.
void expectPenumbra(const svo::Light& light, const glm::dvec3& middle, double width, double turn,
  double low, double high, const std::string& name)
{
  svo::Scene scene = planeUnder({ halfPlane(turn) });
  scene.lights = { light };
  const svo::View view = fromAbove(width, width, 24, 24, { middle.x, middle.y, 0 });
  const auto expected =
    onPixels(view, [&](const glm::dvec3& at) { return pastEdge(light, at, turn); });
  expectClosedForm(expected, lightShares(scene, view, sampled(1024)), low, high,
    name + " turned " + std::to_string(turn));
}
}

TEST(SoftShadow, PenumbraOfADiscAtAStraightEdge)
{
  for (const auto& [towards, angle, turn] :
    { std::tuple(glm::dvec3(0, 0, 1), 0.533, 0.0), std::tuple(glm::dvec3(0, 0, 1), 10.0, 0.4),
      std::tuple(glm::dvec3(0, 0, 1), 10.0, 0.25 * Pi),
      std::tuple(glm::dvec3(0.3, -0.8, 1.5), 25.0, 0.0),
      std::tuple(glm::dvec3(-0.5, 0.2, 1.0), 60.0, 2.0) })
  {
    const svo::Light light = disc(towards, angle);
    const glm::dvec3 middle = -towards / towards.z;
    expectPenumbra(light, middle, 2.0 * glm::dot(middle, middle) * light.spread(), turn, 0.0, 1.0,
      "disc of " + std::to_string(angle));
  }
}

TEST(SoftShadow, PenumbraOfABallAtAStraightEdge)
{
  for (const auto& [position, radius, turn] :
    { std::tuple(glm::dvec3(0, 0, 3), 0.05, 0.0), std::tuple(glm::dvec3(0, 0, 3), 0.4, 0.25 * Pi),
      std::tuple(glm::dvec3(0.5, 0.3, 4), 1.0, 1.0), std::tuple(glm::dvec3(-1, 0, 3), 1.5, 0.0) })
  {
    expectPenumbra(ballLight(position, radius), -position / (position.z - 1.0),
      2.5 * radius / (position.z - 1.0), turn, 0.01, 0.99, "ball of " + std::to_string(radius));
  }
}

namespace
{
struct NamedScene
{
  std::string name;
  svo::Scene scene;
};

/// Surfaces that nothing else shadows, and that shadow nothing of themselves.
std::vector<NamedScene> convexScenes()
{
  static const Mesh coarse = sphere(8, 12), fine = sphere(40, 60);
  static const std::vector<float> coarseNormals = radialNormals(coarse),
                                  fineNormals = radialNormals(fine);
  std::vector<NamedScene> all(4);
  all[0] = { "plane", {} };
  all[0].scene.instances = { instanceOf(makeOctree(square(3.0), 5), 1) };
  all[1] = { "coarse, smooth", {} };
  all[1].scene.instances = { instanceOf(makeOctree(coarse, 6), 1) };
  all[2] = { "fine, smooth", {} };
  all[2].scene.instances = { instanceOf(makeOctree(fine, 7), 1) };
  all[3] = { "facets", {} };
  all[3].scene.instances = { instanceOf(makeOctree(fine, 7), 1) };
  for (const int smooth : { 1, 2 })
  {
    svo::Attributes& attributes = all[smooth].scene.instances[0].body.own().attributes;
    attributes.normals = (smooth == 1 ? coarseNormals : fineNormals).data();
    attributes.normalAssociation = svo::Association::Point;
  }
  return all;
}
}

// A light's energy is VTK's formula for its middle, whatever its size.
TEST(SoftShadow, WhereNothingIsInTheWayTheSizeDoesNotMatter)
{
  for (NamedScene& open : convexScenes())
  {
    for (const LightCase& lit : everyLight())
    {
      for (const glm::dvec3& eye : { glm::dvec3(3, -5, 3), glm::dvec3(-4, 2, 1) })
      {
        const svo::View view = lookAt(eye, 80, 60);
        svo::FrameSettings settings = sampled(7);
        open.scene.lights = { lit.light };
        settings.shadowTechnique = svo::ShadowTechnique::None;
        const svo::Frame unshadowed = rendered(open.scene, view, settings);
        ASSERT_GT(std::count_if(unshadowed.light.begin(), unshadowed.light.end(),
                    [](float l) { return l > 0.0f; }),
          200);
        settings.shadowTechnique = svo::ShadowTechnique::Rays;
        const svo::Frame sharp = rendered(open.scene, view, settings);
        for (const double size : { 0.01, 0.5, 3.0 })
        {
          SCOPED_TRACE(open.name + ", " + lit.name + ", " + std::to_string(size));
          open.scene.lights[0].size = size;
          const svo::Frame soft = rendered(open.scene, view, settings);
          EXPECT_EQ(soft.light, unshadowed.light);
          EXPECT_EQ(soft.light, sharp.light);
          EXPECT_EQ(soft.color, sharp.color);
          EXPECT_EQ(soft.depth, sharp.depth);
        }
      }
    }
  }
}

// Of size 0 nothing is sampled: neither the number of samples matters, nor that of others' lights.
TEST(SoftShadow, LightsWithoutASizeAreAsEver)
{
  const svo::View view = lookAt({ 3, -6, 5 }, 120, 90);
  for (const svo::ShadowTechnique technique :
    { svo::ShadowTechnique::Buffer, svo::ShadowTechnique::Rays, svo::ShadowTechnique::None })
  {
    svo::Scene scene = ballRingAndGround();
    svo::FrameSettings settings;
    settings.shadowTechnique = technique;
    const svo::Frame before = rendered(scene, view, settings);
    settings.lightSamples = 1;
    settings.ambientOcclusionDistance = 3.0;
    settings.ambientOcclusionStrength = 0.7;
    EXPECT_TRUE(identical(before, rendered(scene, view, settings)));
    svo::CPUTracer tracer;
    rendered(tracer, scene, view, settings);
    EXPECT_EQ(
      technique == svo::ShadowTechnique::Buffer ? 2 : 0, tracer.statistics().lightsWithBuffers);
    EXPECT_EQ(technique == svo::ShadowTechnique::Rays ? 2 : 0, tracer.statistics().lightsWithRays);
    // A light that shines nothing, and has a size, changes nothing.
    scene.lights.push_back(ballLight({ 1, 1, 5 }, 1.0));
    scene.lights.back().color = glm::vec3(0.0f);
    scene.lights.back().id = 99;
    const svo::Frame beside = rendered(scene, view, settings);
    EXPECT_EQ(before.color, beside.color);
    EXPECT_EQ(before.depth, beside.depth);
    // A tiny one is the sharp one. An edge of some hundred pixels' length passes a pixel's centre
    // within a millionth of a cube's edge, a hundredth of one of a hundred pixels, hardly ever.
    if (technique == svo::ShadowTechnique::Rays)
    {
      scene.lights.pop_back();
      scene.lights[0].size = 1e-9;
      scene.lights[1].size = 1e-7;
      // So few as tell an edge from chance.
      settings.lightSamples = 4;
      const svo::Frame tiny = rendered(scene, view, settings);
      int different = 0;
      for (std::size_t i = 0; i < tiny.color.size(); i += 4)
      {
        different += !std::equal(&tiny.color[i], &tiny.color[i] + 4, &before.color[i]);
      }
      EXPECT_LE(different, 1);
    }
  }
}

TEST(SoftShadow, TranslucentCastersTakeTheirOpacity)
{
  constexpr int Samples = 256;
  const svo::View view = fromAbove(1.0, 1.0, 16, 16);
  for (const float opacity : { 0.125f, 0.3f, 0.9f })
  {
    svo::Instance first = caster(square(6.0), movedTo(0, 0, 1)), second = first;
    first.opacity = opacity;
    second.localToWorld = movedTo(0, 0, 1.5);
    second.opacity = 0.4f;
    for (const svo::Light& light : { ballLight({ 0, 0, 4 }, 1.0), disc({ 0.5, 0.3, 2 }, 30.0) })
    {
      svo::Scene scene = planeUnder({ first });
      scene.lights = { light };
      for (const double share : lightShares(scene, view, sampled(Samples)))
      {
        ASSERT_NEAR(1.0 - double(opacity), share, Rounding);
      }
      scene = planeUnder({ first, second });
      scene.lights = { light };
      for (const double share : lightShares(scene, view, sampled(Samples)))
      {
        ASSERT_NEAR((1.0 - double(opacity)) * (1.0 - 0.4f), share, Rounding);
      }
    }
    for (const double closed :
      closedShares(planeUnder({ caster(closedBox()) }), view, sampled(16), Unlimited))
    {
      ASSERT_EQ(1.0, closed);
    }
    svo::Instance box = caster(closedBox());
    box.opacity = opacity;
    for (const double closed : closedShares(planeUnder({ box }), view, sampled(Samples), Unlimited))
    {
      ASSERT_NEAR(double(opacity), closed, Rounding);
    }
  }
}

namespace
{
/// The slope of the straight line through (log N, log RMS error) for N = 4, 8, ... 256 samples.
double slopeOfError(
  const std::vector<double>& expected, const std::function<std::vector<double>(int)>& found)
{
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (int samples = 4; samples <= 256; samples *= 2)
  {
    const double rms = Difference(expected, found(samples)).rms;
    const double logN = std::log(samples), logError = std::log(rms);
    n += 1.0;
    x += logN;
    y += logError;
    xx += logN * logN;
    xy += logN * logError;
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return slope;
}
}

// That of random samples, 1 / sqrt(N), falls with a slope of -0.5; the bar is -0.7.
TEST(SoftShadow, ErrorsFallFasterThanThoseOfRandomSamples)
{
  for (const double turn : { 0.0, 0.4, 0.25 * Pi, 0.75 * Pi })
  {
    svo::Scene scene = planeUnder({ halfPlane(turn) });
    for (const svo::Light& light : { disc({ 0, 0, 1 }, 20.0), ballLight({ 0, 0, 4 }, 0.5) })
    {
      scene.lights = { light };
      const double half = 0.6 * (light.atInfinity() ? light.spread() : 0.5 / 3.0);
      const svo::View view = fromAbove(half, half, 48, 48); // all of it in the penumbra, nearly
      const auto expected =
        onPixels(view, [&](const glm::dvec3& at) { return pastEdge(light, at, turn); });
      EXPECT_LE(slopeOfError(expected,
                  [&](int samples) { return lightShares(scene, view, sampled(samples)); }),
        -0.7)
        << turn << (light.atInfinity() ? ", disc" : ", ball");
    }
  }
  const svo::View view = fromAbove(1.0, 0.33, 96, 32, { 1.0, 0, 0 });
  const svo::Scene walled = planeUnder({ wall(0.0, 1.0, 15.0) });
  const auto expected = onPixels(view,
    [](const glm::dvec3& at)
    { return besideWall(at.x, 1.0, 15.0 - at.y) + besideWall(at.x, 1.0, 15.0 + at.y); });
  EXPECT_LE(slopeOfError(expected,
              [&](int samples) { return closedShares(walled, view, sampled(samples), Unlimited); }),
    -0.7);
}
