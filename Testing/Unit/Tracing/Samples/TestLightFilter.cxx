// The filter of samples against the same pixel by pixel, and against many samples.
#include "svoInstructionSets.h"
#include "svoLightFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <random>
#include <vector>

namespace
{
using svo::LightFilter::Block;
using svo::LightFilter::Evenness;
using svo::LightFilter::Margin;
using svo::LightFilter::Reach;
using svotest::onEveryInstructionSet;

/// Samples on a wall of patches, some of them at other depths or bent, with holes between.
struct Image
{
  static constexpr int Width = 2 * Block, Height = 100;
  static constexpr std::size_t Stride = Width + 2 * Margin;
  svo::SampledSurfaces surfaces;
  std::vector<float> sum, count;

  Image()
    : sum(Stride * (Height + 2 * Reach), std::nanf(""))
    , count(sum)
  {
    std::mt19937 random(11);
    this->surfaces.resize(this->sum.size());
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        const int patch = (x / 23 + 7 * (y / 31)) % 6;
        if (random() % 50 == 0)
        {
          continue;
        }
        const std::size_t i = at(x, y);
        const float turn = patch == 4 ? 0.02f * static_cast<float>(x % 23) : 0.0f;
        this->surfaces.normalX[i] = std::sin(turn);
        this->surfaces.normalY[i] = 0.0f;
        this->surfaces.normalZ[i] = std::cos(turn);
        this->surfaces.depth[i] = 5.0f + 0.03f * static_cast<float>(x) -
          0.05f * static_cast<float>(y) + (patch == 2 ? 1.0f : 0.0f);
        this->surfaces.depthX[i] = 0.03f;
        this->surfaces.depthY[i] = -0.05f;
        this->surfaces.pixel[i] = 0.1f;
        const float share = patch == 3 ? 0.005f * static_cast<float>(x)
          : patch == 5                 ? static_cast<float>(x / 3 % 2)
                                       : 0.3f;
        this->count[i] = random() % 9 == 0 ? 0.0f : 4.0f;
        this->sum[i] = 0.0f;
        for (int k = 0; k < 4 && this->count[i] > 0.0f; ++k)
        {
          this->sum[i] += static_cast<float>(random() % 1000) < 1000.0f * share ? 1.0f : 0.0f;
        }
      }
    }
  }
  static std::size_t at(int x, int y)
  {
    return static_cast<std::size_t>(y + Reach) * Stride + static_cast<std::size_t>(Margin + x);
  }

  /// Whether pixel q, so far from pixel p, is of its surface.
  bool same(std::size_t p, std::size_t q, int away, const svo::RawArray<float>& slope) const
  {
    const svo::SampledSurfaces& s = this->surfaces;
    if (!(s.pixel[p] >= 0.0f && s.pixel[q] >= 0.0f))
    {
      return false;
    }
    const float cosine =
      s.normalX[q] * s.normalX[p] + (s.normalY[q] * s.normalY[p] + s.normalZ[q] * s.normalZ[p]);
    const float expected = s.depth[p] + slope[p] * static_cast<float>(away);
    return cosine >= 0.9f &&
      std::abs(s.depth[q] - expected) <=
      s.pixel[p] * (0.5f + 0.2f * static_cast<float>(std::abs(away)));
  }

  struct Sums
  {
    float sum = 0.0f, count = 0.0f, squares = 0.0f;
    void add(const Sums& other)
    {
      this->sum += other.sum;
      this->count += other.count;
      this->squares += other.squares;
    }
  };
  Sums of(std::size_t p) const
  {
    return { this->sum[p], this->count[p],
      this->sum[p] * this->sum[p] / std::max(this->count[p], 1.0f / 1024) };
  }
  /// Of the pixels of a row.
  Sums along(int x, int y, int reach) const
  {
    const std::size_t p = at(x, y);
    if (y < 0 || y >= Height || this->surfaces.pixel[p] < 0.0f)
    {
      return {};
    }
    Sums sums = this->of(p);
    for (int k = 1; k <= reach; ++k)
    {
      for (const int step : { -k, k })
      {
        const std::size_t q = at(x + step, y);
        if (this->same(p, q, step, this->surfaces.depthX))
        {
          sums.add(this->of(q));
        }
      }
    }
    return sums;
  }
  Sums square(int x, int y, int reach) const
  {
    Sums sums = this->along(x, y, reach);
    for (int k = 1; k <= reach; ++k)
    {
      for (const int step : { -k, k })
      {
        if (this->same(at(x, y), at(x, y + step), step, this->surfaces.depthY))
        {
          sums.add(this->along(x, y + step, reach));
        }
      }
    }
    return sums;
  }
};
}

