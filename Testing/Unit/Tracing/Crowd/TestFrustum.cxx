#include "svoRandomViews.h"

#include "svoBox.h"
#include "svoFrustum.h"
#include "svoLocalView.h"

#include <gtest/gtest.h>

#include <limits>

using namespace svotest;

namespace
{
/// A depth between the near and the far end, near the ends more often.
double randomDepth(RandomBalls& random, const svo::View& view)
{
  const double f = random.below(4) ? random.between(0.0, 1.0) : double(random.below(2));
  const double far = std::min(view.tFar, 1e9 * std::abs(view.tNear) + 1.0);
  return view.tNear > 0.0 && random.below(2) ? view.tNear * std::pow(far / view.tNear, f)
                                             : view.tNear + f * (far - view.tNear);
}

glm::dvec3 pointOf(const svo::View& view, double x, double y, double t)
{
  return view.rayOrigin(x, y) + t * view.rayDirection(x, y);
}
}

TEST(Frustum, NothingThatARayMeetsIsOutside)
{
  RandomBalls random(11);
  for (int i = 0; i < 20000; ++i)
  {
    const double scale = std::pow(10.0, random.between(-6.0, 6.0));
    const double far = random.below(3) ? 0.0 : std::pow(10.0, random.between(-6.0, 6.0));
    const svo::View view = randomView(random, scale, far * glm::dvec3(0.3, -1.0, 0.7));
    const svo::PixelRect rect = randomRect(random, view);
    const svo::Frustum frustum = frustumOf(view, rect, 0.0);
    for (int k = 0; k < 10; ++k)
    {
      const auto pixel = [&](int low, int high) {
        return random.below(3) ? random.between(low, high) : random.below(2) ? low : high;
      };
      const double x = pixel(rect.x0, rect.x1), y = pixel(rect.y0, rect.y1);
      const glm::dvec3 p = pointOf(view, x, y, randomDepth(random, view));
      const double size = std::max({ std::abs(p.x), std::abs(p.y), std::abs(p.z) });
      ASSERT_FALSE(outside(frustum, p, 0.0)) << "view " << i << ", pixel " << x << ", " << y;
      const glm::dvec3 beside = scale * std::exp2(random.between(-30.0, 10.0)) *
        glm::dvec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
      ASSERT_FALSE(
        outside(frustum, p + beside, glm::length(beside) * (1.0 + 1e-14) + 1e-15 * size));
      const glm::dvec3 half = glm::abs(beside) * (1.0 + 1e-14) + 1e-15 * size;
      std::uint8_t within = 0;
      ASSERT_FALSE(frustum.outside(p + beside, half, within)) << "view " << i;
      const std::uint8_t known = within;
      ASSERT_FALSE(frustum.outside(p + beside, half, within)) << "what is known does not matter";
      ASSERT_EQ(within, known);
    }
  }
}

TEST(Frustum, NoBallThatTouchesItFromOutsideIsOutside)
{
  RandomBalls random(16);
  for (int i = 0; i < 50000; ++i)
  {
    const svo::View view = randomView(random, 1.0, glm::dvec3(0.0));
    const svo::Frustum frustum(view, 0.0);
    const double y = random.between(0.0, view.height);
    const double t = random.between(view.tNear, std::min(view.tFar, view.tNear + 10.0));
    const glm::dvec3 p = pointOf(view, 0.0, y, t);
    // Large ones need all the digits of their centres.
    const double size = std::exp2(random.between(-10.0, 60.0));
    const glm::dvec3 centre = p - size * glm::dvec3(frustum.plane(0));
    long double sum = 0.0;
    for (int a = 0; a < 3; ++a)
    {
      const long double d = static_cast<long double>(centre[a]) - p[a];
      sum += d * d;
    }
    const double radius = std::nextafter(static_cast<double>(std::sqrt(sum)), 1e300);
    ASSERT_FALSE(outside(frustum, centre, radius)) << "view " << i << ", size " << size;
    const glm::dvec3 half = glm::abs(centre - p);
    std::uint8_t within = 0;
    ASSERT_FALSE(frustum.outside(centre, half * (1.0 + 0x1p-52), within));
  }
}

