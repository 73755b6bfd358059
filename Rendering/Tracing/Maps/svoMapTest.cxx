#include "svoMapTest.h"

#include "svoShadowTest.h"
#include "svoTexelPlace.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace svo
{
bool MapTest::shadows(const SurfacePoint& point, double error) const
{
  MapPlace place;
  return this->Maps.lookUp(point.position, place) && this->shadows(place, point, error);
}

bool MapTest::shadows(const MapPlace& place, const SurfacePoint& point, double error) const
{
  const Answer answer = this->ask(place, place.nearest(), point, error);
  return answer == Answer::Dark ||
    (answer == Answer::DarkNearby && this->agreed(place, point, error));
}

std::uint64_t MapTest::shadows(const TilePatch& patch, double error, std::uint64_t asked) const
{
  assert((asked & ~patch.mask) == 0);
  std::uint64_t left = asked, dark = 0, single = this->Maps.automaticBias ? 0 : asked;
  for (std::size_t i = 0; i < this->Maps.maps.size() && this->Maps.automaticBias && left != 0; ++i)
  {
    const TracedMap& map = *this->Maps.maps[i];
    MapPlaces places;
    placeInMap(map, patch, left, places);
    single |= left & ~(places.sure | places.outside);
    left &= places.outside;
    if (map.seesCasters && places.sure != 0)
    {
      dark |= this->test(map, patch, places, error, single);
    }
  }
  eachBit(single, [&](int i) { dark |= std::uint64_t(this->shadows(patch.point(i), error)) << i; });
  return dark;
}

std::uint64_t MapTest::occluders(const TracedMap& map, const MapPlaces& places,
  std::uint32_t theirs, double error, TexelTests& tests) const
{
  const auto biasOf = [&](std::uint32_t caster)
  { return static_cast<float>(this->Maps.bias * map.casterVoxel[caster]); };
  const auto errorOf = [&](std::uint32_t caster)
  { return static_cast<float>(std::max(map.casterError[caster], error)); };
  TexelOccluders occluders;
  std::uint64_t found = 0, same = 0;
  if (theirs != TileOccluders::Several)
  {
    lookUpDepths(map.texels(), places, occluders);
    found = same = places.sure;
  }
  else if (map.occluders.known())
  {
    found = lookUpTexels(map.texels(), places, occluders, same);
    theirs = found != 0 ? occluders.caster[__builtin_ctzll(found)] : NoInstance;
  }
  if (found != 0 && found == same)
  {
    setOccluders(map.hits.base(theirs) - places.t0, occluders, tests);
    std::fill_n(tests.bias, TilePatch::Most, biasOf(theirs));
    std::fill_n(tests.error, TilePatch::Most, errorOf(theirs));
    return found;
  }
  std::uint64_t something = 0;
  eachBit(map.occluders.known() ? found : places.sure,
    [&](int i)
    {
      std::uint32_t caster;
      double occluder;
      if (map.occluder({ places.column(i), places.row(i) }, caster, occluder))
      {
        something |= std::uint64_t(1) << i;
        tests.occluder[i] = static_cast<float>(occluder - places.t0);
        tests.bias[i] = biasOf(caster);
        tests.error[i] = errorOf(caster);
      }
    });
  return something;
}

MapTest::TileAnswer MapTest::answer(const TracedMap& map, const MapPlaces& places,
  const TileOccluders& around, double error, double span) const
{
  // A thousandth is more than the rounding of these sums.
  const double nearest = places.t0 + places.lowT, farthest = places.t0 + places.highT;
  const double edge = 1.001 * span * map.edge(farthest);
  const double reach = NearbyReach * edge;
  const double slack = 1e-5 *
    (std::abs(farthest) + std::abs(places.highT) + std::abs(nearest) + std::abs(places.lowT));
  if (around.caster == NoInstance ||
    (this->Maps.bias >= 0.0 && around.nearest > farthest + reach + slack))
  {
    return TileAnswer::Lit;
  }
  const double allowed = this->Maps.bias * map.largestVoxel +
    (TexelBend * edge + std::max(map.largestError, error)) / LeastSteepness;
  const double followed = std::max(NearbyReach, GrazingReach * map.edge.aspect) * edge;
  return this->Maps.bias >= 0.0 && nearest - followed - 1.001 * allowed - slack > around.farthest
    ? TileAnswer::Dark
    : TileAnswer::Unknown;
}

std::uint64_t MapTest::test(const TracedMap& map, const TilePatch& patch, const MapPlaces& places,
  double error, std::uint64_t& single) const
{
  const TileOccluders around = map.around(places, 0.0f);
  const TileAnswer answer = this->answer(map, places, around, error);
  if (answer != TileAnswer::Unknown)
  {
    return answer == TileAnswer::Dark ? places.sure : 0;
  }
  TexelTests tests;
  const std::uint64_t something = this->occluders(map, places, around.caster, error, tests);
  if (something == 0)
  {
    return 0;
  }
  testTexels(map, patch, something, places, tests);
  single |= tests.unsure;
  std::uint64_t dark = tests.dark;
  eachBit(tests.nearby,
    [&](int i)
    {
      MapPlace place;
      const SurfacePoint point = patch.point(i);
      const bool agreed =
        this->Maps.lookUp(point.position, place) && this->agreed(place, point, error);
      dark |= std::uint64_t(agreed) << i;
    });
  return dark;
}

bool MapTest::agreed(const MapPlace& place, const SurfacePoint& point, double error) const
{
  int dark = 0;
  for (int i = 1; i < 4; ++i)
  {
    dark += this->ask(place, place.neighbour(i), point, error) != Answer::Lit;
  }
  return dark >= TexelsToAgree;
}

MapTest::Answer MapTest::ask(const MapPlace& place, const glm::ivec2& texel,
  const SurfacePoint& point, double error, double span) const
{
  assert(place.map && span >= 1.0);
  const TracedMap& map = *place.map;
  const double t = place.t;
  std::uint32_t caster;
  double occluder;
  if (!map.has(texel) || !map.occluder(texel, caster, occluder))
  {
    return Answer::Lit;
  }
  const double bias = this->Maps.bias * map.casterVoxel[caster];
  if (!this->Maps.automaticBias)
  {
    return occluder + bias < t ? Answer::Dark : Answer::Lit;
  }
  const double edge = span * map.edge(t);
  if (!(reachedBy(t, edge, occluder, bias) > 0.0))
  {
    return Answer::Lit;
  }
  const double x = texel.x + 0.5, y = texel.y + 0.5;
  const ShadowAnswer<double> answer =
    shadowTest<double>({ glm::dvec3(point.facet), glm::dvec3(point.normal),
      point.position - map.view.rayOrigin(x, y), map.view.rayDirection(x, y), t, edge,
      map.edge.aspect, occluder, bias, std::max(map.casterError[caster], error) });
  return static_cast<Answer>(answer.shadowed());
}
}
