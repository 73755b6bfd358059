#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoMapPlaces.cxx"
#include <hwy/foreach_target.h>

#include "svoMapPlaces.h"

#include "svoLaneBits-inl.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <hwy/highway.h>

#ifndef SVO_MAP_PLACES_ONCE
#define SVO_MAP_PLACES_ONCE
namespace svo
{
/// A function of the way from a patch's origin.
struct AffineOfWay
{
  float atOrigin;
  glm::vec3 along;
  float size(const glm::vec3& extent) const
  {
    return std::abs(atOrigin) + glm::dot(glm::abs(along), extent);
  }
};

/// A map as the points of a patch see it; depths are linear ones from the light's view.
struct MapFromPatch
{
  AffineOfWay x, y, w;            // (X - x0 W) / w, (Y - y0 W) / w, W / w; w at the origin
  AffineOfWay t;                  // linear depth, less the origin's
  float left, right, bottom, top; // borders of the map, texels from x0, y0
};
}
#endif

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
using Lanes = hn::Vec<Floats>;

HWY_INLINE Lanes at(const AffineOfWay& f, Lanes x, Lanes y, Lanes z)
{
  const Floats d;
  const Lanes a = hn::Add(hn::Mul(hn::Set(d, f.along.x), x), hn::Mul(hn::Set(d, f.along.y), y));
  return hn::Add(hn::Add(a, hn::Mul(hn::Set(d, f.along.z), z)), hn::Set(d, f.atOrigin));
}

void place(const MapFromPatch& map, const TilePatch& p, std::uint64_t lanes, MapPlaces& places)
{
  const Floats d;
  const auto one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
  const auto error = hn::Set(d, places.error), less = hn::Set(d, 1.0f - places.error);
  const auto far = hn::Set(d, 1e30f), near = hn::Set(d, -1e30f);
  auto lowX = far, highX = near, lowY = far, highY = near, lowT = far, highT = near;
  std::uint64_t insides = 0, outsides = 0, sures = 0;
  for (int i = 0; i < TilePatch::Most; i += width())
  {
    const auto asked = maskOf(d, lanes >> i);
    if (hn::AllFalse(d, asked))
    {
      continue;
    }
    const auto wayX = hn::Load(d, p.way.x + i), wayY = hn::Load(d, p.way.y + i);
    const auto wayZ = hn::Load(d, p.way.z + i);
    const auto inverse = hn::Div(one, at(map.w, wayX, wayY, wayZ));
    const auto x = hn::Mul(at(map.x, wayX, wayY, wayZ), inverse);
    const auto y = hn::Mul(at(map.y, wayX, wayY, wayZ), inverse);
    const auto t = at(map.t, wayX, wayY, wayZ);
    const auto floorX = hn::Floor(x), floorY = hn::Floor(y);
    const auto partX = hn::Sub(x, floorX), partY = hn::Sub(y, floorY);
    const auto sure = hn::And(hn::And(hn::Gt(partX, error), hn::Lt(partX, less)),
      hn::And(hn::Gt(partY, error), hn::Lt(partY, less)));
    const auto within = [&](Lanes v, float from, float to)
    {
      return hn::And(
        hn::Gt(v, hn::Set(d, from + places.error)), hn::Lt(v, hn::Set(d, to - places.error)));
    };
    const auto beyond = [&](Lanes v, float from, float to)
    {
      return hn::Or(
        hn::Lt(v, hn::Set(d, from - places.error)), hn::Gt(v, hn::Set(d, to + places.error)));
    };
    const auto inside =
      hn::And(asked, hn::And(within(x, map.left, map.right), within(y, map.bottom, map.top)));
    const auto outside = hn::Or(beyond(x, map.left, map.right), beyond(y, map.bottom, map.top));
    outsides |= bitsOf(d, hn::And(asked, outside)) << i;
    insides |= bitsOf(d, inside) << i;
    sures |= bitsOf(d, hn::And(inside, sure)) << i;
    hn::Store(x, d, places.x + i);
    hn::Store(y, d, places.y + i);
    hn::Store(hn::Add(floorX, half), d, places.centreX + i);
    hn::Store(hn::Add(floorY, half), d, places.centreY + i);
    hn::Store(t, d, places.t + i);
    lowX = hn::Min(lowX, hn::IfThenElse(inside, x, far));
    lowY = hn::Min(lowY, hn::IfThenElse(inside, y, far));
    lowT = hn::Min(lowT, hn::IfThenElse(inside, t, far));
    highX = hn::Max(highX, hn::IfThenElse(inside, x, near));
    highY = hn::Max(highY, hn::IfThenElse(inside, y, near));
    highT = hn::Max(highT, hn::IfThenElse(inside, t, near));
  }
  places.inside = insides;
  places.outside = outsides;
  places.sure = sures;
  if (insides != 0)
  {
    places.lowX = hn::GetLane(hn::MinOfLanes(d, lowX));
    places.lowY = hn::GetLane(hn::MinOfLanes(d, lowY));
    places.lowT = hn::GetLane(hn::MinOfLanes(d, lowT));
    places.highX = hn::GetLane(hn::MaxOfLanes(d, highX));
    places.highY = hn::GetLane(hn::MaxOfLanes(d, highY));
    places.highT = hn::GetLane(hn::MaxOfLanes(d, highT));
  }
}

