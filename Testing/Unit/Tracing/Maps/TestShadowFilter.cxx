// What a filtered shadow buffer says at the edge of a shadow, in it, beside it and where it begins.
#include "svoShadowFilter.h"
#include "svoTracerScenes.h"

#include "svoMapTest.h"
#include "svoShadowBuffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace svotest;

namespace
{
constexpr int Resolution = 128;

/// A ground at z = 0 and something above it or on it, in directional light from `towards`.
struct Place
{
  svo::Scene scene;
  svo::ShadowBuffer buffer;
  glm::dmat4 worldToMap{ 1.0 }; // x and y: texels
  double texel = 0.0;           // edge, world

  Place(const Mesh& caster, const glm::dvec3& towards, bool automaticBias = true, double bias = 0.0)
  {
    scene.instances = { instanceOf(makeOctree(square(3.0), 9), 1),
      instanceOf(makeOctree(caster, 9), 2) };
    scene.lights = { lightOf(svo::Light::Kind::Directional, 5.0 * towards) };
    svo::FrameSettings settings;
    settings.shadowResolution = Resolution;
    settings.automaticBias = automaticBias;
    settings.bias = bias;
    settings.frameCoherence = false;
    // The ground casts, too: else its map would hold nothing that it could be mistaken for.
    scene.receivers = { { glm::dvec3(-9.0), glm::dvec3(9.0) } };
    svo::LayerBudget budget{ 0, 0 };
    buffer.prepare(scene,
      svo::mapsOfLight(
        svo::outlinesOf(scene), scene.lights[0], settings.shadowResolution, svo::View()),
      0, settings, budget);
    buffer.markAll();
    buffer.trace(svo::serialFor);
    std::vector<svo::ShadowMap> maps;
    buffer.copyMaps(0, maps);
    const svo::View& view = maps.front().view;
    texel = std::min(glm::length(view.originX), glm::length(view.originY));
    worldToMap = glm::scale(glm::dmat4(1.0), glm::dvec3(0.5 * view.width, 0.5 * view.height, 1.0)) *
      glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 1.0, 0.0)) * view.viewToClip *
      view.worldToView;
  }

  static svo::SurfacePoint pointOf(const glm::dvec3& position, const glm::vec3& normal)
  {
    return { position, normal, normal, glm::vec3(1.0f), false };
  }
  double onGround(double x, double y, double extent = 0.0) const
  {
    return svo::MapTest(buffer.maps()).darkness(pointOf({ x, y, 0.0 }, { 0, 0, 1 }), 0.0, extent);
  }
  bool hardOnGround(double x, double y) const
  {
    return svo::MapTest(buffer.maps()).shadows(pointOf({ x, y, 0.0 }, { 0, 0, 1 }), 0.0);
  }
};

Mesh turned(Mesh mesh, double angle, const glm::dvec3& moved)
{
  for (glm::dvec3& p : mesh.points)
  {
    p = glm::dvec3(std::cos(angle) * p.x - std::sin(angle) * p.y,
          std::sin(angle) * p.x + std::cos(angle) * p.y, p.z) +
      moved;
  }
  return mesh;
}

/// The sides, the bottom and the top of a box on the ground.
Mesh boxOf(double half, double height)
{
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
  {
    mesh.points.push_back({ i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? height : 0.0 });
  }
  mesh.triangles = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
    { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  return mesh;
}

Mesh wall()
{
  Mesh mesh = square(2.0);
  for (glm::dvec3& p : mesh.points)
  {
    p = { p.x, 0.0, p.y + 2.0 };
  }
  return mesh;
}

glm::dvec3 lightFrom(double elevation, double turn)
{
  const double e = glm::radians(elevation), a = glm::radians(turn);
  return { std::sin(a) * std::cos(e), -std::cos(a) * std::cos(e), std::sin(e) };
}
}

