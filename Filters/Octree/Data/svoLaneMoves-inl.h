// Loads and stores of single lanes, where Highway's own are slow.
//
// A gather of AVX-512 reads the register that it writes to: lanes that are masked out keep what was
// there. GatherIndex() leaves the choice of that register to the compiler. No lane is masked out,
// but the processor waits all the same for whatever was computed there last, and code that is laid
// out to have two computations side by side has them one after the other. A register that was just
// cleared has nothing to wait for.
//
// Compress() copies a table to the stack whenever it is called where there is no instruction for
// it.
#if defined(SVO_LANE_MOVES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_LANE_MOVES_INL
#undef SVO_LANE_MOVES_INL
#else
#define SVO_LANE_MOVES_INL
#endif

#include "svoLaneBits-inl.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// base[index] of every lane; T has 32 bits.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE hn::Vec<D> gather(D d, const T* base, hn::Vec<hn::RebindToSigned<D>> index)
{
  static_assert(sizeof(T) == 4);
#if HWY_TARGET <= HWY_AVX3
  if constexpr (hn::MaxLanes(D()) == 16)
  {
    const hn::RebindToSigned<D> di;
    const __m512i cleared = _mm512_setzero_si512();
    __mmask16 all = 0xffff;
    asm("" : "+Yk"(all)); // a compiler that knew what it is would drop `cleared`
    return hn::BitCast(
      d, hn::Vec<decltype(di)>{ _mm512_mask_i32gather_epi32(cleared, all, index.raw, base, 4) });
  }
#endif
  return hn::GatherIndex(d, base, index);
}

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3
#define SVO_COMPRESS_BY_TABLE 1
/// Which lanes of eight a mask has, as numbers of four bits: the first lane's in the lowest bits.
constexpr std::array<std::int32_t, 256> makeCompressTable()
{
  std::array<std::int32_t, 256> table{};
  for (int mask = 0; mask < 256; ++mask)
  {
    std::uint32_t lanes = 0;
    int count = 0;
    for (std::uint32_t lane = 0; lane < 8; ++lane)
    {
      if (mask >> lane & 1)
      {
        lanes |= lane << 4 * count++;
      }
    }
    table[mask] = static_cast<std::int32_t>(lanes);
  }
  return table;
}
inline constexpr std::array<std::int32_t, 256> CompressTable = makeCompressTable();
#else
#define SVO_COMPRESS_BY_TABLE 0
#endif

/// Stores lanes of several vectors one behind the other.
class LaneCompressor
{
public:
  template <class M>
  HWY_INLINE explicit LaneCompressor(M mask)
    : lanes(hn::RebindMask(DI(), mask))
    , count(hn::CountTrue(DI(), this->lanes))
#if SVO_COMPRESS_BY_TABLE
    , order(hn::Shr(hn::Set(DI(), CompressTable[bitsOf(DI(), this->lanes)]),
        hn::ShiftLeft<2>(hn::Iota(DI(), 0))))
#endif
  {
#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3
    this->order = hn::And(this->order, hn::Set(DI(), 3));
#endif
  }

  std::size_t size() const
  {
    return this->count;
  }

  /// Writes a whole vector of 32-bit numbers, of which the lanes are the first.
  template <class V, class T>
  HWY_INLINE void store(V values, T* to) const
  {
    const hn::DFromV<V> d;
    static_assert(sizeof(T) == 4);
#if HWY_TARGET == HWY_AVX2
    const auto raw = hn::BitCast(DI(), values).raw;
    hn::StoreU(
      hn::BitCast(d, hn::Vec<DI>{ _mm256_permutevar8x32_epi32(raw, this->order.raw) }), d, to);
#elif SVO_COMPRESS_BY_TABLE
    hn::StoreU(hn::TableLookupLanes(values, hn::IndicesFromVec(d, this->order)), d, to);
#else
    hn::StoreU(hn::Compress(values, hn::RebindMask(d, this->lanes)), d, to);
#endif
  }

private:
  hn::Mask<DI> lanes;
  std::size_t count;
#if SVO_COMPRESS_BY_TABLE
  hn::Vec<DI> order; // each lane's source, in the bits that say which
#endif
};
}
}
HWY_AFTER_NAMESPACE();

#endif
