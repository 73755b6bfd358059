// How far apart rays are, from what frames took: no clock is asked here.
#include "svoSampleDistance.h"
#include "svoWindowTime.h"

#include <gtest/gtest.h>

TEST(SampleDistance, IsOnePixelWithoutAFrameToGoBy)
{
  svo::SampleDistance distance;
  EXPECT_EQ(distance.choose(0.1, 8.0), 1.0);
}

TEST(SampleDistance, IsOnePixelWhereTimeSuffices)
{
  svo::SampleDistance distance;
  distance.measured(1.0, 0.02);
  EXPECT_EQ(distance.choose(0.1, 8.0), 1.0);
}

TEST(SampleDistance, GrowsWithTheRootOfTheTimeThatIsMissing)
{
  svo::SampleDistance distance;
  distance.measured(1.0, 0.9);
  EXPECT_EQ(distance.choose(0.1, 8.0), 3.0);
}

TEST(SampleDistance, KeepsToItsMaximum)
{
  svo::SampleDistance distance;
  distance.measured(1.0, 90.0);
  EXPECT_EQ(distance.choose(0.1, 8.0), 8.0);
}

TEST(SampleDistance, DoesNotFollowSmallGains)
{
  svo::SampleDistance distance;
  distance.measured(4.0, 0.08);
  EXPECT_EQ(distance.choose(0.1, 8.0), 4.0);
  distance.measured(4.0, 0.02);
  EXPECT_LT(distance.choose(0.1, 8.0), 4.0);
}

TEST(SampleDistance, AStillFrameIsAnEstimateToo)
{
  svo::SampleDistance distance;
  distance.measured(4.0, 0.1);
  distance.measured(1.0, 0.4);
  EXPECT_EQ(distance.choose(0.1, 8.0), 2.0);
}

TEST(SampleDistance, AsksOfRaysOnlyWhatRaysCanGive)
{
  // 0.06 of 0.1 s are left for the rays, which take 0.54.
  svo::SampleDistance distance;
  distance.measured(1.0, 0.58, 0.04);
  EXPECT_EQ(distance.choose(0.1, 8.0), 3.0);
}

TEST(SampleDistance, IsNotCoarserForTimeThatFewerRaysWouldNotSave)
{
  // A second for each frame, rays or not: rays may take a quarter of the budget.
  svo::SampleDistance distance;
  distance.measured(1.0, 1.02, 1.0);
  EXPECT_EQ(distance.choose(0.1, 8.0), 1.0);
  distance.measured(1.0, 1.09, 1.0);
  EXPECT_EQ(distance.choose(0.1, 8.0), 2.0);
  for (int frame = 0; frame < 5; ++frame)
  {
    distance.measured(2.0, 1.0225, 1.0);
    EXPECT_EQ(distance.choose(0.1, 8.0), 2.0);
  }
}

TEST(SampleDistance, OthersOfTheWindowTakeTheirShare)
{
  svo::SampleDistance distance;
  distance.measured(1.0, 0.1);
  EXPECT_EQ(distance.choose(0.1, 8.0, { 0.0, 0.3 }), 2.0);
  distance.measured(2.0, 0.025);
  EXPECT_EQ(distance.choose(0.1, 8.0, { 0.05, 0.3 }), 3.0);
  distance.measured(2.0, 0.025);
  EXPECT_EQ(distance.choose(0.1, 8.0), 1.0); // they are gone
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
