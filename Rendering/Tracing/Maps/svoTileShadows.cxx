#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTileShadows.cxx"
#include <hwy/foreach_target.h>

#include "svoTileShadows.h"

#include "svoLaneBits-inl.h"
#include "svoShadowTest.h"
#include "svoTerminator.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <hwy/highway.h>

#ifndef SVO_TILE_SHADOWS_ONCE
#define SVO_TILE_SHADOWS_ONCE
namespace svo
{
// How far off what shadowTest() compares is, with u = 2^-24. Let M be the sum of the sizes of what
// is added up to the way from a texel's ray to a point, H the largest depth that a plane is
// followed to, counted from the origin's, and s the sine of the light's angle to the plane.
// - The way: 12 u M (the patch's 8 u, the coefficients, products and sums). Its product with a unit
//   normal: 15 u M. That of the ray: its coefficients, products and sums 4 u, the product 3 u, of
//   its components' sum, which is at most sqrt(3) times its length: 13 u. So s is off by 16 u.
// - Where the ray meets the plane, a quotient: (15 M + 13 H) u / s and its rounding. (Where it is
//   farther than H the plane is not followed, and the error of that is less than what is beyond.)
//   How far planes are followed: H (16 / s + 3) u. Depths: 13 u H. Together less than 64 u (M + H)
//   / s.
// - What is allowed for is divided by s or 0.1, whichever is more: 16 u / 0.1 of it, and less than
//   16 u for the rest.
// - The occluder: rounded once, and once each in three sums.
constexpr float OfPlanes = 64.0f * FloatRounding;
constexpr float OfAllowed = 256.0f * FloatRounding;
constexpr float OfOccluder = 8.0f * FloatRounding;
constexpr float OfSlope = 32.0f * FloatRounding;

/// A map's texels as the points of a patch see them, by texels from x0, y0.
struct TexelsFromPatch
{
  glm::vec3 start, startX, startY; // from the patch's origin, where a texel's ray has depth t0
  glm::vec3 ray, rayX, rayY;       // linear depth grows by 1
  float edge, edgePerDepth, aspect;
  float doubt; // what the answers are off by where the slope is 1, but for the occluder
};
}
#endif

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
constexpr int Step = TilePatch::Step;

void addInDouble(double base, const float* HWY_RESTRICT t, float* HWY_RESTRICT occluders)
{
  for (int k = 0; k < TilePatch::Most; ++k)
  {
    occluders[k] = static_cast<float>(base + static_cast<double>(t[k]));
  }
}

void test(const TexelsFromPatch& of, const TilePatch& p, std::uint64_t lanes,
  const MapPlaces& places, TexelTests& tests)
{
  const TexelsFromPatch map = of;
  tests.dark = tests.nearby = tests.unsure = 0;
  for (int i = 0; i < TilePatch::Most; i += Step)
  {
    if ((lanes >> i & ((1u << Step) - 1)) == 0)
    {
      continue;
    }
    alignas(64) std::uint32_t answers[Step];
    for (int k = 0; k < Step; ++k)
    {
      const float x = places.centreX[i + k], y = places.centreY[i + k], t = places.t[i + k];
      const float occluder = tests.occluder[i + k];
      const ShadowAnswer<float> answer = shadowTest<float>({ p.facet(i + k), p.normal(i + k),
        p.way(i + k) - (map.start + x * map.startX + y * map.startY),
        map.ray + x * map.rayX + y * map.rayY, t, map.edge + t * map.edgePerDepth, map.aspect,
        occluder, tests.bias[i + k], tests.error[i + k] });
      const float flattest = static_cast<float>(EdgeOnSine);
      const float slope = answer.slope < flattest ? flattest : answer.slope;
      const float doubt =
        map.doubt / slope + OfAllowed * answer.allowed + OfOccluder * std::abs(occluder);
      const bool lit = (answer.reached < -doubt) | (answer.behind < -doubt);
      const bool dark =
        (answer.reached > doubt) & (answer.behind > doubt) & (std::abs(answer.farBefore) > doubt);
      const std::uint32_t which = answer.farBefore > 0.0f ? 2u : 1u;
      const std::uint32_t sure = lit ? 0u : which;
      answers[k] = (lit | dark) & (answer.edgeOn > OfSlope) ? sure : 3u;
    }
    tests.nearby |= lanesOf(answers, 1, Step) << i;
    tests.dark |= lanesOf(answers, 2, Step) << i;
    tests.unsure |= lanesOf(answers, 3, Step) << i;
  }
  tests.nearby &= lanes;
  tests.dark &= lanes;
  tests.unsure &= lanes;
}

