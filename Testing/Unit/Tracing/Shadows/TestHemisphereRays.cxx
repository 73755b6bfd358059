// Ambient occlusion and a sky's light against closed forms.
#include "svoCasterBox.h"
#include "svoSoftScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace svotest;

TEST(HemisphereRays, AmbientOcclusionBesideAWall)
{
  constexpr double Length = 15.0;
  const svo::View view = fromAbove(1.0, 0.25, 64, 8, { 1.0, 0.5, 0 });
  const auto expected = onPixels(view,
    [](const glm::dvec3& at)
    { return besideWall(at.x, 1.0, Length - at.y) + besideWall(at.x, 1.0, Length + at.y); });
  const auto found =
    closedShares(planeUnder({ wall(0.0, 1.0, Length) }), view, sampled(1024), Unlimited);
  expectClosedForm(expected, found, 0.1, 0.49, "wall");
}

TEST(HemisphereRays, AmbientOcclusionInACanyon)
{
  constexpr double Length = 15.0, Half = 0.5, Height = 2.0;
  const svo::View view = fromAbove(Half, 0.25, 64, 8);
  const auto expected = onPixels(view,
    [](const glm::dvec3& at)
    {
      double sum = 0.0;
      for (const double distance : { Half - at.x, Half + at.x })
      {
        sum +=
          besideWall(distance, Height, Length - at.y) + besideWall(distance, Height, Length + at.y);
      }
      return sum;
    });
  const svo::Scene scene = planeUnder({ wall(-Half, Height, Length), wall(Half, Height, Length) });
  expectClosedForm(
    expected, closedShares(scene, view, sampled(1024), Unlimited), 0.76, 0.757, "canyon");
}

// A ball of 96 x 192 facets is smaller than a round one by 1 - cos^2(Pi / 96) < 0.0011 of its disc.
TEST(HemisphereRays, AmbientOcclusionUnderABall)
{
  constexpr double Radius = 1.0, Height = 1.5;
  const svo::View view = fromAbove(3.0, 1.0, 48, 16);
  const auto expected = onPixels(view,
    [](const glm::dvec3& at)
    {
      const double distance = glm::length(at - glm::dvec3(0, 0, Height));
      return Radius * Radius / (distance * distance) * Height / distance;
    });
  const svo::Scene scene = planeUnder({ caster(sphere(96, 192), movedTo(0, 0, Height), 7) });
  expectClosedForm(
    expected, closedShares(scene, view, sampled(1024), Unlimited), 0.05, 0.44, "ball");
}

// A sky's light on an open plane is the mean of its colours by the cosine; under half of it, beside
// a wall without an end, half of that of one colour.
TEST(HemisphereRays, SkyLightOnAnOpenPlane)
{
  svo::Scene scene = planeUnder({});
  scene.lights.clear();
  svo::FrameSettings settings = sampled(1024);
  settings.skyLight = true;
  settings.skyColor = glm::dvec3(0.8, 0.6, 0.4);
  settings.groundColor = glm::dvec3(0.2, 0.3, 0.1);
  settings.skyStrength = 0.5;
  for (const glm::dvec3& up :
    { glm::dvec3(0, 0, 2), glm::dvec3(0, 0, -1), glm::dvec3(3, 0, 4), glm::dvec3(0.0) })
  {
    settings.skyUp = up;
    const svo::Frame frame = rendered(scene, fromAbove(5.0, 5.0, 16, 16), settings);
    const double cosine = up == glm::dvec3(0.0) ? 0.0 : up.z / glm::length(up);
    const glm::dvec3 share(0.5 + cosine / 3.0);
    const glm::dvec3 expected = 0.5 * glm::mix(settings.groundColor, settings.skyColor, share);
    for (std::size_t i = 0; i < frame.instance.size(); ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(expected[c], double(frame.light[3 * i + c]), 0.005 * expected[c]);
      }
    }
  }
}

TEST(HemisphereRays, SkyLightIsWhatIsNotClosedOff)
{
  svo::Instance wall = instanceOf(makeOctree(square(1.0), 4), 2);
  wall.localToWorld =
    glm::scale(glm::rotate(movedTo(0, 6, 0), 0.5 * Pi, glm::dvec3(1, 0, 0)), glm::dvec3(1000.0));
  svo::Scene scene = planeUnder({ wall });
  const svo::View view = fromAbove(5.0, 5.0, 16, 16);
  const std::vector<double> closed = closedShares(scene, view, sampled(1024), 1e6);
  scene.lights.clear();
  svo::FrameSettings settings = sampled(1024);
  settings.skyLight = true;
  settings.skyColor = settings.groundColor = glm::dvec3(1.0);
  const svo::Frame frame = rendered(scene, view, settings);
  std::vector<double> open;
  for (std::size_t i = 0; i < frame.instance.size(); ++i)
  {
    open.push_back(1.0 - double(frame.light[3 * i]));
  }
  // Other samples of the same: as far from each other as two of them may be from what is so.
  EXPECT_LE(Difference(open, closed).rms, 2 * 0.005);
  EXPECT_GT(closed[0], 0.01);
  // What receives no shadows sees all of it.
  scene.instances[0].receiveShadow = false;
  const svo::Frame all = rendered(scene, view, settings);
  EXPECT_NEAR(1.0, double(all.light[0]), 1e-6);
}

