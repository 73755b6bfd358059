#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoMapTexels.cxx"
#include <hwy/foreach_target.h>

#include "svoMapTexels.h"

#include "svoLaneBits-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
using Lanes = hn::Vec<Floats>;
using Indices = hn::Vec<Integers>;

/// What lies at the texels of some lanes.
struct Lying
{
  hn::Vec<Words> caster;
  Lanes t;
};

/// Tiles of texels.
HWY_INLINE Indices tileOf(const MapTexels& map, Indices x, Indices y)
{
  const Integers d;
  const auto column = hn::And(hn::ShiftRight<3>(x), hn::Set(d, map.grid.maskX));
  const auto row = hn::And(hn::ShiftRight<3>(y), hn::Set(d, map.grid.maskY));
  return hn::Add(hn::Mul(row, hn::Set(d, map.grid.columns)), column);
}

/// Indices of texels into the map's arrays.
HWY_INLINE Indices indexOf(Indices tile, Indices x, Indices y)
{
  const auto seven = hn::Set(Integers(), 7);
  const auto inTile = hn::Add(hn::ShiftLeft<3>(hn::And(y, seven)), hn::And(x, seven));
  return hn::Add(hn::ShiftLeft<6>(tile), inTile);
}

/// `wanted`: of others nothing is said, and their texel is any of the map.
HWY_INLINE Lying lyingAt(const MapTexels& map, Indices x, Indices y, hn::Mask<Integers> wanted)
{
  const Floats d;
  const Words words;
  const Integers integers;
  const auto tile = tileOf(map, x, y), at = indexOf(tile, x, y);
  static_assert(sizeof(TileOccluders) == 12);
  const auto nearest = hn::GatherIndex(d, &map.tiles->nearest, hn::Add(tile, hn::Add(tile, tile)));
  const auto known = hn::And(hn::RebindMask(d, wanted), hn::Lt(nearest, hn::Inf(d)));
  const auto where = hn::IfThenElseZero(hn::RebindMask(integers, known), at);
  return { hn::IfThenElse(hn::RebindMask(words, known), hn::GatherIndex(words, map.instance, where),
             hn::Set(words, NoInstance)),
    hn::GatherIndex(d, map.t, where) };
}

/// Columns or rows of texels, of which `centres` are the centres from a first one; the first one of
/// the map for lanes that are not wanted.
HWY_INLINE Indices texelsOf(const float* centres, int first, hn::Mask<Integers> wanted)
{
  const Floats d;
  const Integers integers;
  const auto way = hn::ConvertTo(integers, hn::Sub(hn::Load(d, centres), hn::Set(d, 0.5f)));
  return hn::IfThenElseZero(wanted, hn::Add(hn::Set(integers, first), way));
}

void gatherDepths(const MapTexels& map, const MapPlaces& places, TexelOccluders& occluders)
{
  const Floats d;
  const Integers integers;
  for (int i = 0; i < TilePatch::Most; i += width())
  {
    const auto sure = maskOf(integers, places.sure >> i);
    if (hn::AllFalse(integers, sure))
    {
      continue;
    }
    const auto x = texelsOf(places.centreX + i, places.x0, sure);
    const auto y = texelsOf(places.centreY + i, places.y0, sure);
    // Of others the map's first texel, which nobody has written perhaps, and nobody reads.
    const auto at = hn::IfThenElseZero(sure, indexOf(tileOf(map, x, y), x, y));
    hn::Store(hn::GatherIndex(d, map.t, at), d, occluders.t + i);
  }
}

std::uint64_t gather(
  const MapTexels& map, const MapPlaces& places, TexelOccluders& occluders, std::uint64_t& same)
{
  const Floats d;
  const Words words;
  const Integers integers;
  std::uint64_t found = 0;
  for (int i = 0; i < TilePatch::Most; i += width())
  {
    const auto sure = maskOf(integers, places.sure >> i);
    if (hn::AllFalse(integers, sure))
    {
      continue;
    }
    const Lying lying = lyingAt(map, texelsOf(places.centreX + i, places.x0, sure),
      texelsOf(places.centreY + i, places.y0, sure), sure);
    hn::Store(lying.caster, words, occluders.caster + i);
    hn::Store(lying.t, d, occluders.t + i);
    found |= bitsOf(words, hn::Ne(lying.caster, hn::Set(words, NoInstance))) << i;
  }
  same = 0;
  if (found != 0)
  {
    const std::uint32_t first = occluders.caster[__builtin_ctzll(found)];
    same = found & lanesOf(occluders.caster, first, TilePatch::Most);
  }
  return found;
}