TEST(TexelWindow, WeightsAddUpAndChangeSmoothly)
{
  constexpr int Size = 16;
  for (double width : { 1.0, 1.3, 2.0, 3.7, 4.0 })
  {
    double before[Size] = {};
    for (int step = 0; step < 16000; ++step)
    {
      const double place = 0.001 * step;
      svo::TexelWindow window(place, width, 0, Size);
      window.weigh();
      ASSERT_GE(window.first, 0);
      ASSERT_GT(window.count, 0);
      ASSERT_LE(window.first + window.count, Size);
      double weights[Size] = {};
      double sum = 0.0, mean = 0.0;
      for (int i = 0; i < window.count; ++i)
      {
        ASSERT_GE(window.weight[i], -1e-15);
        weights[window.first + i] = window.weight[i];
        sum += window.weight[i];
        mean += window.weight[i] * (window.first + i + 0.5);
      }
      ASSERT_NEAR(sum, 1.0, 1e-12);
      if (place > 3.0 && place < Size - 3.0)
      {
        ASSERT_NEAR(mean, place, 1e-9) << "the window is even on both sides";
      }
      for (int i = 0; i < Size && step > 0; ++i)
      {
        ASSERT_LT(std::abs(weights[i] - before[i]), 0.002) << "width " << width;
      }
      std::copy(weights, weights + Size, before);
    }
  }
}

TEST(TexelWindow, OfOneTexelIsAQuadraticSpline)
{
  svo::TexelWindow window(5.25, 1.0, 0, 16);
  window.weigh();
  ASSERT_EQ(window.first, 4);
  ASSERT_EQ(window.count, 3);
  EXPECT_NEAR(window.weight[0], 0.5 * 0.75 * 0.75, 1e-15);
  EXPECT_NEAR(window.weight[1], 0.5 + 0.25 * 0.75, 1e-15);
  EXPECT_NEAR(window.weight[2], 0.5 * 0.25 * 0.25, 1e-15);
}

// The shadow of a slanting straight edge high above the ground, along the edge's normal: it never
// grows darker outwards, and is the share of a texel around the point that the edge covers, to half
// a texel, as a texel knows no better where in it the edge is. On average over the edge there is no
// such error.
TEST(ShadowFilter, AStraightEdgeIsARampAtTheTruePlace)
{
  for (double angle : { 0.0, 0.11, 0.3, 0.6, 0.7854 })
  {
    const Place place(turned(square(1.0), angle, { 0, 0, 1.0 }), lightFrom(90.0, 0.0));
    const glm::dvec2 normal(std::cos(angle), std::sin(angle)), along(-normal.y, normal.x);
    double sum = 0.0, squares = 0.0, hardSquares = 0.0;
    int count = 0;
    for (int k = 0; k < 200; ++k)
    {
      const glm::dvec2 foot = normal + (-0.7 + 0.007 * k) * along;
      double before = 1.0;
      for (int step = 0; step <= 80; ++step)
      {
        const double away = (step - 40) / 16.0; // texels
        const glm::dvec2 p = foot + away * place.texel * normal;
        const double darkness = place.onGround(p.x, p.y);
        ASSERT_GE(darkness, 0.0);
        ASSERT_LE(darkness, before + 1e-6) << "angle " << angle << ", " << away << " texels";
        before = darkness;
        // The share of a texel around the point that lies in the shadow.
        double covered = 0.0;
        for (int s = 0; s < 64; ++s)
        {
          const glm::dvec2 d((s % 8 - 3.5) / 8.0, (s / 8 - 3.5) / 8.0);
          covered += glm::dot(d, normal) + away < 0.0;
        }
        covered /= 64.0;
        ASSERT_NEAR(darkness, covered, 0.5) << "angle " << angle << ", " << away << " texels";
        sum += darkness - covered;
        squares += (darkness - covered) * (darkness - covered);
        hardSquares += std::pow(place.hardOnGround(p.x, p.y) - covered, 2);
        ++count;
      }
      EXPECT_EQ(before, 0.0);
    }
    if (angle > 0.0)
    {
      EXPECT_NEAR(sum / count, 0.0, 0.01) << "angle " << angle;
      EXPECT_LT(squares, 0.4 * hardSquares) << "angle " << angle;
    }
  }
}

