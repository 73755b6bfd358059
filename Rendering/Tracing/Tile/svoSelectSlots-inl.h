// The triangles of a group that one of its tiles may see, in the order in which they are drawn.
#if defined(SVO_SELECT_SLOTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_SELECT_SLOTS_INL
#undef SVO_SELECT_SLOTS_INL
#else
#define SVO_SELECT_SLOTS_INL
#endif

#include "svoLaneMoves-inl.h"
#include "svoTriangleGroup.h"

#include <algorithm>
#include <limits>

#include <hwy/highway.h>

#ifndef SVO_SELECT_SLOTS_ONCE
#define SVO_SELECT_SLOTS_ONCE
namespace svo
{
constexpr float HalfTile = 3.5f; // from the middle of a tile to the centres of its outer pixels

/// From the middle of a group to that of a tile, pixels.
inline float tileMiddle(int column)
{
  return 8.0f * static_cast<float>(column) + 4.0f - 0.5f * GroupView::Pixels;
}

}
#endif

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// The slots that may be seen in a tile, and the least key of each there; their number.
std::size_t selectSlots(
  const TriangleGroup::Slots& slots, int column, int row, std::int32_t* selected, float* keys)
{
  const DF df;
  const DI di;
  const F x = hn::Set(df, tileMiddle(column)), y = hn::Set(df, tileMiddle(row));
  const F half = hn::Set(df, HalfTile);
  const I tile = hn::Set(di, 1 << (GroupView::Tiles * row + column));
  const I thin = hn::Set(di, TriangleGroup::Thin);
  std::size_t count = 0;
  for (std::size_t s = 0; s < slots.count; s += hn::Lanes(df))
  {
    const I tiles = hn::LoadU(di, slots.tiles.data() + s);
    auto mine = hn::RebindMask(df, hn::Eq(hn::And(tiles, tile), tile));
    if (slots.count - s < hn::Lanes(df))
    {
      mine = hn::And(mine, hn::FirstN(df, slots.count - s));
    }
    if (hn::AllFalse(df, mine))
    {
      continue;
    }
    auto out = hn::Ne(x, x);
    for (int e = 0; e < 3; ++e)
    {
      const F ex = hn::LoadU(df, slots.ex[e].data() + s);
      const F ey = hn::LoadU(df, slots.ey[e].data() + s);
      const F middle = hn::MulAdd(ex, x, hn::MulAdd(ey, y, hn::LoadU(df, slots.ec[e].data() + s)));
      const F best = hn::MulAdd(half, hn::Add(hn::Abs(ex), hn::Abs(ey)), middle);
      out = hn::Or(out, hn::Lt(best, hn::Set(df, -1.0f)));
    }
    const I flags = hn::LoadU(di, slots.flags.data() + s);
    out = hn::And(out, hn::RebindMask(df, hn::Ne(hn::And(flags, thin), thin)));
    mine = hn::AndNot(out, mine);
    const F kx = hn::LoadU(df, slots.kx.data() + s), ky = hn::LoadU(df, slots.ky.data() + s);
    const F middle = hn::MulAdd(kx, x, hn::MulAdd(ky, y, hn::LoadU(df, slots.kc.data() + s)));
    const F key = hn::Sub(hn::Sub(middle, hn::Mul(half, hn::Add(hn::Abs(kx), hn::Abs(ky)))),
      hn::LoadU(df, slots.slack.data() + s));
    // What is not a number comes first.
    const F known =
      hn::IfThenElse(hn::Eq(key, key), key, hn::Set(df, -std::numeric_limits<float>::infinity()));
    const LaneCompressor pack(mine);
    pack.store(known, keys + count);
    pack.store(hn::Iota(di, static_cast<std::int32_t>(s)), selected + count);
    count += pack.size();
  }
  return count;
}

/// Sorts by key: where there are few, each counts how many are nearer.
void sortByKey(
  const std::int32_t* selected, float* keys, std::size_t count, std::vector<SeenTriangle>& seen)
{
  const DF df;
  constexpr std::size_t Few = 256;
  if (count > Few)
  {
    for (std::size_t k = 0; k < count; ++k)
    {
      seen[k] = { keys[k], selected[k], 0 };
    }
    std::sort(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(count),
      [](const SeenTriangle& a, const SeenTriangle& b) { return a.key < b.key; });
    return;
  }
  // Behind the last there is room for a vector.
  hn::StoreU(hn::Set(df, std::numeric_limits<float>::infinity()), df, keys + count);
  std::uint64_t taken[Few / 64] = {};
  for (std::size_t k = 0; k < count; ++k)
  {
    const F key = hn::Set(df, keys[k]);
    std::size_t nearer = 0;
    for (std::size_t i = 0; i < count; i += hn::Lanes(df))
    {
      nearer += hn::CountTrue(df, hn::Lt(hn::LoadU(df, keys + i), key));
    }
    while (taken[nearer / 64] >> nearer % 64 & 1) // equal keys
    {
      ++nearer;
    }
    taken[nearer / 64] |= std::uint64_t(1) << nearer % 64;
    seen[nearer] = { keys[k], selected[k], 0 };
  }
}
}
}
HWY_AFTER_NAMESPACE();

#endif
