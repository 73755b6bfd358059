// Writes the lanes of a mask side by side. Highway 1.0.3 has that as Compress(), which copies a
// table to the stack each time where there is no instruction for it.
#if defined(SVO_PACK_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_PACK_LANES_INL
#undef SVO_PACK_LANES_INL
#else
#define SVO_PACK_LANES_INL
#endif

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#ifndef SVO_PACK_LANES_ONCE
#define SVO_PACK_LANES_ONCE
namespace svo
{
/// For each byte: the numbers of its bits that are set, in ascending order.
struct SetBits
{
  alignas(64) std::int32_t numbers[256][8];

  SetBits()
  {
    for (int byte = 0; byte < 256; ++byte)
    {
      int count = 0;
      for (int bit = 0; bit < 8; ++bit)
      {
        this->numbers[byte][bit] = 0;
        if (byte >> bit & 1)
        {
          this->numbers[byte][count++] = bit;
        }
      }
    }
  }
  static const SetBits& get()
  {
    static const SetBits bits;
    return bits;
  }
};
}
#endif

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3
#define SVO_PACK_BY_TABLE 1
#else
#define SVO_PACK_BY_TABLE 0
#endif

/// Writes numbers of 32 bits at `to`, where there is room for a whole vector.
struct LanePacker
{
  using DF = hn::ScalableTag<float>;
  using DI = hn::ScalableTag<std::int32_t>;

  hn::Mask<DF> mask;
  std::size_t count;
#if SVO_PACK_BY_TABLE
  hn::Vec<DI> order;
#endif

  /// `bits`: for as many masks as there are.
  HWY_INLINE LanePacker(const SetBits& bits, hn::Mask<DF> lanes)
    : mask(lanes)
    , count(hn::CountTrue(DF(), lanes))
  {
#if SVO_PACK_BY_TABLE
    std::uint8_t byte[8] = {};
    hn::StoreMaskBits(DF(), mask, byte);
    order = hn::LoadU(DI(), bits.numbers[byte[0]]);
#else
    (void)bits;
#endif
  }
  HWY_INLINE void store(hn::Vec<DF> v, float* to) const
  {
#if SVO_PACK_BY_TABLE
    hn::StoreU(hn::TableLookupLanes(v, hn::IndicesFromVec(DF(), order)), DF(), to);
#else
    hn::StoreU(hn::Compress(v, mask), DF(), to);
#endif
  }
  HWY_INLINE void store(hn::Vec<DI> v, std::int32_t* to) const
  {
#if SVO_PACK_BY_TABLE
    hn::StoreU(hn::TableLookupLanes(v, hn::IndicesFromVec(DI(), order)), DI(), to);
#else
    hn::StoreU(hn::Compress(v, hn::RebindMask(DI(), mask)), DI(), to);
#endif
  }
};
}
}
HWY_AFTER_NAMESPACE();

#endif
