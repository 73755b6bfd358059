#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoLightFilter.cxx"
#include <hwy/foreach_target.h>

#include "svoLightFilter.h"

#include "svoLaneBits-inl.h"

#include <algorithm>
#include <limits>
#include <memory>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
using Lanes = hn::Vec<Floats>;

constexpr int Scales = 4; // beyond a pixel alone
constexpr int ReachOf[Scales] = { 1, 2, 4, 8 };
static_assert(ReachOf[Scales - 1] == LightFilter::Reach, "");

/// Sums over pixels: of their samples, of how many these are, and of the squares of the former
/// divided by the latter.
struct Sums
{
  Lanes sum, count, squares;

  /// Of pixels from one on where they are `wanted`.
  HWY_INLINE Sums(const LightFilter::Pixels& pixels, std::size_t at, hn::Mask<Floats> wanted)
    : sum(hn::IfThenElseZero(wanted, hn::LoadU(Floats(), pixels.sum + at)))
    , count(hn::IfThenElseZero(wanted, hn::LoadU(Floats(), pixels.count + at)))
    , squares(hn::Div(hn::Mul(sum, sum), hn::Max(count, hn::Set(Floats(), 1.0f / 1024))))
  {
  }
  HWY_INLINE explicit Sums(const float* stored)
    : sum(hn::Load(Floats(), stored))
    , count(hn::Load(Floats(), stored + LightFilter::Block))
    , squares(hn::Load(Floats(), stored + 2 * LightFilter::Block))
  {
  }
  HWY_INLINE void store(float* to) const
  {
    hn::Store(this->sum, Floats(), to);
    hn::Store(this->count, Floats(), to + LightFilter::Block);
    hn::Store(this->squares, Floats(), to + 2 * LightFilter::Block);
  }
  HWY_INLINE void add(const Sums& other)
  {
    this->sum = hn::Add(this->sum, other.sum);
    this->count = hn::Add(this->count, other.count);
    this->squares = hn::Add(this->squares, other.squares);
  }
  HWY_INLINE void add(const Sums& other, hn::Mask<Floats> where)
  {
    this->sum = hn::Add(this->sum, hn::IfThenElseZero(where, other.sum));
    this->count = hn::Add(this->count, hn::IfThenElseZero(where, other.count));
    this->squares = hn::Add(this->squares, hn::IfThenElseZero(where, other.squares));
  }
};

/// Sums along rows of a block.
struct RowSums
{
  static constexpr int Rows = LightFilter::Block + 2 * LightFilter::Reach;
  alignas(64) float of[Scales][Rows][3 * LightFilter::Block];
};

/// The surfaces of some pixels.
struct Surface
{
  Lanes normalX, normalY, normalZ, depth;

  HWY_INLINE Surface(const SampledSurfaces& all, std::size_t at)
    : normalX(hn::LoadU(Floats(), all.normalX.data() + at))
    , normalY(hn::LoadU(Floats(), all.normalY.data() + at))
    , normalZ(hn::LoadU(Floats(), all.normalZ.data() + at))
    , depth(hn::LoadU(Floats(), all.depth.data() + at))
  {
  }

  /// Where it is that of `middle`, if there is one, `away` pixels from there; `slope`: of the
  /// middle's depth, a pixel.
  HWY_INLINE hn::Mask<Floats> same(const Surface& middle, Lanes slope, Lanes pixel, int away) const
  {
    const Floats d;
    // No fused operations: bits are the same on all machines.
    const auto cosine = hn::Add(hn::Mul(this->normalX, middle.normalX),
      hn::Add(hn::Mul(this->normalY, middle.normalY), hn::Mul(this->normalZ, middle.normalZ)));
    const float steps = static_cast<float>(away < 0 ? -away : away);
    const auto expected =
      hn::Add(middle.depth, hn::Mul(slope, hn::Set(d, static_cast<float>(away))));
    const auto off = hn::Abs(hn::Sub(this->depth, expected));
    // Half a pixel, and a bend.
    const auto mayBe = hn::Mul(pixel, hn::Set(d, 0.5f + 0.2f * steps));
    return hn::And(hn::Ge(cosine, hn::Set(d, LeastCosine)), hn::Le(off, mayBe));
  }

