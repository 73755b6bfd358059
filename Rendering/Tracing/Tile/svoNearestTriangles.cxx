// A group's triangles drawn into one of its tiles, nearest first.
//
// Each pixel keeps the triangle that is certainly met and whose hit is certainly least deep: an
// upper bound of its key. Of all others that may be met there it keeps the least lower bound. Where
// that is not above, the ray is doubtful: the float test of svoTriangle.h has to say what it meets.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoNearestTriangles.cxx"
#include <hwy/foreach_target.h>

#include "svoLaneBits-inl.h"
#include "svoLaneMoves-inl.h"
#include "svoTriangleGroup.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include <hwy/highway.h>

#ifndef SVO_NEAREST_TRIANGLES_ONCE
#define SVO_NEAREST_TRIANGLES_ONCE
namespace svo
{
constexpr float HalfTile = 3.5f; // from the middle of a tile to the centres of its outer pixels

/// From the middle of a group to that of a tile, pixels.
inline float tileMiddle(int column)
{
  return 8.0f * static_cast<float>(column) + 4.0f - 0.5f * GroupView::Pixels;
}

/// Pixel i of a tile, from the tile's middle.
struct TilePixels
{
  alignas(64) float x[64], y[64];

  TilePixels()
  {
    for (int i = 0; i < 64; ++i)
    {
      x[i] = static_cast<float>(i & 7) - HalfTile;
      y[i] = static_cast<float>(i >> 3) - HalfTile;
    }
  }
};

/// The pixels of a tile, one bit each, in the box around a triangle.
inline std::uint64_t boxBits(const TriangleGroup::Slots& slots, std::size_t slot, int x, int y)
{
  const int x0 = std::max(slots.x0[slot] - x, 0), x1 = std::min(slots.x1[slot] - x, 7);
  const int y0 = std::max(slots.y0[slot] - y, 0), y1 = std::min(slots.y1[slot] - y, 7);
  assert(x0 <= x1 && y0 <= y1);
  const std::uint64_t row = (0xffu >> (7 - (x1 - x0))) << x0;
  return (row * 0x0101010101010101u) & (~std::uint64_t(0) << 8 * y0) &
    (~std::uint64_t(0) >> 8 * (7 - y1));
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

/// What the pixels of a tile know so far; keys.
struct DrawnTile
{
  HWY_ALIGN float upper[64]; // of what is met
  HWY_ALIGN float lower[64]; // likewise
  HWY_ALIGN float rival[64]; // the least of anything else
};

/// A triangle's functions, from the middle of the tile.
struct DrawnTriangle
{
  float x[4], y[4], c[4]; // three edges and the key
  float slack;
  std::int32_t slot;

  DrawnTriangle(const TriangleGroup::Slots& slots, std::int32_t s, float tileX, float tileY)
    : slack(slots.slack[s])
    , slot(s)
  {
    for (int e = 0; e < 4; ++e)
    {
      x[e] = e < 3 ? slots.ex[e][s] : slots.kx[s];
      y[e] = e < 3 ? slots.ey[e][s] : slots.ky[s];
      c[e] = (e < 3 ? slots.ec[e][s] : slots.kc[s]) + (x[e] * tileX + y[e] * tileY);
    }
  }
};

/// Returns the pixels where the triangle may be met first. `Odd`: of one with flags that matter
/// here.
template <bool Odd>
HWY_NOINLINE std::uint64_t draw(const TriangleGroup::Slots& slots, const TilePixels& pixels,
  const DrawnTriangle& t, std::uint64_t box, DrawnTile& tile, std::int32_t* nearest)
{
  const DF df;
  const DI di;
  const F one = hn::Set(df, 1.0f), none = hn::Set(df, -1.0f);
  const F slack = hn::Set(df, t.slack);
  const F infinity = hn::Set(df, std::numeric_limits<float>::infinity());
  constexpr std::size_t Step = hn::MaxLanes(DF());
  std::uint64_t met = 0;
  // From the box's first row to its last one, and few branches, which nobody could foretell.
  const std::size_t last = 63 - __builtin_clzll(box);
  for (std::size_t i = __builtin_ctzll(box) / Step * Step; i <= last; i += Step)
  {
    if (Step < 8 && ((box >> i) & (~std::uint64_t(0) >> (64 - Step))) == 0)
    {
      continue;
    }
    const F x = hn::Load(df, pixels.x + i), y = hn::Load(df, pixels.y + i);
    const auto at = [&](int f)
    {
      return hn::MulAdd(
        hn::Set(df, t.x[f]), x, hn::MulAdd(hn::Set(df, t.y[f]), y, hn::Set(df, t.c[f])));
    };
    const F e0 = at(0), e1 = at(1), e2 = at(2);
    const F inside = hn::Min(hn::Min(e0, e1), e2);
    auto maybe = hn::And(hn::Ge(inside, none), maskOf(df, box >> i));
    auto surely = hn::Gt(inside, one);
    const F key = at(3);
    const F low = hn::Sub(key, slack);
    F high = hn::Add(key, slack);
    if (Odd)
    {
      const std::int32_t flags = slots.flags[t.slot];
      if (flags & TriangleGroup::Thin)
      {
        const F outside = hn::Max(hn::Max(e0, e1), e2);
        maybe = hn::And(maskOf(df, box >> i), hn::Or(hn::Ge(inside, none), hn::Le(outside, one)));
      }
      else if (flags & TriangleGroup::Clipped)
      {
        const F kNear = hn::Set(df, slots.kNear[t.slot]), kFar = hn::Set(df, slots.kFar[t.slot]);
        maybe = hn::And(maybe, hn::And(hn::Ge(high, kNear), hn::Le(low, kFar)));
        surely = hn::And(surely, hn::And(hn::Ge(low, kNear), hn::Le(high, kFar)));
      }
      if (flags & (TriangleGroup::Thin | TriangleGroup::Unsure))
      {
        surely = hn::Ne(one, one);
      }
    }
    const F upper = hn::Load(df, tile.upper + i);
    maybe = hn::And(maybe, hn::Le(low, upper));
    met |= bitsOf(df, maybe) << i;
    high = hn::IfThenElse(surely, high, infinity);
    const F lower = hn::Load(df, tile.lower + i);
    const F rival = hn::Load(df, tile.rival + i);
    const auto first = hn::And(maybe, hn::Lt(high, upper));
    const F behind = hn::IfThenElse(first, lower, low);
    hn::Store(hn::IfThenElse(maybe, hn::Min(rival, behind), rival), df, tile.rival + i);
    hn::Store(hn::IfThenElse(first, high, upper), df, tile.upper + i);
    hn::Store(hn::IfThenElse(first, low, lower), df, tile.lower + i);
    hn::Store(
      hn::IfThenElse(hn::RebindMask(di, first), hn::Set(di, t.slot), hn::Load(di, nearest + i)), di,
      nearest + i);
  }
  return met;
}

/// The numbers of a tile among those of a group's pixels, which are row by row.
template <class T>
HWY_INLINE void copyTile(const T* from, int column, int row, T* to)
{
  const hn::CappedTag<T, 8> d;
  from += GroupView::Pixels * 8 * row + 8 * column;
  for (int y = 0; y < 8; ++y)
  {
    for (std::size_t x = 0; x < 8; x += hn::Lanes(d))
    {
      hn::Store(hn::LoadU(d, from + GroupView::Pixels * y + x), d, to + 8 * y + x);
    }
  }
}

/// What small triangles leave of a tile; the pixels that they cover for certain.
HWY_INLINE std::uint64_t begin(
  const GroupPixels& small, int column, int row, DrawnTile& tile, std::int32_t* nearest)
{
  const DF df;
  const DI di;
  const F infinity = hn::Set(df, std::numeric_limits<float>::infinity());
  const I none = hn::Set(di, NearestTriangles::None);
  if (!small.empty())
  {
    copyTile(small.upper(), column, row, tile.upper);
    copyTile(small.lower(), column, row, tile.lower);
    copyTile(small.rival(), column, row, tile.rival);
    std::uint64_t covered = 0;
    for (std::size_t i = 0; i < 64; i += hn::Lanes(df))
    {
      const auto met = hn::Lt(hn::Load(df, tile.upper + i), infinity);
      covered |= bitsOf(df, met) << i;
      hn::Store(hn::IfThenElse(hn::RebindMask(di, met), hn::Set(di, NearestTriangles::Small), none),
        di, nearest + i);
    }
    return covered;
  }
  for (std::size_t i = 0; i < 64; i += hn::Lanes(df))
  {
    hn::Store(infinity, df, tile.upper + i);
    hn::Store(infinity, df, tile.lower + i);
    hn::Store(infinity, df, tile.rival + i);
    hn::Store(none, di, nearest + i);
  }
  return 0;
}

/// What the slots of a tile stand for.
HWY_INLINE void name(const TriangleGroup::Slots& slots, const GroupPixels& small, int column,
  int row, NearestTriangles& found, std::uint32_t* triangles, std::uint32_t* owners)
{
  const DI di;
  const auto* ids = reinterpret_cast<const std::int32_t*>(slots.id.data());
  const auto* ownerOf = reinterpret_cast<const std::int32_t*>(slots.owner.data());
  HWY_ALIGN std::int32_t smallIds[64];
  HWY_ALIGN std::int32_t smallOwners[64];
  if (!small.empty())
  {
    copyTile(reinterpret_cast<const std::int32_t*>(small.triangle()), column, row, smallIds);
    copyTile(reinterpret_cast<const std::int32_t*>(small.owner()), column, row, smallOwners);
  }
  const I nobody = hn::Set(di, NearestTriangles::None);
  for (std::size_t i = 0; i < 64; i += hn::Lanes(di))
  {
    const I slot = hn::Load(di, found.slot + i);
    const auto some = hn::Gt(slot, nobody);
    I id = nobody, owner = nobody;
    const std::int32_t first = found.slot[i];
    if (first >= 0 && hn::AllTrue(di, hn::Eq(slot, hn::Set(di, first))))
    {
      id = hn::Set(di, ids[first]);
      owner = hn::Set(di, ownerOf[first]);
    }
    else if (!hn::AllFalse(di, some))
    {
      const I at = hn::IfThenElseZero(some, slot);
      id = hn::IfThenElse(some, hn::GatherIndex(di, ids, at), nobody);
      owner = hn::IfThenElse(some, hn::GatherIndex(di, ownerOf, at), nobody);
    }
    const auto few = hn::Eq(slot, hn::Set(di, NearestTriangles::Small));
    if (!hn::AllFalse(di, few))
    {
      const I named = hn::Load(di, smallIds + i);
      const I triangle = hn::And(named, hn::Set(di, static_cast<std::int32_t>(~SeenPoints::Steep)));
      id = hn::IfThenElse(few, triangle, id);
      owner = hn::IfThenElse(few, hn::Load(di, smallOwners + i), owner);
    }
    hn::StoreU(id, di, reinterpret_cast<std::int32_t*>(triangles) + i);
    hn::StoreU(owner, di, reinterpret_cast<std::int32_t*>(owners) + i);
  }
}

bool nearestInTile(const TriangleGroup::Slots& slots, const GroupPixels& small,
  const TilePixels& pixels, int column, int row, NearestTriangles& found, std::uint32_t* triangles,
  std::uint32_t* owners)
{
  const DF df;
  const float infinity = std::numeric_limits<float>::infinity();
  const std::size_t room = slots.count + 2 * hn::Lanes(df);
  if (found.selected.size() < room)
  {
    found.selected.resize(2 * room);
    found.keys.resize(2 * room);
  }
  const std::size_t count =
    selectSlots(slots, column, row, found.selected.data(), found.keys.data());
  found.seen.resize(count);
  if (count == 0 && small.empty())
  {
    return false;
  }
  sortByKey(found.selected.data(), found.keys.data(), count, found.seen);
  DrawnTile tile;
  constexpr std::int32_t OddFlags =
    TriangleGroup::Thin | TriangleGroup::Unsure | TriangleGroup::Clipped;
  const float x = tileMiddle(column), y = tileMiddle(row);
  std::uint64_t covered = begin(small, column, row, tile, found.slot); // others by boxes
  float deepest = ~covered == 0 ? highestOf(tile.upper) : infinity;
  for (std::size_t k = 0; k < count && found.seen[k].key <= deepest; ++k)
  {
    const std::int32_t slot = found.seen[k].slot;
    const std::uint64_t box = boxBits(slots, slot, 8 * column, 8 * row);
    const DrawnTriangle triangle(slots, slot, x, y);
    if (slots.flags[slot] & OddFlags)
    {
      found.seen[k].pixels = draw<true>(slots, pixels, triangle, box, tile, found.slot);
    }
    else
    {
      found.seen[k].pixels = draw<false>(slots, pixels, triangle, box, tile, found.slot);
    }
    covered |= box;
    if (~covered == 0 && (k % 4 == 0 || ~box == 0))
    {
      deepest = highestOf(tile.upper);
    }
  }
  found.doubtful = 0;
  bool any = false;
  for (std::size_t i = 0; i < 64; i += hn::Lanes(df))
  {
    const F upper = hn::Load(df, tile.upper + i);
    const F rival = hn::Load(df, tile.rival + i);
    const F none = hn::Set(df, infinity);
    found.doubtful |= bitsOf(df, hn::And(hn::Le(rival, upper), hn::Lt(rival, none))) << i;
    any = any || !hn::AllTrue(df, hn::Eq(hn::Min(rival, upper), none));
  }
  if (!any)
  {
    return false;
  }
  name(slots, small, column, row, found, triangles, owners);
  return true;
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(nearestInTile);

bool TriangleGroup::nearest(int column, int row, NearestTriangles& found, std::uint32_t* triangles,
  std::uint32_t* owners) const
{
  assert(column >= 0 && column < GroupView::Tiles && row >= 0 && row < GroupView::Tiles);
  static const TilePixels pixels;
  return HWY_DYNAMIC_DISPATCH(nearestInTile)(
    this->Arrays, this->Small, pixels, column, row, found, triangles, owners);
}
}
#endif
