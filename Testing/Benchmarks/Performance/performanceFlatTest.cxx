#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "performanceFlatTest.cxx"
#include <hwy/foreach_target.h>

#include "performanceFlatTest.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace performance
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

std::size_t testAll(const FlatBalls& balls, const glm::vec4* planes, std::uint32_t* seen)
{
  const hn::ScalableTag<float> floats;
  const hn::RebindToUnsigned<decltype(floats)> words;
  const std::size_t width = hn::Lanes(floats);
  std::size_t found = 0;
  for (std::size_t i = 0; i < balls.count; i += width)
  {
    const auto x = hn::LoadU(floats, balls.x.data() + i), y = hn::LoadU(floats, balls.y.data() + i),
               z = hn::LoadU(floats, balls.z.data() + i);
    auto least = hn::Zero(floats);
    for (int p = 0; p < 6; ++p)
    {
      const auto distance = hn::MulAdd(hn::Set(floats, planes[p].x), x,
        hn::MulAdd(hn::Set(floats, planes[p].y), y,
          hn::MulAdd(hn::Set(floats, planes[p].z), z, hn::Set(floats, planes[p].w))));
      least = hn::Min(least, distance);
    }
    auto in = hn::Ge(least, hn::Neg(hn::LoadU(floats, balls.radius.data() + i)));
    if (i + width > balls.count)
    {
      in = hn::And(in, hn::FirstN(floats, balls.count - i));
    }
    if (!hn::AllFalse(floats, in))
    {
      // Not CompressStore(): some machines take a hundred cycles for it.
      const auto mask = hn::RebindMask(words, in);
      hn::StoreU(
        hn::Compress(hn::Iota(words, static_cast<std::uint32_t>(i)), mask), words, seen + found);
      found += hn::CountTrue(floats, in);
    }
  }
  return found;
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace performance
{
HWY_EXPORT(testAll);

std::size_t flatTest(const FlatBalls& balls, const glm::vec4 planes[6], std::uint32_t* seen)
{
  return HWY_DYNAMIC_DISPATCH(testAll)(balls, planes, seen);
}
}
#endif