namespace
{
/// What the filter is to find of a pixel.
struct Filtered
{
  float mean = 0.0f, variance = 0.0f;
};

float spreadOf(const Image::Sums& all, const svo::LightFilter::Evenness& even)
{
  return svo::LightFilter::spreadOf(all.sum, all.count, even);
}

Filtered filtered(const Image& image, int x, int y, const svo::LightFilter::Evenness& even)
{
  const std::size_t p = Image::at(x, y);
  if (image.surfaces.pixel[p] < 0.0f || !(image.count[p] > 0.0f))
  {
    return {};
  }
  Filtered chosen{ image.sum[p] / image.count[p],
    spreadOf(image.of(p), even) / std::max(image.count[p], 1.0f) };
  float low = -1e30f, high = 1e30f;
  for (const int reach : { 1, 2, 4, 8 })
  {
    const Image::Sums all = image.square(x, y, reach);
    const float mean = all.sum / all.count;
    const float spread = spreadOf(all, even);
    const float variance = spread / std::max(all.count, 1.0f);
    const float may = 3.0f * std::sqrt(variance);
    low = std::max(low, mean - may);
    high = std::min(high, mean + may);
    const float others = std::max(all.count / std::max(image.count[p], 1.0f) - 1.0f, 1.0f);
    if (low > high || all.squares - mean * all.sum > 4.0f * (spread * others))
    {
      break;
    }
    chosen = { mean, variance };
  }
  return chosen;
}
}

namespace
{
void filterAll(const svo::LightFilter::Pixels& pixels)
{
  for (int y = 0; y < Image::Height; y += Block)
  {
    for (int x = 0; x < Image::Width; x += Block)
    {
      svo::LightFilter::filter(pixels, Image::at(x, y), std::min(Block, Image::Height - y));
    }
  }
}
}

TEST(LightFilter, IsThatOfEachPixelAlone)
{
  const Image image;
  onEveryInstructionSet(
    [&]
    {
      for (const Evenness& even :
        { Evenness::ofLight(1), Evenness::ofLight(4), Evenness::allAround(8) })
      {
        std::vector<float> mean(image.sum.size(), -1.0f), variance(mean);
        const svo::LightFilter::Pixels pixels{ image.surfaces, Image::Stride, image.sum.data(),
          image.count.data(), mean.data(), variance.data(), even };
        filterAll(pixels);
        int widened = 0, alone = 0;
        for (int y = 0; y < Image::Height; ++y)
        {
          for (int x = 0; x < Image::Width; ++x)
          {
            const std::size_t p = Image::at(x, y);
            const Filtered expected = filtered(image, x, y, even);
            ASSERT_EQ(expected.mean, mean[p]) << x << ' ' << y;
            ASSERT_EQ(expected.variance, image.count[p] > 0.0f ? variance[p] : 0.0f);
            const bool own = image.count[p] > 0.0f && mean[p] == image.sum[p] / image.count[p];
            alone += own;
            widened += image.count[p] > 0.0f && !own;
          }
        }
        EXPECT_GT(widened, 5000);
        EXPECT_GT(alone, 100);
        // Nothing is written beside the image.
        EXPECT_EQ(-1.0f, mean[Image::at(-1, 0)]);
        EXPECT_EQ(-1.0f, mean[Image::at(Image::Width, 50)]);
        EXPECT_EQ(-1.0f, mean[Image::at(0, Image::Height)]);
      }
    });
}