  static constexpr float LeastCosine = 0.9f;
};

void sumRows(const LightFilter::Pixels& pixels, std::size_t first, int rows, RowSums& sums)
{
  const Floats d;
  for (int row = 0; row < rows + 2 * LightFilter::Reach; ++row)
  {
    for (int x = 0; x < LightFilter::Block; x += width())
    {
      const std::size_t at = first + static_cast<std::size_t>(row) * pixels.stride -
        LightFilter::Reach * pixels.stride + static_cast<std::size_t>(x);
      const Surface middle(pixels.surfaces, at);
      const auto slope = hn::LoadU(d, pixels.surfaces.depthX.data() + at);
      const auto pixel = hn::LoadU(d, pixels.surfaces.pixel.data() + at);
      const auto known = hn::Ge(pixel, hn::Zero(d));
      Sums some(pixels, at, known);
      int away = 1;
      for (int scale = 0; scale < Scales; ++scale)
      {
        for (; away <= ReachOf[scale]; ++away)
        {
          for (const int step : { -away, away })
          {
            const std::size_t beside = at + static_cast<std::size_t>(step);
            some.add(Sums(pixels, beside,
              hn::And(known, Surface(pixels.surfaces, beside).same(middle, slope, pixel, step))));
          }
        }
        some.store(sums.of[scale][row] + x);
      }
    }
  }
}

/// The intersection of confidence intervals, from narrow squares to wide ones.
class Interval
{
public:
  HWY_INLINE Interval(const Sums& pixel, const LightFilter::Evenness& even)
    : samples(hn::Set(Floats(), even.samples))
    , ofShare(hn::Set(Floats(), even.ofShare))
    , each(hn::Max(pixel.count, hn::Set(Floats(), 1.0f)))
    , low(hn::Set(Floats(), -1e30f))
    , high(hn::Set(Floats(), 1e30f))
    , chosen(hn::Div(pixel.sum, hn::Max(pixel.count, hn::Set(Floats(), 1.0f / 1024))))
    , chance(this->varianceOf(pixel))
    , open(hn::Gt(pixel.count, hn::Zero(Floats())))
  {
  }

  HWY_INLINE void add(const Sums& sums)
  {
    const Floats d;
    const auto one = hn::Set(d, 1.0f);
    const auto mean = hn::Div(sums.sum, hn::Max(sums.count, hn::Set(d, 1e-6f)));
    const auto spread = this->spreadOf(sums);
    const auto variance = hn::Div(spread, hn::Max(sums.count, one)); // varianceOf()
    const auto may = hn::Mul(hn::Set(d, Confidence), hn::Sqrt(variance));
    this->low = hn::Max(this->low, hn::Sub(mean, may));
    this->high = hn::Min(this->high, hn::Add(mean, may));
    // Pixels differ from the mean of all by no more either.
    const auto differ = hn::Sub(sums.squares, hn::Mul(mean, sums.sum));
    const auto others = hn::Sub(hn::Div(sums.count, this->each), one);
    this->open = hn::And(this->open,
      hn::And(hn::Le(this->low, this->high),
        hn::Le(differ, hn::Mul(hn::Set(d, Unlikely), hn::Mul(spread, hn::Max(others, one))))));
    this->chosen = hn::IfThenElse(this->open, mean, this->chosen);
    this->chance = hn::IfThenElse(this->open, variance, this->chance);
  }

