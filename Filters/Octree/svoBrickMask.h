// Masks of the voxels of a brick, and of the cells of a 4x4 tile, on whose side of integer planes
// and lines they lie: 64 or 16 exact comparisons at once.
#ifndef svoBrickMask_h
#define svoBrickMask_h

#include "svoMorton.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace svo
{
/// The slab 0 <= base + gradient . voxel <= thickness over the voxels of a brick. Lane is
/// std::int32_t or std::int64_t and must hold the sums with two bits to spare.
template <typename Lane>
class BrickSlab
{
public:
  template <typename Int>
  BrickSlab(const Int gradient[3], Lane thickness)
    : Thickness(thickness)
  {
    for (int i = 0; i < 64; ++i)
    {
      // Each offset is one addition to one that is there already.
      const int bit = i == 0 ? 0 : i & -i;
      const int axis = bit & 9 ? 0 : bit & 18 ? 1 : 2;
      this->Offset[i] = i == 0
        ? 0
        : this->Offset[i ^ bit] + static_cast<Lane>(bit < 8 ? gradient[axis] : 2 * gradient[axis]);
    }
  }

  /// Bit i is set if voxel i lies in the slab.
  std::uint64_t mask(Lane base) const
  {
    std::uint64_t outside = 0;
#if defined(__SSE2__)
    for (int part = 0; part < 4; ++part)
    {
      __m128i sign[4];
      for (int i = 0; i < 4; ++i)
      {
        sign[i] = this->signs(16 * part + 4 * i, base);
      }
      const __m128i bytes =
        _mm_packs_epi16(_mm_packs_epi32(sign[0], sign[1]), _mm_packs_epi32(sign[2], sign[3]));
      outside |= static_cast<std::uint64_t>(_mm_movemask_epi8(bytes)) << (16 * part);
    }
#else
    for (int i = 0; i < 64; ++i)
    {
      const Lane s = this->Offset[i] + base;
      outside |= static_cast<std::uint64_t>((s | (this->Thickness - s)) < 0) << i;
    }
#endif
    return ~outside;
  }

private:
#if defined(__SSE2__)
  /// Four 32-bit lanes that are negative where voxels i .. i + 3 lie outside.
  __m128i signs(int i, Lane base) const
  {
    const __m128i* offsets = reinterpret_cast<const __m128i*>(this->Offset + i);
    if constexpr (sizeof(Lane) == 4)
    {
      const __m128i s = _mm_add_epi32(_mm_load_si128(offsets), _mm_set1_epi32(base));
      return _mm_or_si128(s, _mm_sub_epi32(_mm_set1_epi32(this->Thickness), s));
    }
    else
    {
      const __m128i b = _mm_set1_epi64x(base);
      const __m128i t = _mm_set1_epi64x(this->Thickness);
      const __m128i s0 = _mm_add_epi64(_mm_load_si128(offsets), b);
      const __m128i s1 = _mm_add_epi64(_mm_load_si128(offsets + 1), b);
      const __m128 high0 = _mm_castsi128_ps(_mm_or_si128(s0, _mm_sub_epi64(t, s0)));
      const __m128 high1 = _mm_castsi128_ps(_mm_or_si128(s1, _mm_sub_epi64(t, s1)));
      return _mm_castps_si128(_mm_shuffle_ps(high0, high1, _MM_SHUFFLE(3, 1, 3, 1)));
    }
  }
#endif

  alignas(16) Lane Offset[64];
  Lane Thickness;
};

/// Tables that widen masks of a coordinate or of a plane of cells to a brick.
struct BrickTables
{
  /// [axis][low byte, high byte][bits]: the cells of a 4x4 tile across `axis`, in Morton order
  /// (u, v, u, v with u = axis + 1 and v = axis + 2, cyclically), as columns of voxels.
  std::uint64_t column[3][2][256];
  /// [axis][first][last]: the voxels with first <= coordinate <= last.
  std::uint64_t range[3][4][4];

  BrickTables()
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int half = 0; half < 2; ++half)
      {
        for (int bits = 0; bits < 256; ++bits)
        {
          std::uint64_t& mask = this->column[axis][half][bits];
          mask = 0;
          for (int i = 0; i < 64; ++i)
          {
            const glm::ivec3 c = cellOfIndex(i);
            const int u = c[(axis + 1) % 3];
            const int v = c[(axis + 2) % 3];
            const int cell = (u & 1) | (v & 1) << 1 | (u & 2) << 1 | (v & 2) << 2;
            mask |= static_cast<std::uint64_t>(cell >> 3 == half && bits >> (cell & 7) & 1) << i;
          }
        }
      }
      for (int first = 0; first < 4; ++first)
      {
        for (int last = 0; last < 4; ++last)
        {
          std::uint64_t& mask = this->range[axis][first][last];
          mask = 0;
          for (int i = 0; i < 64; ++i)
          {
            const int c = cellOfIndex(i)[axis];
            mask |= static_cast<std::uint64_t>(first <= c && c <= last) << i;
          }
        }
      }
    }
  }

  std::uint64_t columns(int axis, unsigned tile) const
  {
    return this->column[axis][0][tile & 255] | this->column[axis][1][tile >> 8];
  }

  static const BrickTables& get()
  {
    static const BrickTables tables;
    return tables;
  }
};

