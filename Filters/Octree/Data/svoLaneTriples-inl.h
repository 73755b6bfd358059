// Triples of 32-bit numbers that lie one behind the other, one a lane: points, corners of
// triangles. Behind the last one has to be room for one more number, as there is in a Surface.
#if defined(SVO_LANE_TRIPLES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_LANE_TRIPLES_INL
#undef SVO_LANE_TRIPLES_INL
#else
#define SVO_LANE_TRIPLES_INL
#endif

#include "svoLaneMoves-inl.h"

#include <cstdint>

#include <hwy/highway.h>

#undef SVO_TRANSPOSES_TRIPLES
#if HWY_TARGET <= HWY_AVX3 || HWY_TARGET == HWY_SCALAR
#define SVO_TRANSPOSES_TRIPLES 0
#else
#define SVO_TRANSPOSES_TRIPLES 1
#endif

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
template <class V>
struct LaneTriples
{
  V x, y, z;
};
using Vec3 = LaneTriples<F>;

HWY_INLINE Vec3 subtract(const Vec3& a, const Vec3& b)
{
  return { hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z) };
}

HWY_INLINE F dot(const Vec3& a, const Vec3& b)
{
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

#if !SVO_TRANSPOSES_TRIPLES
/// base[at] of every lane and the two behind it; `at` is not negative.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE LaneTriples<hn::Vec<D>> loadThree(D d, const T* base, hn::Vec<hn::RebindToSigned<D>> at)
{
  return { gather(d, base, at), gather(d, base + 1, at), gather(d, base + 2, at) };
}
#else
/// Four numbers of every fourth lane, side by side. The indices are volatile since compilers else
/// know the vector that they come from, and taking a vector to pieces is slower than loading them.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE hn::Vec<D> loadEveryFourth(D d, const T* base, const volatile std::uint32_t* index)
{
  if constexpr (hn::MaxLanes(D()) == 4)
  {
    return hn::LoadU(d, base + *index);
  }
  else
  {
    const hn::Half<D> half;
    return hn::Combine(d, loadEveryFourth(half, base, index + hn::MaxLanes(half)),
      loadEveryFourth(half, base, index));
  }
}

/// The same by transposing: one load of 16 bytes a lane where gathers, which take as long as single
/// loads, need three. With AVX-512 it would be slower than they are.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE LaneTriples<hn::Vec<D>> loadThree(D d, const T* base, hn::Vec<hn::RebindToSigned<D>> at)
{
  const hn::RebindToUnsigned<D> du;
  const hn::RepartitionToWide<decltype(du)> wide;
  HWY_ALIGN std::uint32_t index[hn::MaxLanes(D())];
  hn::Store(hn::BitCast(du, at), du, index);
  const auto a = loadEveryFourth(d, base, index), b = loadEveryFourth(d, base, index + 1);
  const auto e = loadEveryFourth(d, base, index + 2), f = loadEveryFourth(d, base, index + 3);
  const auto pairs = [&](hn::Vec<D> v) { return hn::BitCast(wide, v); };
  const auto lowAB = pairs(hn::InterleaveLower(d, a, b)),
             lowEF = pairs(hn::InterleaveLower(d, e, f));
  const auto upAB = pairs(hn::InterleaveUpper(d, a, b)), upEF = pairs(hn::InterleaveUpper(d, e, f));
  return { hn::BitCast(d, hn::InterleaveLower(wide, lowAB, lowEF)),
    hn::BitCast(d, hn::InterleaveUpper(wide, lowAB, lowEF)),
    hn::BitCast(d, hn::InterleaveLower(wide, upAB, upEF)) };
}
#endif

/// The triple base[3 index] of every lane.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE LaneTriples<hn::Vec<D>> loadTriples(
  D d, const T* base, hn::Vec<hn::RebindToSigned<D>> index)
{
  return loadThree(d, base, hn::Add(index, hn::Add(index, index)));
}
}
}
HWY_AFTER_NAMESPACE();

#endif