TEST(ShadowFilter, AwayFromEdgesItIsTheTestOfOneTexel)
{
  for (double turn : { 10.0, 40.0 })
  {
    const Place place(turned(boxOf(0.5, 1.0), 0.3, {}), lightFrom(40.0, turn));
    int dark = 0, lit = 0, between = 0;
    for (int k = 0; k < 20000; ++k)
    {
      const double x = -2.0 + 0.02 * (k % 200), y = -1.0 + 0.03 * (k / 200);
      const double darkness = place.onGround(x, y);
      ASSERT_GE(darkness, 0.0);
      ASSERT_LE(darkness, 1.0);
      // Two texels' edges around the point, as they lie on the ground.
      const double reach = 2.0 * place.texel / std::sin(glm::radians(40.0));
      bool same = true;
      const bool hard = place.hardOnGround(x, y);
      for (int j = -8; j <= 8 && same; ++j)
      {
        for (int i = -8; i <= 8 && same; ++i)
        {
          same = place.hardOnGround(x + 0.125 * i * reach, y + 0.125 * j * reach) == hard;
        }
      }
      if (same)
      {
        ASSERT_EQ(darkness, hard ? 1.0 : 0.0) << x << ", " << y;
        ++(hard ? dark : lit);
      }
      between += darkness > 0.0 && darkness < 1.0;
    }
    EXPECT_GT(dark, 300);
    EXPECT_GT(lit, 5000);
    EXPECT_GT(between, 300);
  }
}

// Ground and wall, both lit: texels of the one lie in front of the other's plane, and shadow
// nothing.
TEST(ShadowFilter, ACreaseInTheLightIsNotDark)
{
  for (double elevation : { 15.0, 30.0, 45.0, 60.0, 75.0 })
  {
    for (double turn : { 0.0, 20.0, 50.0 })
    {
      const Place place(wall(), lightFrom(elevation, turn));
      for (int k = 0; k < 400; ++k)
      {
        const double x = -0.9 + 1.8 * k / 400.0 + 0.0013;
        for (int j = 0; j < 12; ++j)
        {
          const double away = place.texel * (j + 0.1) / 4.0;
          ASSERT_EQ(place.onGround(x, -away), 0.0) << elevation << ", " << turn;
          ASSERT_EQ(svo::MapTest(place.buffer.maps())
                      .darkness(Place::pointOf({ x, 0, away }, { 0, -1, 0 }), 0.0, 0.0),
            0.0)
            << elevation << ", " << turn;
        }
      }
    }
  }
}

// The light comes from behind the wall. Two texels from the wall, as the light sees it, the
// ground is dark; nearer the filter is no lighter than the test of one texel is on average.
TEST(ShadowFilter, AShadowBeginsWhereItsCasterStands)
{
  for (double elevation : { 15.0, 30.0, 45.0, 60.0, 75.0 })
  {
    for (double turn : { 180.0, 200.0, 230.0 })
    {
      const Place place(wall(), lightFrom(elevation, turn));
      for (double away : { 0.1, 0.5, 1.0, 1.5, 2.0, 4.0 })
      {
        double filtered = 0.0, hard = 0.0;
        for (int k = 0; k < 400; ++k)
        {
          const double x = -0.4 + 0.8 * k / 400.0 + 0.0013; // the wall's ends are far
          const double y = -away * place.texel / std::sin(glm::radians(elevation));
          const double darkness = place.onGround(x, y);
          filtered += darkness;
          hard += place.hardOnGround(x, y);
          ASSERT_TRUE(away < 2.0 || darkness == 1.0)
            << elevation << ", " << turn << ": " << away << " texels";
        }
        EXPECT_TRUE(away >= 1.0 || filtered >= hard - 1e-6 || filtered > 0.5 * 400)
          << elevation << ", " << turn << ": " << away << " texels, " << filtered << ", " << hard;
      }
    }
  }
}