// Against figures worked out by hand: 1/32^0.375 is 0.2726, of 8 of 32 that see what is less
// 1/16^0.375 is 0.3536, and of one of them (as if one more were in between) next to nothing is
// even.
TEST(LightFilter, SamplesAreSpreadEvenlyAsFarAsManySeeWhatIsLess)
{
  using svo::LightFilter::spreadOf;
  constexpr float Many = 1e6f;
  EXPECT_NEAR(spreadOf(0.5f * Many, Many, Evenness::ofLight(32)), 0.25 * 0.27263, 1e-5);
  EXPECT_NEAR(spreadOf(0.5f * Many, Many, Evenness::allAround(32)), 0.25 * 0.27263, 1e-5);
  for (const float share : { 0.25f, 0.75f })
  {
    EXPECT_NEAR(spreadOf(share * Many, Many, Evenness::ofLight(32)), 0.1875 * 0.27263, 1e-5);
    EXPECT_NEAR(spreadOf(share * Many, Many, Evenness::allAround(32)), 0.1875 * 0.35355, 1e-5);
  }
  EXPECT_NEAR(spreadOf(0.01f * Many, Many, Evenness::allAround(32)), 0.0099, 1e-5);
  EXPECT_NEAR(spreadOf(0.01f * Many, Many, Evenness::ofLight(32)), 0.0099 * 0.27263, 1e-5);
  EXPECT_FLOAT_EQ(spreadOf(0.0f, 4.0f, Evenness::ofLight(1)), 0.09f); // a tenth, as if
  EXPECT_FLOAT_EQ(spreadOf(4.0f, 4.0f, Evenness::ofLight(1)), 0.09f);
}

// Something small and far away closes off a thirtieth of a plain's sky: of 32 samples it has one on
// the average, none here and three there. A pixel that keeps its own is a speck.
TEST(LightFilter, LeavesNoSpecksWhereFewSamplesSeeWhatIsLess)
{
  constexpr float Open = 1.0f - 1.0f / 30.0f;
  constexpr int Samples = 32;
  Image image;
  std::mt19937 random(5);
  std::binomial_distribution<int> seen(Samples, Open);
  for (int y = 0; y < Image::Height; ++y)
  {
    for (int x = 0; x < Image::Width; ++x)
    {
      const std::size_t i = Image::at(x, y);
      image.surfaces.normalX[i] = image.surfaces.normalY[i] = 0.0f;
      image.surfaces.normalZ[i] = 1.0f;
      image.surfaces.depth[i] = 5.0f;
      image.surfaces.depthX[i] = image.surfaces.depthY[i] = 0.0f;
      image.surfaces.pixel[i] = 0.1f;
      image.count[i] = static_cast<float>(Samples);
      image.sum[i] = static_cast<float>(seen(random));
    }
  }
  const auto specks = [&](const Evenness& even)
  {
    std::vector<float> mean(image.sum.size()), variance(mean);
    filterAll({ image.surfaces, Image::Stride, image.sum.data(), image.count.data(), mean.data(),
      variance.data(), even });
    int count = 0;
    for (int y = 0; y < Image::Height; ++y)
    {
      for (int x = 0; x < Image::Width; ++x)
      {
        count += std::abs(mean[Image::at(x, y)] - Open) > 0.04f;
      }
    }
    return count;
  };
  const int left = specks(Evenness::allAround(Samples));
  const int before = specks(Evenness::ofLight(Samples));
  std::cout << left << " specks, " << before << " by a light's rule\n";
  EXPECT_LE(left, before / 50);
  EXPECT_GT(before, 500) << "the samples tell nothing";
}