TEST(HemisphereRays, AClosedBoxIsDark)
{
  const svo::View view = fromAbove(0.999, 0.999, 48, 48);
  for (const int level : { 1, 4, 7 })
  {
    const svo::Scene scene = planeUnder({ caster(closedBox(), glm::dmat4(1.0), level) });
    for (const double closed : closedShares(scene, view, sampled(256), Unlimited))
    {
      ASSERT_EQ(1.0, closed);
    }
  }
}

TEST(HemisphereRays, AmbientOcclusionEndsAtItsDistance)
{
  // Under a ceiling: what is nearer lies in a cone.
  const svo::View view = fromAbove(1.0, 1.0, 16, 16);
  const svo::Scene under = planeUnder({ caster(square(20.0), movedTo(0, 0, 1)) });
  for (const double distance : { 0.5, 0.999, 1.001, 1.2, 2.0, 5.0 })
  {
    const double closed = distance > 1.0 ? 1.0 - 1.0 / (distance * distance) : 0.0;
    expectClosedForm(std::vector<double>(256, closed),
      closedShares(under, view, sampled(1024), distance), closed, closed,
      "ceiling, " + std::to_string(distance));
  }
  // Beside a wall that is higher: over the plane that cone is a segment of the unit disc (Nusselt).
  const svo::View beside = fromAbove(1.0, 0.25, 64, 8, { 1.0, 0, 0 });
  const auto expected =
    onPixels(beside, [](const glm::dvec3& at) { return segmentShare(at.x / 1.5); });
  expectClosedForm(expected,
    closedShares(planeUnder({ wall(0.0, 2.0, 15.0) }), beside, sampled(1024), 1.5), 0.0, 0.48,
    "wall, near");
}

TEST(HemisphereRays, WithoutADistanceItIsAFifthOfAllCasters)
{
  const svo::Scene scene = planeUnder({ wall(0.0, 1.0, 2.0), wall(3.0, 1.0, 2.0) });
  svo::Box all;
  for (const svo::Instance& instance : scene.instances)
  {
    svo::CasterBox(instance).addTo(all);
  }
  const double diagonal = glm::distance(all.low, all.high);
  // What is around them is no larger than their octrees' cubes, of edge 4, and not the ground's.
  EXPECT_GT(diagonal, std::sqrt(9.0 + 16.0 + 1.0));
  EXPECT_LT(diagonal, std::sqrt(49.0 + 64.0 + 64.0));
  const svo::View view = fromAbove(1.0, 0.25, 32, 8, { 1.0, 0, 0 });
  const auto closed = [&](double distance)
  { return closedShares(scene, view, sampled(64), distance); };
  EXPECT_EQ(closed(0.2 * diagonal), closed(0.0));
  EXPECT_NE(closed(0.2 * diagonal), closed(0.1 * diagonal));
}

TEST(HemisphereRays, AmbientOcclusionDarkensWhatIsAskedFor)
{
  svo::Scene scene = planeUnder({ wall(0.0, 1.0, 15.0) });
  scene.lights = { lightOf(svo::Light::Kind::Directional, { 1, 0, 1 }) }; // past the wall
  scene.instances[0].material.ambient = 0.25f;
  scene.instances[0].material.diffuse = 0.5f;
  const svo::View view = fromAbove(1.0, 0.25, 32, 8, { 1.0, 0, 0 });
  svo::FrameSettings settings = sampled(64);
  const svo::Frame plain = rendered(scene, view, settings);
  const std::vector<double> closed = closedShares(
    [&]
    {
      svo::Scene white = scene;
      white.instances[0].material = svo::Material();
      return white;
    }(),
    view, settings, Unlimited);
  settings.ambientOcclusion = true;
  settings.ambientOcclusionDistance = Unlimited;
  for (const double strength : { 1.0, 0.5, 0.0 })
  {
    for (const bool all : { true, false })
    {
      settings.ambientOcclusionStrength = strength;
      settings.ambientOcclusionOfAllLight = all;
      const svo::Frame frame = rendered(scene, view, settings);
      for (std::size_t i = 0; i < closed.size(); ++i)
      {
        const double darkened = all ? plain.light[3 * i] : 0.25;
        // Of three numbers up to 1.
        ASSERT_NEAR(
          plain.light[3 * i] - strength * closed[i] * darkened, frame.light[3 * i], 3 * 6e-8);
      }
      EXPECT_EQ(strength == 0.0, frame.light == plain.light);
    }
  }
}