TEST(Frustum, WhatIsAHundredthOfAPixelBesideIsOutside)
{
  RandomBalls random(12);
  int beside = 0;
  for (int i = 0; i < 5000; ++i)
  {
    const svo::View view = randomView(random, 1.0, glm::dvec3(0.0));
    const svo::PixelRect rect = randomRect(random, view);
    for (const double margin : { 0.0, 1.0, 3.5 })
    {
      const svo::Frustum frustum = frustumOf(view, rect, margin);
      ASSERT_EQ(frustum.planes(), 6);
      const double off = margin + 0.01;
      const double x = random.between(rect.x0, rect.x1), y = random.between(rect.y0, rect.y1);
      const double t = random.between(view.tNear, std::min(view.tFar, view.tNear + 100.0));
      const double depth = std::max(view.tFar, -view.tNear);
      const glm::dvec3 out[6] = { pointOf(view, rect.x0 - off, y, t),
        pointOf(view, rect.x1 + off, y, t), pointOf(view, x, rect.y0 - off, t),
        pointOf(view, x, rect.y1 + off, t), pointOf(view, x, y, view.tNear - 1e-9 * depth),
        pointOf(view, x, y, view.tFar + 1e-9 * depth) };
      const glm::dvec3 in = pointOf(view, x, y, t);
      for (int k = 0; k < 6; ++k)
      {
        EXPECT_TRUE(outside(frustum, out[k], 0.0)) << "view " << i << ", side " << k;
        const glm::dvec3 step = out[k] - in;
        EXPECT_FALSE(outside(frustum, out[k] + step, 2.0 * glm::length(step))) << "it reaches in";
        beside += outside(frustum, out[k] + 8.0 * step, 8.0 * glm::length(step) * (1.0 - 1e-9));
      }
    }
  }
  EXPECT_GT(beside, 5000) << "balls that end before the frustum";
}

TEST(Frustum, InsideIsBetweenAllPlanes)
{
  RandomBalls random(13);
  int inside = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const svo::View view = randomView(random, 1.0, glm::dvec3(0.0));
    const svo::PixelRect rect = randomRect(random, view);
    const svo::Frustum frustum = frustumOf(view, rect);
    const double x = random.between(rect.x0, rect.x1), y = random.between(rect.y0, rect.y1);
    const glm::dvec3 p = pointOf(view, x, y, randomDepth(random, view));
    const double half = std::exp2(random.between(-12.0, 1.0));
    const svo::Box box{ p - half, p + half };
    std::uint8_t within = 0;
    if (frustum.outside(p, glm::dvec3(half), within) || within != (1 << frustum.planes()) - 1)
    {
      continue;
    }
    ++inside;
    for (int c = 0; c < 8; ++c)
    {
      const glm::dvec4 corner(c & 1 ? box.high.x : box.low.x, c & 2 ? box.high.y : box.low.y,
        c & 4 ? box.high.z : box.low.z, 1.0);
      const glm::dvec4 v = view.worldToView * corner;
      const glm::dvec4 clip = view.viewToClip * v;
      const double px = (clip.x / clip.w + 1.0) * 0.5 * view.width;
      const double py = (clip.y / clip.w + 1.0) * 0.5 * view.height;
      // A margin of a pixel, and what planes give way for the rays' noise.
      const double noise = 1e-13 * glm::length(glm::dvec3(v));
      const double x1 = 1.0 + 1e-9 + noise / glm::length(view.originX - v.z * view.directionX);
      const double y1 = 1.0 + 1e-9 + noise / glm::length(view.originY - v.z * view.directionY);
      EXPECT_TRUE(px > rect.x0 - x1 && px < rect.x1 + x1) << px;
      EXPECT_TRUE(py > rect.y0 - y1 && py < rect.y1 + y1) << py;
      EXPECT_TRUE(-v.z > view.tNear - 1e-6 && -v.z < view.tFar * (1.0 + 1e-6));
    }
  }
  EXPECT_GT(inside, 500);
}

