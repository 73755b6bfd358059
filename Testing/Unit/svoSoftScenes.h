// What tests of soft shadows and of ambient occlusion share: how far what they find may be off.
#ifndef svoSoftScenes_h
#define svoSoftScenes_h

#include "svoClosedForms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace svotest
{
/// Largest and mean difference.
struct Difference
{
  double most = 0.0, rms = 0.0;

  Difference(const std::vector<double>& a, const std::vector<double>& b)
  {
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      this->most = std::max(this->most, std::abs(a[i] - b[i]));
      this->rms += (a[i] - b[i]) * (a[i] - b[i]) / static_cast<double>(a.size());
    }
    this->rms = std::sqrt(this->rms);
  }
};

/// The bar of closed forms at 1024 samples, of full light: of the error's RMS over pixels. A
/// straight edge passes at most 64 of the 32 x 32 cells with one sample each, whose answers are off
/// by half a sample in the mean square at most: 8 halves of 1024 samples, 0.0039. Of a few hundred
/// pixels the worst is off by 3.5 times as much.
constexpr double Bar = 0.005, WorstPixel = 3.5 * 0.0039;

/// True shares and those that are found, at so many samples; `most` of the true ones is what tells
/// that there is something to see.
inline void expectClosedForm(const std::vector<double>& expected, const std::vector<double>& found,
  double low, double high, const std::string& name)
{
  SCOPED_TRACE(name);
  const auto [least, most] = std::minmax_element(expected.begin(), expected.end());
  EXPECT_LE(*least, low);
  EXPECT_GE(*most, high);
  const Difference difference(expected, found);
  EXPECT_LE(difference.rms, Bar);
  EXPECT_LE(difference.most, WorstPixel);
}
}

#endif