// A shadow that falls across the border of two of a point light's six maps: the border is not seen.
TEST(ShadowFilter, BordersOfMapsAreNotSeen)
{
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(square(3.0), 9), 1),
    instanceOf(makeOctree(square(0.5), 9), 2, movedTo(0.0, 0.0, 1.0)) };
  const glm::dvec3 from(0.3, 0.2, 1.6);
  scene.lights = { lightOf(svo::Light::Kind::Point, from) };
  svo::FrameSettings settings;
  settings.shadowResolution = Resolution;
  scene.receivers = { { glm::dvec3(-9.0), glm::dvec3(9.0) } };
  svo::LayerBudget budget{ 0, 0 };
  svo::ShadowBuffer buffer;
  buffer.prepare(scene,
    svo::mapsOfLight(
      svo::outlinesOf(scene), scene.lights[0], settings.shadowResolution, svo::View()),
    0, settings, budget);
  buffer.markAll();
  buffer.trace(svo::serialFor);
  std::vector<svo::ShadowMap> maps;
  buffer.copyMaps(0, maps);
  ASSERT_EQ(maps.size(), 6u);
  int dark = 0, lit = 0;
  for (int k = 0; k < 160000; ++k)
  {
    const double x = -2.6 + 0.01 * (k % 400), y = -2.6 + 0.01 * (k / 400);
    // Where the ray from the light passes the square's plane; 0 on its edge, negative inside.
    const double u = from.x + (x - from.x) * 0.6 / 1.6, v = from.y + (y - from.y) * 0.6 / 1.6;
    const double outside = std::max(std::abs(u), std::abs(v)) - 0.5;
    if (std::abs(outside) < 0.06)
    {
      continue;
    }
    const svo::SurfacePoint point = Place::pointOf({ x, y, 0 }, { 0, 0, 1 });
    ASSERT_EQ(svo::MapTest(buffer.maps()).shadows(point, 0.0), outside < 0.0) << x << ", " << y;
    ASSERT_EQ(svo::MapTest(buffer.maps()).darkness(point, 0.0, 0.0), outside < 0.0 ? 1.0 : 0.0)
      << x << ", " << y;
    const bool besideBorder = std::abs(std::abs(x - from.x) - from.z) < 0.03;
    dark += besideBorder && outside < 0.0;
    lit += besideBorder && outside > 0.0;
  }
  EXPECT_GT(dark, 100);
  EXPECT_GT(lit, 100);
}

// A piece of the surface that is wider than a texel has a ramp as wide.
TEST(ShadowFilter, TheRampIsAsWideAsThePiece)
{
  const double angle = 0.3;
  const Place place(turned(square(1.0), angle, { 0, 0, 1.0 }), lightFrom(90.0, 0.0));
  const glm::dvec2 normal(std::cos(angle), std::sin(angle));
  for (double texels : { 1.0, 2.0, 4.0 })
  {
    double first = 0.0, last = 0.0;
    for (int step = -400; step <= 400; ++step)
    {
      const glm::dvec2 p = (1.0 + 0.01 * step * place.texel) * normal;
      const double darkness = place.onGround(p.x, p.y, texels * place.texel);
      first = darkness > 0.9 ? 0.01 * step : first;
      last = darkness > 0.1 ? 0.01 * step : last;
    }
    EXPECT_GT(last - first, 0.6 * texels);
    EXPECT_LT(last - first, 1.3 * texels + 0.5);
  }
}

TEST(ShadowFilter, WithoutTheAutomaticBiasNothingIsFiltered)
{
  const Place place(turned(square(1.0), 0.3, { 0, 0, 1.0 }), lightFrom(60.0, 0.0), false, 2.0);
  int dark = 0;
  for (int k = 0; k < 4000; ++k)
  {
    const double x = -1.6 + 0.05 * (k % 64), y = -1.6 + 0.05 * (k / 64);
    const double darkness = place.onGround(x, y);
    ASSERT_EQ(darkness, place.hardOnGround(x, y) ? 1.0 : 0.0);
    dark += darkness > 0.0;
  }
  EXPECT_GT(dark, 500);
}
