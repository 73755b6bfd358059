#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTileShadows.cxx"
#include <hwy/foreach_target.h>

#include "svoTileShadows.h"

#include "svoShadowTest.h"
#include "svoTerminator.h"
#include "svoTexelPlace.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
constexpr int Step = TilePoints::Step;

void lookUp(const View& light, const glm::dmat4& worldToClip, const TilePoints& p, int first,
  int last, TexelPlaces& places)
{
  const View map = light;
  const glm::dmat4 toClip = worldToClip;
  for (int i = first; i < last; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      const TexelPlace place = texelPlace(map, toClip, p.position(k));
      places.x[k - first] = place.x;
      places.y[k - first] = place.y;
      places.t[k - first] = place.t;
      places.inside[k - first] = place.inside;
    }
  }
}

/// In single precision, with a margin that is more than its rounding. `far`: the light shines the
/// way `along`, from no place in particular.
int turn(const glm::dvec3& from, const glm::vec3& along, bool far, float sine, float sineIfDark,
  const TilePoints& p, int first, int last, const std::uint8_t* asked, const std::uint8_t* dark,
  std::uint8_t* turned)
{
  alignas(64) float x[TilePoints::Room], y[TilePoints::Room], z[TilePoints::Room];
  const int n = last - first;
  if (far)
  {
    std::fill_n(x, n + Step, along.x);
    std::fill_n(y, n + Step, along.y);
    std::fill_n(z, n + Step, along.z);
  }
  else
  {
    for (int k = 0; k < (n + Step - 1) / Step * Step; ++k)
    {
      x[k] = static_cast<float>(p.positionX[first + k] - from.x);
      y[k] = static_cast<float>(p.positionY[first + k] - from.y);
      z[k] = static_cast<float>(p.positionZ[first + k] - from.z);
    }
  }
  const float sine2 = sine * sine, sineIfDark2 = sineIfDark * sineIfDark;
  alignas(64) std::uint32_t turns[TilePoints::Room];
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      const float behind =
        p.facetX[first + k] * x[k] + p.facetY[first + k] * y[k] + p.facetZ[first + k] * z[k];
      const float length2 = x[k] * x[k] + y[k] * y[k] + z[k] * z[k];
      const float behind2 = behind * behind;
      const std::uint32_t faces = behind2 > sine2 * length2 ? 1u : 0u;
      const std::uint32_t facesIfDark = behind2 > sineIfDark2 * length2 ? 1u : 0u;
      // What is not a number turns away.
      turns[k] = behind <= 0.0f ? (1u - faces) * 2u + (1u - facesIfDark) : 2u;
    }
  }
  int any = 0;
  for (int k = 0; k < n; ++k)
  {
    turned[k] = asked[k] && turns[k] + dark[k] > 1u;
    any |= turned[k];
  }
  return any;
}

void test(const View& light, const TexelEdge& edges, const TilePoints& p, int first, int last,
  const TexelPlaces& places, TexelTests& tests)
{
  const View map = light;
  const TexelEdge edge = edges;
  for (int i = first; i < last; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      const int j = k - first;
      tests.dark[j] = shadowTest(map, edge,
        { p.position(k), glm::dvec3(p.facet(k)), glm::dvec3(p.normal(k)), places.t[j], tests.x[j],
          tests.y[j], 1.0, tests.occluder[j], tests.bias[j], tests.error[j] });
    }
  }
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(lookUp);
HWY_EXPORT(turn);
HWY_EXPORT(test);

void lookUpTexels(const View& light, const glm::dmat4& worldToClip, const TilePoints& points,
  int first, int last, TexelPlaces& places)
{
  assert(first >= 0 && first < last && last <= points.count);
  HWY_DYNAMIC_DISPATCH(lookUp)(light, worldToClip, points, first, last, places);
}

bool mayTurnAway(const Light& light, double grazing, const TilePoints& points, int first, int last,
  const std::uint8_t* asked, const std::uint8_t* dark, std::uint8_t* turned)
{
  assert(first >= 0 && first < last && last <= points.count);
  constexpr double Margin = 1e-4;
  return HWY_DYNAMIC_DISPATCH(turn)(light.position, glm::vec3(light.direction), light.atInfinity(),
           static_cast<float>(grazing + Margin), static_cast<float>(DoubtfulSine + Margin), points,
           first, last, asked, dark, turned) != 0;
}

void testTexels(const View& light, const TexelEdge& edge, const TilePoints& points, int first,
  int last, const TexelPlaces& places, TexelTests& tests)
{
  assert(first >= 0 && first < last && last <= points.count && edge.aspect >= 1.0);
  HWY_DYNAMIC_DISPATCH(test)(light, edge, points, first, last, places, tests);
}
}
#endif