  Lanes mean() const { return this->chosen; }
  Lanes variance() const { return this->chance; } // of the mean, by chance

private:
  /// LightFilter::spreadOf()
  HWY_INLINE Lanes spreadOf(const Sums& sums) const
  {
    const Floats d;
    const auto one = hn::Set(d, 1.0f);
    const auto about = hn::Div(hn::Add(sums.sum, hn::Set(d, 0.5f)), hn::Add(sums.count, one));
    const auto rest = hn::Sub(one, about);
    const auto n =
      hn::Max(hn::Min(hn::Mul(this->ofShare, hn::Min(about, rest)), this->samples), one);
    const auto cube = hn::Mul(hn::Mul(n, n), n);
    return hn::Div(hn::Max(hn::Mul(about, rest), hn::Zero(d)), hn::Sqrt(hn::Sqrt(hn::Sqrt(cube))));
  }
  HWY_INLINE Lanes varianceOf(const Sums& sums) const
  {
    return hn::Div(this->spreadOf(sums), hn::Max(sums.count, hn::Set(Floats(), 1.0f)));
  }

  // Of standard deviations and of variances; of values around them these left the smallest errors
  // over seven scenes of penumbras, closed places and skies.
  static constexpr float Confidence = 3.0f, Unlikely = 4.0f;
  const Lanes samples, ofShare, each;
  Lanes low, high, chosen, chance;
  hn::Mask<Floats> open;
};

void findMeans(const LightFilter::Pixels& pixels, std::size_t first, int rows, const RowSums& sums)
{
  const Floats d;
  for (int row = 0; row < rows; ++row)
  {
    for (int x = 0; x < LightFilter::Block; x += width())
    {
      const std::size_t at =
        first + static_cast<std::size_t>(row) * pixels.stride + static_cast<std::size_t>(x);
      const Surface middle(pixels.surfaces, at);
      const auto slope = hn::LoadU(d, pixels.surfaces.depthY.data() + at);
      const auto pixel = hn::LoadU(d, pixels.surfaces.pixel.data() + at);
      const auto known = hn::Ge(pixel, hn::Zero(d));
      const int middleRow = row + LightFilter::Reach;
      hn::Mask<Floats> same[2 * LightFilter::Reach + 1];
      for (int step = -LightFilter::Reach; step <= LightFilter::Reach; ++step)
      {
        const std::size_t beside = at + static_cast<std::size_t>(step) * pixels.stride;
        same[step + LightFilter::Reach] =
          hn::And(known, Surface(pixels.surfaces, beside).same(middle, slope, pixel, step));
      }
      Interval interval(Sums(pixels, at, known), pixels.even);
      for (int scale = 0; scale < Scales; ++scale)
      {
        Sums square(sums.of[scale][middleRow] + x);
        for (int away = 1; away <= ReachOf[scale]; ++away)
        {
          for (const int step : { -away, away })
          {
            square.add(Sums(sums.of[scale][middleRow + step] + x), same[step + LightFilter::Reach]);
          }
        }
        interval.add(square);
      }
      hn::StoreU(interval.mean(), d, pixels.mean + at);
      hn::StoreU(interval.variance(), d, pixels.variance + at);
    }
  }
}

void filterBlock(const LightFilter::Pixels& pixels, std::size_t first, int rows)
{
  const std::unique_ptr<RowSums> sums(new RowSums);
  sumRows(pixels, first, rows, *sums);
  findMeans(pixels, first, rows, *sums);
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(filterBlock);

void SampledSurfaces::resize(std::size_t pixels)
{
  for (RawArray<float>* part : { &this->normalX, &this->normalY, &this->normalZ, &this->depth,
         &this->depthX, &this->depthY, &this->pixel })
  {
    part->resize(pixels);
  }
  this->remove(0, pixels);
}

void SampledSurfaces::remove(std::size_t first, std::size_t count)
{
  std::fill_n(this->depth.data() + first, count, std::numeric_limits<float>::infinity());
  std::fill_n(this->pixel.data() + first, count, -1.0f);
}

void LightFilter::filter(const Pixels& pixels, std::size_t first, int rows)
{
  HWY_DYNAMIC_DISPATCH(filterBlock)(pixels, first, rows);
}
}
#endif
