#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTileShadows.cxx"
#include <hwy/foreach_target.h>

#include "svoTileShadows.h"

#include "svoShadowRules.h"
#include "svoShadowTest.h"
#include "svoTerminator.h"

#include <algorithm>
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
  const glm::dmat4 c = worldToClip, m = light.worldToView;
  const double width = light.width, height = light.height;
  const double lastX = width - 1e-9, lastY = height - 1e-9;
  for (int i = first; i < last; i += Step)
  {
    for (int k = 0; k < Step; ++k)
    {
      const double x = p.positionX[i + k], y = p.positionY[i + k], z = p.positionZ[i + k];
      const double cx = (c[0].x * x + c[1].x * y) + (c[2].x * z + c[3].x * 1.0);
      const double cy = (c[0].y * x + c[1].y * y) + (c[2].y * z + c[3].y * 1.0);
      const double cw = (c[0].w * x + c[1].w * y) + (c[2].w * z + c[3].w * 1.0);
      const int j = i - first + k;
      const double border = MapBorder * cw;
      const double insideX = std::abs(cx) < border ? 1.0 : 0.0;
      const double insideY = std::abs(cy) < border ? insideX : 0.0;
      places.inside[j] = cw > 0.0 ? insideY : 0.0;
      const double px = (cx / cw + 1.0) * 0.5 * width;
      const double py = (cy / cw + 1.0) * 0.5 * height;
      const double x0 = px < 0.0 ? 0.0 : px;
      const double y0 = py < 0.0 ? 0.0 : py;
      places.x[j] = lastX < x0 ? lastX : x0;
      places.y[j] = lastY < y0 ? lastY : y0;
      places.t[j] = -(m[0].z * x + m[1].z * y + m[2].z * z + m[3].z);
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

void test(const View& light, const TexelEdge& edge, const TilePoints& p, int first, int last,
  const TexelPlaces& places, TexelTests& tests)
{
  const double pixel0 = edge.constant, pixelPerDepth = edge.perDepth, aspect = edge.aspect;
  const glm::dvec3 o = light.origin, oX = light.originX, oY = light.originY;
  const glm::dvec3 d = light.direction, dX = light.directionX, dY = light.directionY;
  for (int i = first; i < last; i += Step)
  {
    for (int k = 0; k < Step; ++k)
    {
      const int j = i - first + k;
      const double x = tests.x[j], y = tests.y[j];
      ShadowQuestion q;
      q.t = places.t[j];
      q.edge = pixel0 + q.t * pixelPerDepth;
      q.aspect = aspect;
      q.occluder = tests.occluder[j];
      q.bias = tests.bias[j];
      q.to = { p.positionX[i + k] - (o.x + x * oX.x + y * oY.x),
        p.positionY[i + k] - (o.y + x * oX.y + y * oY.y),
        p.positionZ[i + k] - (o.z + x * oX.z + y * oY.z) };
      q.ray = { d.x + x * dX.x + y * dY.x, d.y + x * dX.y + y * dY.y, d.z + x * dX.z + y * dY.z };
      q.facet = { p.facetX[i + k], p.facetY[i + k], p.facetZ[i + k] };
      q.normal = { p.normalX[i + k], p.normalY[i + k], p.normalZ[i + k] };
      q.error = tests.error[j];
      tests.dark[j] = shadowTest(q);
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
  HWY_DYNAMIC_DISPATCH(lookUp)(light, worldToClip, points, first, last, places);
}

bool mayTurnAway(const Light& light, double grazing, const TilePoints& points, int first, int last,
  const std::uint8_t* asked, const std::uint8_t* dark, std::uint8_t* turned)
{
  constexpr double Margin = 1e-4;
  return HWY_DYNAMIC_DISPATCH(turn)(light.position, glm::vec3(light.direction), light.atInfinity(),
           static_cast<float>(grazing + Margin), static_cast<float>(DoubtfulSine + Margin), points,
           first, last, asked, dark, turned) != 0;
}

void testTexels(const View& light, const TexelEdge& edge, const TilePoints& points, int first,
  int last, const TexelPlaces& places, TexelTests& tests)
{
  HWY_DYNAMIC_DISPATCH(test)(light, edge, points, first, last, places, tests);
}
}
#endif
