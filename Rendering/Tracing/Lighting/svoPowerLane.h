// A power in single precision, for one number: the highlight's and the fall-off of a spot. It has
// no branches, tables or calls, so that a loop over points becomes vectors, and rounds the same way
// on every instruction set, which std::pow does not promise.
//
// x^p = 2^(p log2 x). With x = 2^e m, m in [sqrt(1/2), sqrt(2)), and s = (m - 1) / (m + 1),
//
//   log2 x = e + 2 / ln 2 (s + s^3 / 3 + s^5 / 5 + s^7 / 7 + s^9 / 9 + ...)
//   2^y    = 2^n (1 + z + z^2 / 2 + ... + z^7 / 5040 + ...)     z = ln 2 (y - n), |y - n| <= 1/2
//
// How far off that is, in roundings u = 2^-24:
// - log2: |s| < 0.1716, so what the series leaves out is less than 3e-9 = 0.05 u of it. m - 1 is
//   exact; m + 1, the quotient, the polynomial (the terms after the first are less than a hundredth
//   of it) and the last product are off by less than 6 u together. Where e is 0 that is all, and
//   relative, however close to 1 x is; else the sum is at least 1/2 and the series at most that,
//   and the sum's own rounding comes on top: less than 8 u of the logarithm.
// - y = p log2 x: less than 9 u |y|. y - n is exact, since |y| < 2^8.
// - 2^y: 9 u |y| become 9 ln 2 u |y| < 6.3 u |y|; the series leaves out less than 0.1 u, its sum
//   and products add less than 4 u.
//
// So a power is off by less than (6.3 |y| + 5) 2^-24 of itself, y being the exponent of 2 that it
// is. A power of at most 1 is off by less than 9 u = 5.4e-7 whatever x and p are, since |y| 2^-|y|
// <= 0.54: less than a seven-thousandth of a grey level. Powers below 2^-126 become 0, and those of
// x below that.
#ifndef svoPowerLane_h
#define svoPowerLane_h

#include <cstdint>
#include <cstring>

namespace svo
{
namespace detail
{
inline std::int32_t bitsOf(float x)
{
  std::int32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

inline float floatOf(std::int32_t bits)
{
  float x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

/// `x`: positive, neither subnormal nor infinite.
inline float log2Lane(float x)
{
  constexpr std::int32_t RootOfHalf = 0x3f3504f3;
  constexpr float C0 = 2.8853900818f, C1 = 0.9617966939f, C2 = 0.5770780164f, C3 = 0.4121985831f,
                  C4 = 0.3205988980f; // 2 / ln 2 / (1, 3, 5, 7, 9)
  const std::int32_t bits = bitsOf(x);
  const std::int32_t e = (bits - RootOfHalf) >> 23;
  const float m = floatOf(bits - e * (1 << 23));
  const float s = (m - 1.0f) / (m + 1.0f);
  const float z = s * s;
  return static_cast<float>(e) + s * (C0 + z * (C1 + z * (C2 + z * (C3 + z * C4))));
}

/// `y`: -127..127.
inline float exp2Lane(float y)
{
  constexpr float C1 = 6.9314718056e-1f, C2 = 2.4022650696e-1f, C3 = 5.5504108665e-2f,
                  C4 = 9.6181291076e-3f, C5 = 1.3333558146e-3f, C6 = 1.5403530394e-4f,
                  C7 = 1.5252733804e-5f; // (ln 2)^k / k!
  const std::int32_t n = static_cast<std::int32_t>(y + 128.5f) - 128;
  const float f = y - static_cast<float>(n);
  const float r = 1.0f + f * (C1 + f * (C2 + f * (C3 + f * (C4 + f * (C5 + f * (C6 + f * C7))))));
  return r * floatOf((n + 127) * (1 << 23)); // times 0 if n is -127
}
}

/// x^p of 0 <= x <= 2 and 0 <= p, as std::pow has it; at most 2^127.
inline float powLane(float x, float p)
{
  constexpr float Least = 1.17549435e-38f; // 2^-126
  const float from = x < Least ? Least : x;
  const float y = p * detail::log2Lane(from);
  const float low = y < -127.0f ? -127.0f : y;
  const float power = detail::exp2Lane(low < 127.0f ? low : 127.0f);
  return x < Least ? (p > 0.0f ? 0.0f : 1.0f) : power;
}
}

#endif
