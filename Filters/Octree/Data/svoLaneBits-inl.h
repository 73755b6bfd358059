// Per-target: vectors of lanes, and masks of lanes as bits. Included by kernels before their own
// namespace, anew for each instruction set.
#if defined(svoLaneBits_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef svoLaneBits_inl_h
#undef svoLaneBits_inl_h
#else
#define svoLaneBits_inl_h
#endif

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;
using DF = hn::ScalableTag<float>;
using DI = hn::ScalableTag<std::int32_t>;
using F = hn::Vec<DF>;
using I = hn::Vec<DI>;

using Floats = hn::CappedTag<float, 16>;
using Words = hn::RebindToUnsigned<Floats>;
using Integers = hn::RebindToSigned<Floats>;

/// Lanes of a vector of `Floats`: 1, 4, 8 or 16.
inline int width()
{
  return static_cast<int>(hn::Lanes(Floats()));
}

/// The first lane is bit 0.
template <class Tag, class Mask>
HWY_INLINE std::uint64_t bitsOf(Tag tag, Mask mask)
{
  std::uint8_t bytes[8];
  hn::StoreMaskBits(tag, mask, bytes);
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes, (hn::MaxLanes(tag) + 7) / 8);
  return bits;
}

/// The same from bits; those of further lanes do not matter.
template <class Tag>
HWY_INLINE hn::Mask<Tag> maskOf(Tag tag, std::uint64_t bits)
{
  std::uint8_t bytes[8];
  std::memcpy(bytes, &bits, sizeof bits);
  return hn::LoadMaskBits(tag, bytes);
}

/// Which of at most 64 numbers, as many as fill vectors, are this one.
HWY_INLINE std::uint64_t lanesOf(const std::uint32_t* numbers, std::uint32_t wanted, int count)
{
  const Words words;
  const auto value = hn::Set(words, wanted);
  std::uint64_t lanes = 0;
  for (int i = 0; i < count; i += width())
  {
    lanes |= bitsOf(words, hn::Eq(hn::LoadU(words, numbers + i), value)) << i;
  }
  return lanes;
}

/// Of 64, aligned.
HWY_INLINE float highestOf(const float* v)
{
  const DF df;
  F most = hn::Load(df, v);
  for (std::size_t i = hn::Lanes(df); i < 64; i += hn::Lanes(df))
  {
    most = hn::Max(most, hn::Load(df, v + i));
  }
  return hn::GetLane(hn::MaxOfLanes(df, most));
}
}
}
HWY_AFTER_NAMESPACE();

#endif
