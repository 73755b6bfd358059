#include "svoSampleDistance.h"

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
