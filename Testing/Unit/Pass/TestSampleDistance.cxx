// How far apart rays are, from what frames took: no clock is asked here.
#include "svoSampleDistance.h"
#include "svoSampleStep.h"
#include "svoWindowTime.h"

#include <gtest/gtest.h>

#include <limits>

TEST(SampleDistance, IsOnePixelWithoutAFrameToGoBy)
{
  svo::SampleDistance distance;
  EXPECT_EQ(distance.choose(0.1, 8.0).distance, 1.0);
}

TEST(SampleDistance, IsOnePixelWhereTimeSuffices)
{
  svo::SampleDistance distance;
  distance.measured({ 1.0 }, 0.02);
  EXPECT_EQ(distance.choose(0.1, 8.0).distance, 1.0);
}

TEST(SampleDistance, GrowsWithTheRootOfTheTimeThatIsMissing)
{
  svo::SampleDistance distance;
  distance.measured({ 1.0 }, 0.9);
  EXPECT_EQ(distance.choose(0.1, 8.0).distance, 3.0);
}

TEST(SampleDistance, KeepsToItsMaximum)
{
  svo::SampleDistance distance;
  distance.measured({ 1.0 }, 90.0);
  EXPECT_EQ(distance.choose(0.1, 8.0).distance, 8.0);
}

TEST(SampleDistance, DoesNotFollowSmallGains)
{
  svo::SampleDistance distance;
  distance.measured({ 4.0 }, 0.08);
  EXPECT_EQ(distance.choose(0.1, 8.0).distance, 4.0);
  distance.measured({ 4.0 }, 0.02);
  EXPECT_LT(distance.choose(0.1, 8.0).distance, 4.0);
}

TEST(SampleDistance, AStillFrameIsAnEstimateToo)
{
  svo::SampleDistance distance;
  distance.measured({ 4.0 }, 0.1);
  distance.measured({ 1.0 }, 0.4);
  EXPECT_EQ(distance.choose(0.1, 8.0).distance, 2.0);
}

TEST(SampleDistance, AsksOfRaysOnlyWhatRaysCanGive)
{
  // 0.06 of 0.1 s are left for the rays, which take 0.54.
  svo::SampleDistance distance;
  distance.measured({ 1.0 }, 0.58, 0.04);
  EXPECT_EQ(distance.choose(0.1, 8.0).distance, 3.0);
}

TEST(SampleDistance, IsNotCoarserForTimeThatFewerRaysWouldNotSave)
{
  // A second for each frame, rays or not: rays may take a quarter of the budget.
  svo::SampleDistance distance;
  distance.measured({ 1.0 }, 1.02, 1.0);
  EXPECT_EQ(distance.choose(0.1, 8.0).distance, 1.0);
  distance.measured({ 1.0 }, 1.09, 1.0);
  EXPECT_EQ(distance.choose(0.1, 8.0).distance, 2.0);
  for (int frame = 0; frame < 5; ++frame)
  {
    distance.measured({ 2.0 }, 1.0225, 1.0);
    EXPECT_EQ(distance.choose(0.1, 8.0).distance, 2.0);
  }
}

TEST(SampleDistance, OthersOfTheWindowTakeTheirShare)
{
  svo::SampleDistance distance;
  distance.measured({ 1.0 }, 0.1);
  EXPECT_EQ(distance.choose(0.1, 8.0, { 0.0, 0.3 }).distance, 2.0);
  distance.measured({ 2.0 }, 0.025);
  EXPECT_EQ(distance.choose(0.1, 8.0, { 0.05, 0.3 }).distance, 3.0);
  distance.measured({ 2.0 }, 0.025);
  EXPECT_EQ(distance.choose(0.1, 8.0).distance, 1.0); // they are gone
}

// Shadow maps are the first to become coarser.

namespace
{
svo::FramePace paceOf(double rays, double shadows, double fixed = 0.0)
{
  svo::SampleDistance pace;
  pace.measured({}, fixed + rays + shadows, fixed, shadows);
  return pace.choose(0.1, 8.0);
}
}

TEST(SampleDistance, MapsBecomeCoarserBeforeRaysMoveApart)
{
  const svo::FramePace pace = paceOf(0.02, 0.32);
  EXPECT_EQ(pace.distance, 1.0);
  EXPECT_EQ(pace.coarseness, 2.0); // 0.08 s are left for them
}