/// With a margin that is more than its rounding. `from`: the patch's origin, from the light; `far`:
/// the light shines the way `from`, from no place in particular.
std::uint64_t turn(const glm::vec3& way, bool far, float sine, float sineIfDark, const TilePatch& p,
  std::uint64_t asked, std::uint64_t dark)
{
  const glm::vec3 from = way;
  const float moves = far ? 0.0f : 1.0f;
  const float sine2 = sine * sine, sineIfDark2 = sineIfDark * sineIfDark;
  std::uint64_t always = 0, ifDark = 0;
  for (int i = 0; i < TilePatch::Most; i += Step)
  {
    if ((asked >> i & ((1u << Step) - 1)) == 0)
    {
      continue;
    }
    alignas(64) std::int32_t turns[Step];
    for (int k = 0; k < Step; ++k)
    {
      const glm::vec3 along = from + moves * p.way(i + k);
      const float behind = glm::dot(p.facet(i + k), along);
      const float length2 = glm::dot(along, along), behind2 = behind * behind;
      const std::int32_t flat = behind2 > sine2 * length2 ? 0 : 2;
      const std::int32_t flatIfDark = behind2 > sineIfDark2 * length2 ? 0 : 1;
      // What is not a number turns away.
      turns[k] = behind <= 0.0f ? flat + flatIfDark : 3;
    }
    const Integers integers;
    for (int k = 0; k < Step; k += width())
    {
      const auto turned = hn::Load(integers, turns + k);
      always |= bitsOf(integers, hn::Gt(turned, hn::Set(integers, 1))) << (i + k);
      ifDark |= bitsOf(integers, hn::Gt(turned, hn::Zero(integers))) << (i + k);
    }
  }
  return asked & (always | (ifDark & dark));
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(addInDouble);
HWY_EXPORT(turn);
HWY_EXPORT(test);

void setOccluders(double base, const TexelOccluders& occluders, TexelTests& tests)
{
  HWY_DYNAMIC_DISPATCH(addInDouble)(base, occluders.t, tests.occluder);
}

std::uint64_t mayTurnAway(const Light& light, double grazing, const TilePatch& patch,
  std::uint64_t asked, std::uint64_t dark)
{
  constexpr double Margin = 1e-4;
  const bool far = light.atInfinity();
  const glm::vec3 from(far ? light.direction : patch.origin.position - light.position);
  return HWY_DYNAMIC_DISPATCH(turn)(from, far, static_cast<float>(grazing + Margin),
    static_cast<float>(DoubtfulSine + Margin), patch, asked, dark);
}

void testTexels(const MapGeometry& geometry, const TilePatch& patch, std::uint64_t lanes,
  const MapPlaces& places, TexelTests& tests)
{
  const View& view = geometry.view;
  const TexelEdge& edge = geometry.edge;
  assert((lanes & ~places.sure) == 0 && edge.aspect >= 1.0);
  const double x = places.x0, y = places.y0, t = places.t0;
  const glm::dvec3 ray = view.rayDirection(x, y);
  TexelsFromPatch map{ glm::vec3(view.rayOrigin(x, y) + t * ray - patch.origin.position),
    glm::vec3(view.originX + t * view.directionX), glm::vec3(view.originY + t * view.directionY),
    glm::vec3(ray), glm::vec3(view.directionX), glm::vec3(view.directionY),
    static_cast<float>(edge(t)), static_cast<float>(edge.perDepth), static_cast<float>(edge.aspect),
    0.0f };
  const auto sizeOf = [](const glm::vec3& v)
  { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
  const float wide = 1.0f +
    std::max({ std::abs(places.lowX), std::abs(places.highX), std::abs(places.lowY),
      std::abs(places.highY) });
  const float deep = std::max(std::abs(places.lowT), std::abs(places.highT));
  const float way =
    sizeOf(patch.extent) + sizeOf(map.start) + wide * (sizeOf(map.startX) + sizeOf(map.startY));
  const float reach = static_cast<float>(NearbyReach + GrazingReach * edge.aspect) *
    (map.edge + deep * map.edgePerDepth);
  map.doubt = OfPlanes * (way + deep + reach);
  HWY_DYNAMIC_DISPATCH(test)(map, patch, lanes, places, tests);
}
}
#endif
