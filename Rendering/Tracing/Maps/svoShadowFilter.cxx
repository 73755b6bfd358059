// The filtered test of a light's maps: which share of the light a point misses.
#include "svoShadowFilter.h"

#include "svoMapTest.h"
#include "svoShadowRules.h"
#include "svoTileShadows.h"

#include <algorithm>
#include <cmath>

namespace svo
{
double MapTest::boxWidth(const MapPlace& place, double extent)
{
  const double pixel = place.map->edge(place.t);
  return extent > pixel ? std::min(extent / pixel, WidestBox) : 1.0;
}

bool MapTest::isFlat(const MapPlace& place, double width)
{
  const TracedMap& map = *place.map;
  const TexelWindow x(place.x, width, map.view.crop.x0, map.view.crop.x1);
  const TexelWindow y(place.y, width, map.view.crop.y0, map.view.crop.y1);
  double t[TexelWindow::Most][TexelWindow::Most];
  int hits = 0;
  for (int j = 0; j < y.count; ++j)
  {
    for (int i = 0; i < x.count; ++i)
    {
      std::uint32_t caster;
      hits += map.occluder({ x.first + i, y.first + j }, caster, t[j][i]);
    }
  }
  if (hits < x.count * y.count)
  {
    return hits == 0;
  }
  // A second difference of more than a texel's edge is a step or a crease.
  const double most = map.edge(place.t);
  const auto bends = [most](double before, double here, double after)
  { return std::abs(before - 2.0 * here + after) > most; };
  for (int j = 0; j < y.count; ++j)
  {
    for (int i = 0; i < x.count; ++i)
    {
      if ((i >= 2 && bends(t[j][i - 2], t[j][i - 1], t[j][i])) ||
        (j >= 2 && bends(t[j - 2][i], t[j - 1][i], t[j][i])))
      {
        return false;
      }
    }
  }
  return true;
}

bool MapTest::endsBefore(const MapPlace& place, const glm::ivec2& texel, double error) const
{
  const TracedMap& map = *place.map;
  const double offset[2] = { texel.x + 0.5 - place.x, texel.y + 0.5 - place.y };
  const double pixel = map.edge(place.t);
  std::uint32_t caster, other;
  double here, farther;
  if (!map.occluder(texel, caster, here))
  {
    return false;
  }
  double t = here;
  for (int axis = 0; axis < 2; ++axis)
  {
    glm::ivec2 next = texel;
    next[axis] += offset[axis] < 0.0 ? -1 : 1;
    if (!map.has(next) || !map.occluder(next, other, farther) ||
      std::abs(farther - here) > NearbyReach * pixel)
    {
      return false;
    }
    t -= (farther - here) * std::abs(offset[axis]);
  }
  return !(t + TexelBend * pixel + std::max(map.casterError[caster], error) < place.t);
}

float MapTest::filtered(
  const MapPlace& place, double width, const SurfacePoint& point, double error, bool weighed) const
{
  const PixelRect& crop = place.map->view.crop;
  TexelWindow x(place.x, width, crop.x0, crop.x1);
  TexelWindow y(place.y, width, crop.y0, crop.y1);
  x.weigh();
  y.weigh();
  double sum = 0.0;
  bool anyDark = false, anyLit = false;
  for (int j = 0; j < y.count; ++j)
  {
    for (int i = 0; i < x.count; ++i)
    {
      const glm::ivec2 texel(x.first + i, y.first + j);
      const double away =
        std::max(std::abs(texel.x + 0.5 - place.x), std::abs(texel.y + 0.5 - place.y));
      const Answer answer = this->ask(place, texel, point, error, std::max(1.0, 2.0 * away));
      const bool dark = answer == Answer::Dark ||
        (answer == Answer::DarkNearby && !this->endsBefore(place, texel, error));
      const double weight = x.weight[i] * y.weight[j];
      sum += !dark ? 0.0 : weighed ? weight * this->opacity(*place.map, texel) : weight;
      anyDark = anyDark || dark;
      anyLit = anyLit || !dark;
    }
  }
  const bool whole = !anyLit && !weighed;
  return !anyDark ? 0.0f : whole ? 1.0f : static_cast<float>(std::clamp(sum, 0.0, 1.0));
}

float MapTest::darkness(const SurfacePoint& point, double error, double extent) const
{
  MapPlace place;
  if (!this->Maps.lookUp(point.position, place))
  {
    return 0.0f;
  }
  const double width = boxWidth(place, extent);
  if (this->Maps.automaticBias && !this->isFlat(place, width))
  {
    return this->filtered(place, width, point, error);
  }
  return this->shadows(place, point, error) ? 1.0f : 0.0f;
}

void MapTest::darkness(const TilePatch& patch, double error, const double* extents,
  std::uint64_t asked, float* darkness) const
{
  const std::uint64_t dark = this->shadows(patch, error, asked);
  for (int i = 0; i < TilePatch::Most; ++i)
  {
    darkness[i] = dark >> i & 1 ? 1.0f : 0.0f;
  }
  constexpr float Beyond = 0.5f * static_cast<float>(WidestBox + 1.0); // of the widest window
  std::uint64_t left = asked, bent = 0;
  for (std::size_t k = 0; k < this->Maps.maps.size() && this->Maps.automaticBias && left != 0; ++k)
  {
    const TracedMap& map = *this->Maps.maps[k];
    MapPlaces places;
    placeInMap(map, patch, left, places);
    bent |= left & ~(places.inside | places.outside);
    left &= places.outside;
    if (map.seesCasters && places.inside != 0 &&
      this->answer(map, places, map.around(places, Beyond), error, 2.0 * Beyond + 1.0) ==
        TileAnswer::Unknown)
    {
      bent |= places.inside & ~this->flat(map, places, extents);
    }
  }
  eachBit(bent,
    [&](int i)
    {
      MapPlace place;
      if (this->Maps.lookUp(patch.position(i), place))
      {
        const double width = boxWidth(place, extents[i]);
        if (!this->isFlat(place, width))
        {
          darkness[i] = this->filtered(place, width, patch.point(i), error);
        }
      }
    });
}

std::uint64_t MapTest::flat(const TracedMap& map, const MapPlaces& places, const double* extents)
{
  // Wider windows are looked at one by one.
  const double narrowest =
    0.999 * std::min(map.edge(places.t0 + places.lowT), map.edge(places.t0 + places.highT));
  std::uint64_t narrow = 0;
  eachBit(places.sure, [&](int i) { narrow |= std::uint64_t(extents[i] < narrowest) << i; });
  return !map.occluders.known() || narrow == 0 ? 0 : flatWindows(map, map.texels(), places, narrow);
}
}
