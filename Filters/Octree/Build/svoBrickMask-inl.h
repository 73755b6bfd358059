// Masks of the voxels of a brick, and of the cells of a 4x4 tile, by the side of integer planes and
// lines that they lie on: 64 or 16 exact comparisons at once. Compiled once for each instruction
// set.
#if defined(SVO_BRICK_MASK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_BRICK_MASK_INL
#undef SVO_BRICK_MASK_INL
#else
#define SVO_BRICK_MASK_INL
#endif

#include "svoLaneBits-inl.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// Bit i is set where lane i is negative.
template <typename Tag, typename Vector>
HWY_INLINE std::uint64_t negativeLanes(Tag tag, Vector v)
{
  return bitsOf(tag, hn::Lt(v, hn::Zero(tag)));
}

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
    // The offsets of a group of 2x2x2 voxels, then those of the groups.
    const Lane x = static_cast<Lane>(gradient[0]);
    const Lane y = static_cast<Lane>(gradient[1]);
    const Lane z = static_cast<Lane>(gradient[2]);
    HWY_ALIGN const Lane group[8] = { 0, x, y, static_cast<Lane>(x + y), z,
      static_cast<Lane>(x + z), static_cast<Lane>(y + z), static_cast<Lane>(x + y + z) };
    const hn::CappedTag<Lane, 8> tag;
    for (std::size_t i = 0; i < 8; i += hn::MaxLanes(tag))
    {
      const auto inGroup = hn::Load(tag, group + i);
      for (int g = 0; g < 8; ++g)
      {
        hn::Store(hn::Add(inGroup, hn::Set(tag, static_cast<Lane>(2 * group[g]))), tag,
          this->Offset + 8 * g + i);
      }
    }
  }

  /// Bit i is set if voxel i lies in the slab.
  HWY_INLINE std::uint64_t mask(Lane base) const
  {
    const hn::CappedTag<Lane, 16> tag;
    const auto b = hn::Set(tag, base);
    const auto t = hn::Set(tag, this->Thickness);
    std::uint64_t outside = 0;
    for (std::size_t i = 0; i < 64; i += hn::MaxLanes(tag))
    {
      const auto s = hn::Add(hn::Load(tag, this->Offset + i), b);
      outside |= negativeLanes(tag, hn::Or(s, hn::Sub(t, s))) << i;
    }
    return ~outside;
  }

private:
  HWY_ALIGN Lane Offset[64];
  Lane Thickness;
};

/// Half planes 0 <= base + u * x + v * y over the cells of 4x4 tiles. Lane must hold their values
/// over all tiles that are asked for.
template <typename Lane>
class TileEdges
{
public:
  void clear() { this->Count = 0; }

  /// `base` belongs to cell (0, 0). `span` is how much less the function is at the farthest than at
  /// the nearest corner of a cell, rounded up: it is what makes a cell lie inside altogether.
  void add(std::int64_t u, std::int64_t v, std::int64_t base, std::int64_t span)
  {
    Edge& edge = this->Edges[this->Count++];
    edge.u = u;
    edge.v = v;
    edge.most = base + 3 * (std::max<std::int64_t>(u, 0) + std::max<std::int64_t>(v, 0));
    edge.inside = base + 3 * (std::min<std::int64_t>(u, 0) + std::min<std::int64_t>(v, 0)) - span;
    HWY_ALIGN static const std::int32_t x[16] = { 0, 1, 0, 1, 2, 3, 2, 3, 0, 1, 0, 1, 2, 3, 2, 3 };
    HWY_ALIGN static const std::int32_t y[16] = { 0, 0, 1, 1, 0, 0, 1, 1, 2, 2, 3, 3, 2, 2, 3, 3 };
    if constexpr (sizeof(Lane) == 4)
    {
      const Tag tag;
      for (std::size_t i = 0; i < 16; i += hn::MaxLanes(tag))
      {
        const auto du = hn::Mul(hn::Set(tag, static_cast<Lane>(u)), hn::Load(tag, x + i));
        const auto dv = hn::Mul(hn::Set(tag, static_cast<Lane>(v)), hn::Load(tag, y + i));
        hn::Store(
          hn::Add(hn::Add(du, dv), hn::Set(tag, static_cast<Lane>(base))), tag, edge.lanes + i);
      }
    }
    else
    {
      for (int i = 0; i < 16; ++i)
      {
        edge.lanes[i] = base + u * x[i] + v * y[i];
      }
    }
  }

  /// Tiles of a row that may be touched, intersected with [first, last].
  void clipRow(int tileY, int& first, int& last) const
  {
    std::int64_t low = first;
    std::int64_t high = last;
    for (int i = 0; i < this->Count; ++i)
    {
      const Edge& edge = this->Edges[i];
      const std::int64_t rest = 4 * edge.v * tileY + edge.most;
      if (edge.u > 0)
      {
        low = std::max(low, -floorDivide(rest, 4 * edge.u)); // 4 u x + rest >= 0
      }
      else if (edge.u < 0)
      {
        high = std::min(high, floorDivide(rest, -4 * edge.u));
      }
      else if (rest < 0)
      {
        high = low - 1;
      }
    }
    first = static_cast<int>(std::min<std::int64_t>(low, last + 1));
    last = static_cast<int>(std::max<std::int64_t>(high, first - 1));
  }

  /// The cells of a tile that are in all half planes, 16 bits in Morton order. All edges are
  /// evaluated: whether one misses or covers a tile is beyond a branch predictor.
  HWY_INLINE unsigned mask(int tileX, int tileY) const
  {
    const Tag tag;
    HWY_ALIGN Lane at[6];
    for (int k = 0; k < this->Count; ++k)
    {
      at[k] = static_cast<Lane>(4 * (this->Edges[k].u * tileX + this->Edges[k].v * tileY));
    }
    unsigned outside = 0;
    for (std::size_t i = 0; i < 16; i += hn::MaxLanes(tag))
    {
      auto signs = hn::Zero(tag);
      for (int k = 0; k < this->Count; ++k)
      {
        signs =
          hn::Or(signs, hn::Add(hn::Load(tag, this->Edges[k].lanes + i), hn::Set(tag, at[k])));
      }
      outside |= static_cast<unsigned>(negativeLanes(tag, signs)) << i;
    }
    return ~outside & 0xffffu;
  }

  /// True if all cells of a tile are inside, with all of their boxes.
  bool contains(int tileX, int tileY) const
  {
    bool inside = true;
    for (int i = 0; i < this->Count; ++i)
    {
      const Edge& edge = this->Edges[i];
      inside = inside && 4 * (edge.u * tileX + edge.v * tileY) + edge.inside >= 0;
    }
    return inside;
  }

private:
  using Tag = hn::CappedTag<Lane, 16>;
  struct Edge
  {
    HWY_ALIGN Lane lanes[16]; // of the cells of tile (0, 0)
    std::int64_t u, v;
    std::int64_t most, inside; // at tile (0, 0)
  };

  static std::int64_t floorDivide(std::int64_t a, std::int64_t b)
  {
    return a >= 0 ? a / b : -((b - 1 - a) / b);
  }

  Edge Edges[6];
  int Count = 0;
};
}
}
HWY_AFTER_NAMESPACE();

#endif