/// `margin`: of the box around a point, texels; texels of the map, the last ones included, from the
/// first one of the tiles that bits are of.
std::uint64_t around(const MapPlaces& places, float margin, const glm::vec2& fromTile,
  const glm::vec2& firstTexel, const glm::vec2& lastTexel)
{
  // Copied first, so that the loop is of vectors.
  const glm::vec2 from = fromTile, firstOf = firstTexel, lastOf = lastTexel;
  // By point: its first tile among those 8x8, and by how much further bits have to be shifted.
  alignas(64) std::int32_t first[TilePatch::Most], across[TilePatch::Most], up[TilePatch::Most];
  const auto tile = [](float x, float least, float last)
  {
    const float low = least < x ? x : least; // what is not a number is the least
    return static_cast<std::int32_t>(low < last ? low : last) >> 3;
  };
  for (int k = 0; k < TilePatch::Most; ++k)
  {
    const float x = from.x + places.x[k], y = from.y + places.y[k];
    const std::int32_t left = tile(x - margin, firstOf.x, lastOf.x);
    const std::int32_t right = tile(x + margin, firstOf.x, lastOf.x);
    const std::int32_t bottom = tile(y - margin, firstOf.y, lastOf.y);
    const std::int32_t top = tile(y + margin, firstOf.y, lastOf.y);
    first[k] = 8 * bottom + left;
    across[k] = right - left;
    up[k] = 8 * (top - bottom);
  }
  std::uint64_t tiles = 0;
  eachBit(places.inside,
    [&](int i)
    {
      const std::uint64_t row = 1u | std::uint64_t(1) << across[i];
      tiles |= (row | row << up[i]) << first[i];
    });
  return tiles;
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(place);
HWY_EXPORT(around);

namespace
{
AffineOfWay rounded(double atOrigin, const glm::dvec3& along)
{
  return { static_cast<float>(atOrigin), glm::vec3(along) };
}

glm::dvec3 row(const glm::dmat4& m, int i)
{
  return { m[0][i], m[1][i], m[2][i] };
}

/// True if all of a patch lies beyond one side of the map for certain. Behind the light that is so
/// of all but what is close to it, since what two opposite sides say has the sign of w there.
bool isBeyond(const MapGeometry& map, const glm::dvec4& clip, const TilePatch& patch)
{
  const glm::dmat4& worldToClip = map.worldToClip;
  const auto within = [&](int axis)
  { return map.low[axis] * clip.w <= clip[axis] && clip[axis] <= map.high[axis] * clip.w; };
  if (within(0) && within(1))
  {
    return false; // its origin does not
  }
  constexpr double OfDouble = 1e-11; // more than what sums lose, and MapBorder
  const glm::dvec3& origin = patch.origin.position;
  const glm::dvec3 extent = (1.0 + 2.0 * WayError) * glm::dvec3(patch.extent);
  const auto size = [&](int i) {
    return glm::dot(glm::abs(row(worldToClip, i)), glm::abs(origin)) + std::abs(worldToClip[3][i]);
  };
  bool beyond = false;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double error = OfDouble * (size(axis) + size(3));
    for (const double side : { 1.0, -1.0 })
    {
      const double border = side > 0.0 ? -map.low[axis] : map.high[axis];
      const glm::dvec3 along = border * row(worldToClip, 3) + side * row(worldToClip, axis);
      const double most = border * clip.w + side * clip[axis] + glm::dot(glm::abs(along), extent);
      beyond = beyond || most < -error;
    }
  }
  return beyond;
}
}

