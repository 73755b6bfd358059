// Points against a shadow buffer, one by one and by tiles.
#include "svoShadowBuffer.h"

#include "svoShadowTest.h"
#include "svoTexelPlace.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace svo
{
bool ShadowBuffer::shadows(const SurfacePoint& point, double error) const
{
  Place place;
  return this->lookUp(point.position, place) && this->shadows(place, point, error);
}

bool ShadowBuffer::shadows(const Place& place, const SurfacePoint& point, double error) const
{
  const Answer answer = this->ask(place, place.nearest(), point, error);
  if (answer != Answer::DarkNearby)
  {
    return answer == Answer::Dark;
  }
  return this->agreed(place, point, error);
}

std::uint64_t ShadowBuffer::shadows(const TilePatch& patch, double error, std::uint64_t asked) const
{
  assert((asked & ~patch.mask) == 0);
  std::uint64_t left = asked, dark = 0, single = this->AutomaticBias ? 0 : asked;
  for (std::size_t i = 0; i < this->Faces.size() && this->AutomaticBias && left != 0; ++i)
  {
    const Face& face = *this->Faces[i];
    MapPlaces places;
    placeInMap(face.view, face.worldToClip, patch, left, places);
    single |= left & ~(places.sure | places.outside);
    left &= places.outside;
    if (face.seesCasters && places.sure != 0)
    {
      dark |= this->test(face, patch, places, error, single);
    }
  }
  eachBit(single, [&](int i) { dark |= std::uint64_t(this->shadows(patch.point(i), error)) << i; });
  return dark;
}

std::uint64_t ShadowBuffer::occluders(const Face& face, const MapPlaces& places,
  std::uint32_t theirs, double error, TexelTests& tests) const
{
  const auto biasOf = [&](std::uint32_t caster)
  { return static_cast<float>(this->Bias * this->CasterVoxel[caster]); };
  const auto errorOf = [&](std::uint32_t caster)
  { return static_cast<float>(std::max(this->CasterError[caster], error)); };
  TexelOccluders occluders;
  std::uint64_t found = 0, same = 0;
  if (theirs != TileOccluders::Several)
  {
    lookUpDepths(face.texels(), places, occluders);
    found = same = places.sure;
  }
  else if (face.occluders.known())
  {
    found = lookUpTexels(face.texels(), places, occluders, same);
    theirs = found != 0 ? occluders.caster[__builtin_ctzll(found)] : NoInstance;
  }
  if (found != 0 && found == same)
  {
    setOccluders(face.layers.hits().base(theirs) - places.t0, occluders, tests);
    std::fill_n(tests.bias, TilePatch::Most, biasOf(theirs));
    std::fill_n(tests.error, TilePatch::Most, errorOf(theirs));
    return found;
  }
  std::uint64_t something = 0;
  eachBit(face.occluders.known() ? found : places.sure,
    [&](int i)
    {
      std::uint32_t caster;
      double occluder;
      if (face.occluder(
            face.layers.hits().depth.at(places.column(i), places.row(i)), caster, occluder))
      {
        something |= std::uint64_t(1) << i;
        tests.occluder[i] = static_cast<float>(occluder - places.t0);
        tests.bias[i] = biasOf(caster);
        tests.error[i] = errorOf(caster);
      }
    });
  return something;
}

ShadowBuffer::TileAnswer ShadowBuffer::answer(const Face& face, const MapPlaces& places,
  const TileOccluders& around, double error, double span) const
{
  // A thousandth is more than the rounding of these sums.
  const double nearest = places.t0 + places.lowT, farthest = places.t0 + places.highT;
  const double edge = 1.001 * span * face.edge(farthest);
  const double reach = NearbyReach * edge;
  const double slack = 1e-5 *
    (std::abs(farthest) + std::abs(places.highT) + std::abs(nearest) + std::abs(places.lowT));
  if (around.caster == NoInstance ||
    (this->Bias >= 0.0 && around.nearest > farthest + reach + slack))
  {
    return TileAnswer::Lit;
  }
  const double allowed = this->Bias * this->LargestVoxel +
    (TexelBend * edge + std::max(this->LargestError, error)) / LeastSteepness;
  const double followed = std::max(NearbyReach, GrazingReach * face.edge.aspect) * edge;
  return this->Bias >= 0.0 && nearest - followed - 1.001 * allowed - slack > around.farthest
    ? TileAnswer::Dark
    : TileAnswer::Unknown;
}

std::uint64_t ShadowBuffer::test(const Face& face, const TilePatch& patch, const MapPlaces& places,
  double error, std::uint64_t& single) const
{
  const TileOccluders around = face.around(places, 0.0f);
  const TileAnswer answer = this->answer(face, places, around, error);
  if (answer != TileAnswer::Unknown)
  {
    return answer == TileAnswer::Dark ? places.sure : 0;
  }
  TexelTests tests;
  const std::uint64_t something = this->occluders(face, places, around.caster, error, tests);
  if (something == 0)
  {
    return 0;
  }
  testTexels(face.view, face.edge, patch, something, places, tests);
  single |= tests.unsure;
  std::uint64_t dark = tests.dark;
  eachBit(tests.nearby,
    [&](int i)
    {
      Place place;
      const SurfacePoint point = patch.point(i);
      const bool agreed = this->lookUp(point.position, place) && this->agreed(place, point, error);
      dark |= std::uint64_t(agreed) << i;
    });
  return dark;
}

bool ShadowBuffer::agreed(const Place& place, const SurfacePoint& point, double error) const
{
  int dark = 0;
  for (int i = 1; i < 4; ++i)
  {
    dark += this->ask(place, place.neighbour(i), point, error) != Answer::Lit;
  }
  return dark >= TexelsToAgree;
}

ShadowBuffer::Answer ShadowBuffer::ask(const Place& place, const glm::ivec2& texel,
  const SurfacePoint& point, double error, double span) const
{
  const Face* face = place.face;
  assert(face && span >= 1.0);
  const double t = place.t;
  if (texel.x < 0 || texel.y < 0 || texel.x >= face->view.width || texel.y >= face->view.height)
  {
    return Answer::Lit;
  }
  std::uint32_t caster;
  double occluder;
  if (!face->occluder(face->layers.hits().depth.at(texel.x, texel.y), caster, occluder))
  {
    return Answer::Lit;
  }
  const double bias = this->Bias * this->CasterVoxel[caster];
  if (!this->AutomaticBias)
  {
    return occluder + bias < t ? Answer::Dark : Answer::Lit;
  }
  const double edge = span * face->edge(t);
  if (!(reachedBy(t, edge, occluder, bias) > 0.0))
  {
    return Answer::Lit;
  }
  const double x = texel.x + 0.5, y = texel.y + 0.5;
  const ShadowAnswer<double> answer =
    shadowTest<double>({ glm::dvec3(point.facet), glm::dvec3(point.normal),
      point.position - face->view.rayOrigin(x, y), face->view.rayDirection(x, y), t, edge,
      face->edge.aspect, occluder, bias, std::max(this->CasterError[caster], error) });
  return static_cast<Answer>(answer.dark());
}

ShadowBuffer::MapAnswer ShadowBuffer::ask(
  const SurfacePoint& point, double error, const double* extent) const
{
  Place place;
  if (!this->lookUp(point.position, place))
  {
    return { true, 0.0f, 0.0 };
  }
  MapAnswer said{ isTraced(place), 0.0f, place.face->edge(place.t) };
  if (said.known)
  {
    said.darkness = extent                 ? this->darkness(point, error, *extent)
      : this->shadows(place, point, error) ? 1.0f
                                           : 0.0f;
  }
  return said;
}
}