/// By how much the middle one of three depths of one caster is beside the others, at most: the
/// differences are rounded once each, and so is theirs.
HWY_INLINE Lanes bend(Lanes before, Lanes here, Lanes after)
{
  const Floats d;
  const auto a = hn::Sub(before, here), b = hn::Sub(here, after);
  const auto rounding = hn::Mul(hn::Set(d, 4.0f * FloatRounding), hn::Add(hn::Abs(a), hn::Abs(b)));
  return hn::Add(hn::Abs(hn::Sub(a, b)), rounding);
}

/// `between`: texels of the map that have two neighbours, the last ones included; `edge`,
/// `perDepth`: of a texel.
std::uint64_t findFlat(const MapTexels& map, const MapPlaces& places, std::uint64_t lanes,
  const PixelRect& between, float edge, float perDepth)
{
  const Floats d;
  const Words words;
  const Integers integers;
  const auto one = hn::Set(integers, 1);
  std::uint64_t flat = 0;
  for (int i = 0; i < TilePatch::Most; i += width())
  {
    const auto asked = maskOf(integers, (lanes & places.sure) >> i);
    const auto x = texelsOf(places.centreX + i, places.x0, asked);
    const auto y = texelsOf(places.centreY + i, places.y0, asked);
    const auto within = [&](Indices v, int first, int last)
    {
      return hn::And(
        hn::Gt(v, hn::Set(integers, first - 1)), hn::Lt(v, hn::Set(integers, last + 1)));
    };
    const auto wanted =
      hn::And(asked, hn::And(within(x, between.x0, between.x1), within(y, between.y0, between.y1)));
    if (hn::AllFalse(integers, wanted))
    {
      continue;
    }
    Lying texels[3][3];
    auto same = wanted;
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        const auto beside = [&](Indices v, int by)
        { return hn::IfThenElseZero(wanted, hn::Sub(hn::Add(v, hn::Set(integers, by)), one)); };
        texels[row][column] = lyingAt(map, beside(x, column), beside(y, row), wanted);
        same = hn::And(
          same, hn::RebindMask(integers, hn::Eq(texels[row][column].caster, texels[0][0].caster)));
      }
    }
    const auto nothing = hn::Eq(texels[0][0].caster, hn::Set(words, NoInstance));
    auto most = hn::Zero(d);
    for (int k = 0; k < 3; ++k)
    {
      most = hn::Max(most, bend(texels[k][0].t, texels[k][1].t, texels[k][2].t));
      most = hn::Max(most, bend(texels[0][k].t, texels[1][k].t, texels[2][k].t));
    }
    const auto allowed =
      hn::Add(hn::Set(d, edge), hn::Mul(hn::Load(d, places.t + i), hn::Set(d, perDepth)));
    const auto straight =
      hn::Or(hn::RebindMask(d, nothing), hn::Lt(most, hn::Mul(allowed, hn::Set(d, 0.999f))));
    flat |= bitsOf(d, hn::And(hn::RebindMask(d, same), straight)) << i;
  }
  return flat & lanes & places.sure;
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(gatherDepths);
HWY_EXPORT(gather);
HWY_EXPORT(findFlat);

void lookUpDepths(const MapTexels& map, const MapPlaces& places, TexelOccluders& occluders)
{
  HWY_DYNAMIC_DISPATCH(gatherDepths)(map, places, occluders);
}

std::uint64_t lookUpTexels(
  const MapTexels& map, const MapPlaces& places, TexelOccluders& occluders, std::uint64_t& same)
{
  return HWY_DYNAMIC_DISPATCH(gather)(map, places, occluders, same);
}

std::uint64_t flatWindows(
  const MapGeometry& geometry, const MapTexels& map, const MapPlaces& places, std::uint64_t lanes)
{
  const PixelRect& crop = geometry.view.crop;
  const TexelEdge& edge = geometry.edge;
  const PixelRect between{ crop.x0 + 1, crop.y0 + 1, crop.x1 - 2, crop.y1 - 2 };
  return HWY_DYNAMIC_DISPATCH(findFlat)(map, places, lanes, between,
    static_cast<float>(edge(places.t0)), static_cast<float>(edge.perDepth));
}
}
#endif