void placeInMap(
  const MapGeometry& geometry, const TilePatch& patch, std::uint64_t lanes, MapPlaces& places)
{
  const View& view = geometry.view;
  const glm::dmat4& worldToClip = geometry.worldToClip;
  constexpr float OfAffine = 14.0f * FloatRounding;
  // Texels: more than what double loses, and MapBorder.
  const float ofDouble =
    1e-5f + 1e-12f * static_cast<float>(std::max(geometry.view.width, geometry.view.height));
  places.inside = places.outside = places.sure = 0;
  const glm::dvec3& origin = patch.origin.position;
  const glm::dvec4 clip = worldToClip * glm::dvec4(origin, 1.0);
  if (isBeyond(geometry, clip, patch))
  {
    places.outside = lanes;
    return;
  }
  const double width = 0.5 * view.width, height = 0.5 * view.height, scale = 1.0 / clip.w;
  const double x = (clip.x * scale + 1.0) * width, y = (clip.y * scale + 1.0) * height;
  constexpr double Farthest = 1e6; // texels beyond the map, of an origin that is looked at here
  const PixelRect& crop = view.crop;
  if (!(clip.w > 0.0 && std::abs(x - crop.x0) < Farthest && std::abs(y - crop.y0) < Farthest))
  {
    return;
  }
  const double x0 = std::floor(x), y0 = std::floor(y);
  const glm::dvec3 rowW = row(worldToClip, 3) * scale;
  const glm::dvec3 rowX = width * (row(worldToClip, 0) * scale + rowW) - x0 * rowW;
  const glm::dvec3 rowY = height * (row(worldToClip, 1) * scale + rowW) - y0 * rowW;
  const glm::dvec3 depth = -row(view.worldToView, 2);
  const MapFromPatch map{ rounded(x - x0, rowX), rounded(y - y0, rowY), rounded(1.0, rowW),
    rounded(0.0, depth), static_cast<float>(crop.x0 - x0), static_cast<float>(crop.x1 - x0),
    static_cast<float>(crop.y0 - y0), static_cast<float>(crop.y1 - y0) };
  places.x0 = static_cast<int>(x0);
  places.y0 = static_cast<int>(y0);
  places.t0 = glm::dot(depth, origin) - view.worldToView[3][2];
  // Of a quotient a / b: (error of a + |a / b| error of b) / b, and its rounding.
  const float largest = map.w.size(patch.extent), smallest = 2.0f - largest;
  const float most = std::max(map.x.size(patch.extent), map.y.size(patch.extent)) / smallest;
  places.error = OfAffine * most * (1.0f + largest / smallest) + ofDouble;
  if (smallest > 0.0f && places.error < 0.25f)
  {
    HWY_DYNAMIC_DISPATCH(place)(map, patch, lanes, places);
  }
}

MapTiles tilesOf(const MapPlaces& places, const View& map, float margin)
{
  assert(places.inside != 0);
  // Truncated, once nothing is negative.
  const auto tile = [](int from, float way, int first, int end)
  {
    const double texel = from + static_cast<double>(way);
    return static_cast<int>(std::clamp<double>(texel, first, end - 1)) >> 3;
  };
  const float most = margin + places.error;
  const PixelRect& crop = map.crop;
  return { tile(places.x0, places.lowX - most, crop.x0, crop.x1),
    tile(places.y0, places.lowY - most, crop.y0, crop.y1),
    tile(places.x0, places.highX + most, crop.x0, crop.x1),
    tile(places.y0, places.highY + most, crop.y0, crop.y1) };
}

std::uint64_t tilesAround(
  const MapPlaces& places, const View& map, float margin, const MapTiles& tiles)
{
  assert(tiles.atMost(8));
  const int x = 8 * tiles.x0, y = 8 * tiles.y0;
  const PixelRect& crop = map.crop;
  return HWY_DYNAMIC_DISPATCH(around)(places, margin + places.error,
    glm::vec2(places.x0 - x, places.y0 - y), glm::vec2(crop.x0 - x, crop.y0 - y),
    glm::vec2(crop.x1 - 1 - x, crop.y1 - 1 - y));
}
}
#endif