TEST(SampleDistance, RaysMoveApartWhereMapsCannotSaveEnough)
{
  // Maps take a tenth of a second at their coarsest.
  const svo::FramePace pace = paceOf(0.1, 6.4);
  EXPECT_EQ(pace.coarseness, 8.0);
  EXPECT_EQ(pace.distance, 2.0); // a quarter of the time is the rays' in any case
  // Rays alone take more than there is.
  const svo::FramePace both = paceOf(0.36, 0.32);
  EXPECT_EQ(both.distance, 2.0);
  EXPECT_EQ(both.coarseness, 6.0); // of the 0.01 s that 2 pixels leave: the root of 32
}

TEST(SampleDistance, MapsThatTakeLittleStayAsTheyAre)
{
  const svo::FramePace pace = paceOf(0.9, 0.005);
  EXPECT_EQ(pace.coarseness, 1.0);
  EXPECT_GT(pace.distance, 3.0);
  EXPECT_LT(pace.distance, 3.6);
}

TEST(SampleDistance, APaceThatKeepsToItsTimeIsKept)
{
  svo::SampleDistance pace;
  svo::FramePace now;
  for (int frame = 0; frame < 6; ++frame)
  {
    const double rays = 0.2 / (now.distance * now.distance);
    const double shadows = 0.5 / (now.coarseness * now.coarseness);
    pace.measured(now, 0.01 + rays + shadows, 0.01, shadows);
    const svo::FramePace next = pace.choose(0.1, 8.0);
    if (frame > 0)
    {
      EXPECT_LE(0.01 + rays + shadows, 0.1 * (1.0 + 1.0 / 16.0));
      EXPECT_EQ(next.distance, now.distance);
      EXPECT_EQ(next.coarseness, now.coarseness);
    }
    now = next;
  }
}

TEST(WindowTime, RenderersOfAWindowMeetThere)
{
  const int window = 0, other = 0;
  const auto time = svo::WindowTime::of(&window);
  EXPECT_EQ(svo::WindowTime::of(&window), time);
  EXPECT_NE(svo::WindowTime::of(&other), time);
}

TEST(WindowTime, TheOthersAreThoseMeasuredSince)
{
  svo::WindowTime time;
  const int a = 0, b = 0, c = 0;
  EXPECT_EQ(time.others(&a).rays, 0.0);
  time.measured(&a, { 0.01, 0.1 });
  EXPECT_EQ(time.others(&a).rays, 0.0);
  EXPECT_EQ(time.others(&b).rays, 0.1);
  time.measured(&b, { 0.02, 0.2 });
  time.measured(&c, { 0.04, 0.4 });
  EXPECT_DOUBLE_EQ(time.others(&a).rays, 0.2 + 0.4);
  EXPECT_DOUBLE_EQ(time.others(&a).fixed, 0.02 + 0.04);
  EXPECT_DOUBLE_EQ(time.others(&b).rays, 0.4);
  // Frame after frame a and b alone are drawn: c does not count any more.
  time.measured(&a, { 0.01, 0.1 });
  time.measured(&b, { 0.02, 0.2 });
  EXPECT_DOUBLE_EQ(time.others(&a).rays, 0.2);
  time.measured(&a, { 0.01, 0.1 });
  EXPECT_DOUBLE_EQ(time.others(&b).rays, 0.1);
  time.forget(&a);
  EXPECT_EQ(time.others(&b).rays, 0.0);
}

TEST(SampleStep, TakesAsManyAsFitIntoItsTime)
{
  constexpr double Endless = std::numeric_limits<double>::infinity();
  EXPECT_EQ(svo::moreSamples(8, 0.0, 0.5), 8); // nobody knows what one takes
  EXPECT_EQ(svo::moreSamples(8, 0.0, Endless), 8);
  EXPECT_EQ(svo::moreSamples(8, 1.0, Endless), 8);
  EXPECT_EQ(svo::moreSamples(8, 0.01, 0.5), 8);
  EXPECT_EQ(svo::moreSamples(256, 0.0625, 0.5), 8);
  EXPECT_EQ(svo::moreSamples(8, 10.0, 0.5), 1);
}
