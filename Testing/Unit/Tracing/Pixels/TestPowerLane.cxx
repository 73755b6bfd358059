// The power of the lighting against double and long double: every mantissa of bases, all kinds of
// exponents.
#include "svoPowerLane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using svo::powLane;

namespace
{
/// The largest error of powers of x in [from, to], every `step`-th float, in what is allowed. What
/// double rounds is less than a ten-millionth of that.
double worst(float from, float to, int step, float p)
{
  double most = 0.0;
  for (std::int32_t bits = svo::detail::bitsOf(from); bits <= svo::detail::bitsOf(to); bits += step)
  {
    const float x = svo::detail::floatOf(bits);
    const double y = p * std::log2(static_cast<double>(x));
    const double expected = std::exp2(y);
    const double error = std::abs(powLane(x, p) - expected);
    const double smallest = 0x1p-126; // less may be nothing
    const double relative = (6.3 * std::abs(y) + 5.0) * 0x1p-24;
    const double allowed = std::max(expected * relative, smallest);
    const double share = error / allowed; // infinite, if it is no number
    most = share == share ? std::max(most, share) : std::numeric_limits<double>::infinity();
  }
  return most;
}
}

TEST(PowerLane, IsWithinItsBoundOfEveryMantissa)
{
  for (const float p : { 1.0f, 40.0f })
  {
    EXPECT_LT(worst(0.5f, 2.0f, 1, p), 1.0) << p;
  }
}

TEST(PowerLane, IsWithinItsBoundOfAllExponents)
{
  for (const float p : { 0.0f, 1e-30f, 0.01f, 0.3f, 1.0f, 2.0f, 3.0f, 7.0f, 12.5f, 63.0f, 127.999f,
         128.0f, 1000.0f, 1e6f, 3e38f })
  {
    EXPECT_LT(worst(0x1p-126f, 1.0f, 7919, p), 1.0) << p;
    EXPECT_LT(worst(0.9999f, 1.0f, 1, p), 1.0) << p;
  }
  for (float p = 0.0f; p <= 128.0f; p += 0.37f)
  {
    EXPECT_LT(worst(0.25f, 1.00001f, 104729, p), 1.0) << p;
  }
}

TEST(PowerLane, IsExactWhereItMatters)
{
  for (const float p : { 0.5f, 1.0f, 40.0f, 128.0f })
  {
    EXPECT_EQ(powLane(0.0f, p), 0.0f);
    EXPECT_EQ(powLane(1.0f, p), 1.0f);
    EXPECT_EQ(powLane(std::numeric_limits<float>::denorm_min(), p), 0.0f);
  }
  EXPECT_EQ(powLane(0.0f, 0.0f), 1.0f);
  EXPECT_EQ(powLane(0.3f, 0.0f), 1.0f);
}

TEST(PowerLane, OfAtMostOneIsOffByNineRoundingsAtMost)
{
  for (const float p : { 0.3f, 1.0f, 12.5f, 128.0f })
  {
    for (std::int32_t bits = svo::detail::bitsOf(1e-6f); bits <= svo::detail::bitsOf(1.0f);
         bits += 331)
    {
      const float x = svo::detail::floatOf(bits);
      const long double expected = std::pow(static_cast<long double>(x), p);
      ASSERT_LT(std::abs(powLane(x, p) - expected), 9.0L / (1 << 24)) << x << "^" << p;
    }
  }
}