TEST(Frustum, HasAllCubesThatTheTracerLooksAt)
{
  // seeCube() gives those that reach behind the eye the whole image.
  RandomBalls random(14);
  int seen = 0, outside = 0;
  for (int i = 0; i < 50000; ++i)
  {
    const svo::View view = randomView(random, 1.0, glm::dvec3(0.0));
    const svo::Ball ball = random.ball();
    const svo::SeenCube cube =
      svo::seeCube(ball.centre - ball.radius, 2.0 * ball.radius, glm::dmat4(1.0), view);
    std::uint8_t within = 0;
    const bool out = svo::Frustum(view).outside(ball.centre, glm::dvec3(ball.radius), within);
    const svo::PixelRect all{ 0, 0, view.width, view.height };
    const bool whole = cube.rect.x0 == all.x0 && cube.rect.y0 == all.y0 && cube.rect.x1 == all.x1 &&
      cube.rect.y1 == all.y1;
    if (!cube.rect.empty() && !whole)
    {
      EXPECT_FALSE(out) << "view " << i;
    }
    seen += !cube.rect.empty();
    outside += out;
  }
  EXPECT_GT(seen, 5000);
  EXPECT_GT(outside, 5000);
}

TEST(Frustum, OfNoViewNothingIsOutside)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  svo::View bad;
  bad.origin.x = nan;
  bad.directionX.x = nan;
  bad.tNear = nan;
  EXPECT_FALSE(outside(svo::Frustum(bad), { 1e9, 3, 4 }, 0.0));
  svo::View huge;
  ASSERT_TRUE(svo::makeView(glm::dmat4(1.0), glm::ortho(-1.0, 1.0, -1.0, 1.0), 9, 9, huge));
  huge.originX = { 1e308, 0, 0 };
  EXPECT_FALSE(outside(svo::Frustum(huge), { 0, 0, 1e9 }, 0.0)) << "corners that overflow";
  // Nor is what is nowhere, or everywhere.
  RandomBalls random(15);
  const svo::Frustum frustum(randomView(random, 1.0, glm::dvec3(0.0)));
  ASSERT_TRUE(outside(frustum, { 1e9, 1e9, 1e9 }, 0.0));
  EXPECT_FALSE(outside(frustum, { nan, 0, 0 }, 1.0));
  EXPECT_FALSE(outside(frustum, { 1e9, 1e9, 1e9 }, nan));
  EXPECT_FALSE(outside(frustum, { 1e9, 1e9, 1e9 }, std::numeric_limits<double>::infinity()));
  std::uint8_t within = 0;
  EXPECT_FALSE(frustum.outside({ nan, 0, 0 }, { 1, 1, 1 }, within));
  EXPECT_FALSE(frustum.outside({ 1e9, 1e9, 1e9 }, glm::dvec3(nan), within));
  EXPECT_FALSE(frustum.outside(
    { 1e9, 1e9, 1e9 }, glm::dvec3(std::numeric_limits<double>::infinity()), within));
}

TEST(Frustum, AViewWithoutAFarEndHasSidesAllTheSame)
{
  for (const double far : { 1e300, std::numeric_limits<double>::infinity() })
  {
    svo::View view;
    ASSERT_TRUE(
      svo::makeView(glm::dmat4(1.0), glm::perspective(0.7, 1.5, 0.1, 1.0), 300, 200, view));
    view.tFar = far;
    const svo::Frustum frustum(view);
    EXPECT_EQ(frustum.planes(), 5);
    EXPECT_FALSE(outside(frustum, { 0, 0, -1e12 }, 0.0));
    EXPECT_TRUE(outside(frustum, { 0, 1e12, -1e12 }, 0.0));
    EXPECT_TRUE(outside(frustum, { 0, 0, 1 }, 0.5));
  }
}