/// The half plane 0 <= base + u * x + v * y over the cells of 4x4 tiles.
class TileEdge
{
public:
  TileEdge() = default;

  /// `base` belongs to cell (0, 0). `span` is how much less the function is at the farthest than at
  /// the nearest corner of one cell, rounded up: it is what makes a cell lie inside altogether.
  TileEdge(std::int64_t u, std::int64_t v, std::int64_t base, std::int64_t span)
    : U(u)
    , V(v)
    , Base(base)
    , Most(3 * (std::max<std::int64_t>(u, 0) + std::max<std::int64_t>(v, 0)))
    , Least(3 * (std::min<std::int64_t>(u, 0) + std::min<std::int64_t>(v, 0)))
    , Span(span)
    , Narrow(std::max(std::abs(u), std::abs(v)) < 1 << 27)
  {
  }

  std::int64_t at(int tileX, int tileY) const
  {
    return 4 * (this->U * tileX + this->V * tileY) + this->Base;
  }
  /// The function's value for a tile, from which the others follow.
  bool misses(std::int64_t value) const { return value + this->Most < 0; }
  bool covers(std::int64_t value) const { return value + this->Least >= 0; }
  bool contains(std::int64_t value) const { return value + this->Least >= this->Span; }

  /// Range of the tiles of a row that may be touched, intersected with [first, last].
  void clipRow(int tileY, int& first, int& last) const
  {
    const std::int64_t rest = 4 * this->V * tileY + this->Base + this->Most;
    std::int64_t low = first;
    std::int64_t high = last;
    if (this->U > 0)
    {
      low = std::max(low, -floorDivide(rest, 4 * this->U)); // 4 u x + rest >= 0
    }
    else if (this->U < 0)
    {
      high = std::min(high, floorDivide(rest, -4 * this->U));
    }
    else if (rest < 0)
    {
      high = low - 1;
    }
    first = static_cast<int>(std::min<std::int64_t>(low, last + 1));
    last = static_cast<int>(std::max<std::int64_t>(high, first - 1));
  }

  /// Adds the cells outside to `outside`, 16 bits in Morton order. |value| is small, as of a tile
  /// that the line crosses.
  void addOutside(std::int64_t value, unsigned& outside) const
  {
#if defined(__SSE2__)
    if (this->Narrow)
    {
      const int u = static_cast<int>(this->U);
      const int v = static_cast<int>(this->V);
      const __m128i u2 = _mm_set1_epi32(2 * u);
      const __m128i v2 = _mm_set1_epi32(2 * v);
      const __m128i e0 =
        _mm_add_epi32(_mm_set1_epi32(static_cast<int>(value)), _mm_set_epi32(u + v, v, u, 0));
      const __m128i e1 = _mm_add_epi32(e0, u2);
      const __m128i e2 = _mm_add_epi32(e0, v2);
      const __m128i e3 = _mm_add_epi32(e1, v2);
      outside |= static_cast<unsigned>(
        _mm_movemask_epi8(_mm_packs_epi16(_mm_packs_epi32(e0, e1), _mm_packs_epi32(e2, e3))));
      return;
    }
#endif
    for (int i = 0; i < 16; ++i)
    {
      const std::int64_t x = (i & 1) | (i >> 1 & 2);
      const std::int64_t y = (i >> 1 & 1) | (i >> 2 & 2);
      outside |= static_cast<unsigned>(value + this->U * x + this->V * y < 0) << i;
    }
  }

private:
  static std::int64_t floorDivide(std::int64_t a, std::int64_t b)
  {
    return a >= 0 ? a / b : -((b - 1 - a) / b);
  }

  std::int64_t U = 0, V = 0, Base = 0, Most = 0, Least = 0, Span = 0;
  bool Narrow = true;
};
}

#endif
