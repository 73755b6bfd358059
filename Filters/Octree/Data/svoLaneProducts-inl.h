// differenceOfProducts() of svoTriangle.h, one number a lane. The two cannot be one template: code
// on vectors has to stand where Highway compiles for their instruction set, code on plain numbers
// is compiled for any processor.
#if defined(SVO_LANE_PRODUCTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_LANE_PRODUCTS_INL
#undef SVO_LANE_PRODUCTS_INL
#else
#define SVO_LANE_PRODUCTS_INL
#endif

#include "svoLaneBits-inl.h"
#include "svoTriangle.h"

#include <cstddef>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// a b - c d with the right sign, zero only where it is zero; the same bits as of plain floats.
HWY_INLINE F differenceOfProducts(F a, F b, F c, F d)
{
  const DF df;
  const F ab = hn::Mul(a, b);
  const F cd = hn::Mul(c, d);
  const F difference = hn::Sub(ab, cd);
  const auto equal = hn::Eq(ab, cd);
  if (HWY_LIKELY(hn::AllFalse(df, equal)))
  {
    return difference;
  }
#if HWY_NATIVE_FMA
  const F exact = hn::Sub(hn::MulSub(a, b, ab), hn::MulSub(c, d, cd));
  return hn::IfThenElse(equal, exact, difference);
#else
  // Highway would round in between; std::fma never does.
  HWY_ALIGN float v[5][hn::MaxLanes(df)];
  hn::Store(a, df, v[0]);
  hn::Store(b, df, v[1]);
  hn::Store(c, df, v[2]);
  hn::Store(d, df, v[3]);
  for (std::size_t i = 0; i < hn::Lanes(df); ++i)
  {
    v[4][i] = svo::differenceOfProducts(v[0][i], v[1][i], v[2][i], v[3][i]);
  }
  return hn::Load(df, v[4]);
#endif
}
}
}
HWY_AFTER_NAMESPACE();

#endif
