// How dark a pixel is in the shadows of the lights, in few bits.
#ifndef svoDarkness_h
#define svoDarkness_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace svo
{
/// Four bits for each of the first eight lights; the others share theirs with these.
using Darkness = std::uint32_t;

/// `share` of light number l, 0..1.
inline void darken(Darkness& darkness, std::size_t l, float share)
{
  const unsigned shift = 4 * (l % 8);
  const Darkness held = (darkness >> shift) & 15u;
  const Darkness more = static_cast<Darkness>(std::clamp(share, 0.0f, 1.0f) * 15.0f + 0.5f);
  darkness = (darkness & ~(15u << shift)) | (std::min(held + more, 15u) << shift);
}

/// True if one light's shadow changes from the one to the other by more than an eighth of the
/// light; a gentler change needs no further rays.
inline bool shadowChanges(Darkness a, Darkness b)
{
  if (a == b)
  {
    return false;
  }
  for (unsigned shift = 0; shift < 32; shift += 4)
  {
    const int change = static_cast<int>((a >> shift) & 15u) - static_cast<int>((b >> shift) & 15u);
    if (std::abs(change) > 2)
    {
      return true;
    }
  }
  return false;
}
}

#endif
