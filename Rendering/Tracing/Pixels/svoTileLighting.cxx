#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTileLighting.cxx"
#include <hwy/foreach_target.h>

#include "svoTileLighting.h"

#include "svoLightingLane.h"

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

void begin(const glm::mat3& rotation, const glm::dmat4& worldToView, const TilePoints& p, int first,
  int last, TileLight& l)
{
  const glm::mat3 turn = rotation;
  const glm::dmat4 toView = worldToView;
  for (int i = first; i < last; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      const glm::vec3 normal = turn * p.normal(k);
      l.normalX[k - first] = normal.x;
      l.normalY[k - first] = normal.y;
      l.normalZ[k - first] = normal.z;
    }
    for (int k = i; k < i + Step; ++k)
    {
      const glm::vec3 position(toView * glm::dvec4(p.position(k), 1.0));
      l.positionX[k - first] = position.x;
      l.positionY[k - first] = position.y;
      l.positionZ[k - first] = position.z;
    }
  }
  const int n = last - first;
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      l.diffuseR[k] = l.diffuseG[k] = l.diffuseB[k] = 0.0f;
      l.specularR[k] = l.specularG[k] = l.specularB[k] = 0.0f;
    }
  }
}

/// The one light is a headlight.
void arriveFromEye(int n, TileLight& l)
{
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      l.diffuse[k] = positiveLane(l.normalZ[k]);
      l.base[k] = l.diffuse[k];
    }
  }
}

/// Directions of the light that arrives and attenuation without the cone's; then the rest of it.
void arriveFromPosition(const ViewLight& from, int n, float* dx, float* dy, float* dz,
  float* attenuation, const TileLight& l)
{
  const glm::vec3 at = from.position, axis = from.direction, constants = from.light->attenuation;
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      const ArrivingLane light =
        arriveLane({ l.positionX[k], l.positionY[k], l.positionZ[k] }, at, axis, constants);
      dx[k] = light.direction.x;
      dy[k] = light.direction.y;
      dz[k] = light.direction.z;
      attenuation[k] = light.attenuation;
    }
  }
}

/// Cosines to the axis of a cone.
void towardsAxis(
  const ViewLight& from, int n, const float* dx, const float* dy, const float* dz, float* cosine)
{
  const glm::vec3 axis = from.direction;
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      cosine[k] = glm::dot(glm::vec3(dx[k], dy[k], dz[k]), axis);
    }
  }
}

void arriveAtSurface(int n, bool shines, const float* dx, const float* dy, const float* dz,
  const float* attenuation, TileLight& l)
{
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      l.diffuse[k] = diffuseLane(
        attenuation[k], { l.normalX[k], l.normalY[k], l.normalZ[k] }, { dx[k], dy[k], dz[k] });
    }
  }
  for (int i = 0; shines && i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      l.base[k] = highlightLane({ l.positionX[k], l.positionY[k], l.positionZ[k] },
        { l.normalX[k], l.normalY[k], l.normalZ[k] }, { dx[k], dy[k], dz[k] });
    }
  }
}

void shine(int n, float power, const float* base, TileLight& l)
{
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      l.specular[k] = powLane(base[k], power);
    }
  }
}

void shineAttenuated(int n, float power, const float* attenuation, TileLight& l)
{
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      const float shone = attenuation[k] * powLane(l.base[k], power);
      l.specular[k] = l.diffuse[k] > 0.0f ? shone : 0.0f;
    }
  }
}

void reach(int n, TileLight& l)
{
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      l.reached[k] = (l.diffuse[k] != 0.0f) | (l.specular[k] > 0.0f);
    }
  }
}

void add(const glm::vec3& c, float remaining, int n, TileLight& l)
{
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      const float share = l.dark[k] ? remaining : 1.0f;
      l.diffuseR[k] += share * (l.diffuse[k] * c.r);
      l.diffuseG[k] += share * (l.diffuse[k] * c.g);
      l.diffuseB[k] += share * (l.diffuse[k] * c.b);
      const float specular = share * l.specular[k];
      l.specularR[k] += specular * c.r;
      l.specularG[k] += specular * c.g;
      l.specularB[k] += specular * c.b;
    }
  }
}

void addParts(const glm::vec3& c, int n, TileLight& l)
{
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      const float share = l.share[k];
      l.diffuseR[k] += share * (l.diffuse[k] * c.r);
      l.diffuseG[k] += share * (l.diffuse[k] * c.g);
      l.diffuseB[k] += share * (l.diffuse[k] * c.b);
      const float specular = share * l.specular[k];
      l.specularR[k] += specular * c.r;
      l.specularG[k] += specular * c.g;
      l.specularB[k] += specular * c.b;
    }
  }
}

/// a + d * diffuse + s * specular, of each point's own colour.
void finish(const Material& m, bool lit, int n, const float* r, const float* g, const float* b,
  const TileLight& l, float* HWY_RESTRICT outR, float* HWY_RESTRICT outG, float* HWY_RESTRICT outB)
{
  const glm::vec3 shine = m.specular * m.specularColor;
  const float ambient = m.ambient, diffuse = m.diffuse;
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      const float dr = diffuse * r[k], dg = diffuse * g[k], db = diffuse * b[k];
      const float ar = ambient * r[k], ag = ambient * g[k], ab = ambient * b[k];
      outR[k] = colorLane(lit, ar, l.diffuseR[k], dr, l.specularR[k], shine.r);
      outG[k] = colorLane(lit, ag, l.diffuseG[k], dg, l.specularG[k], shine.g);
      outB[k] = colorLane(lit, ab, l.diffuseB[k], db, l.specularB[k], shine.b);
    }
  }
}

/// The same with one colour for all.
void finishPlain(const glm::vec3& ambient, const glm::vec3& diffuse, const glm::vec3& shine,
  bool lit, int n, const TileLight& l, float* HWY_RESTRICT outR, float* HWY_RESTRICT outG,
  float* HWY_RESTRICT outB)
{
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      outR[k] = colorLane(lit, ambient.r, l.diffuseR[k], diffuse.r, l.specularR[k], shine.r);
      outG[k] = colorLane(lit, ambient.g, l.diffuseG[k], diffuse.g, l.specularG[k], shine.g);
      outB[k] = colorLane(lit, ambient.b, l.diffuseB[k], diffuse.b, l.specularB[k], shine.b);
    }
  }
}

void pack(const TileColors& c, int n, std::uint32_t* rgba)
{
  for (int i = 0; i < n; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      // toByte()
      const float r = c.r[k] > 0.0f ? (c.r[k] < 1.0f ? c.r[k] : 1.0f) : 0.0f;
      const float g = c.g[k] > 0.0f ? (c.g[k] < 1.0f ? c.g[k] : 1.0f) : 0.0f;
      const float b = c.b[k] > 0.0f ? (c.b[k] < 1.0f ? c.b[k] : 1.0f) : 0.0f;
      const auto red = static_cast<std::int32_t>(r * 255.0f + 0.5f);
      const auto green = static_cast<std::int32_t>(g * 255.0f + 0.5f);
      const auto blue = static_cast<std::int32_t>(b * 255.0f + 0.5f);
      rgba[k] = static_cast<std::uint32_t>(red | green << 8 | blue << 16) | 0xff000000u;
    }
  }
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(begin);
HWY_EXPORT(arriveFromEye);
HWY_EXPORT(arriveFromPosition);
HWY_EXPORT(towardsAxis);
HWY_EXPORT(arriveAtSurface);
HWY_EXPORT(shine);
HWY_EXPORT(shineAttenuated);
HWY_EXPORT(reach);
HWY_EXPORT(add);
HWY_EXPORT(addParts);
HWY_EXPORT(finish);
HWY_EXPORT(finishPlain);
HWY_EXPORT(pack);

void packColors(const TileColors& colors, int count, std::uint32_t* rgba)
{
  assert(count > 0 && count <= TilePoints::Most);
  HWY_DYNAMIC_DISPATCH(pack)(colors, count, rgba);
}

void toViewSpace(
  const Lighting& lighting, const TilePoints& points, int first, int last, TileLight& light)
{
  assert(first >= 0 && first < last && last <= points.count);
  HWY_DYNAMIC_DISPATCH(begin)
  (lighting.rotation, lighting.worldToView, points, first, last, light);
}

void arriveLight(
  const Lighting& lighting, std::size_t l, const Material& material, int count, TileLight& light)
{
  assert(l < lighting.lights.size() && count > 0 && count <= TilePoints::Most);
  const ViewLight& from = lighting.lights[l];
  const bool shines = material.specular > 0.0f;
  std::fill_n(light.specular, count + TilePoints::Step, 0.0f);
  if (lighting.onlyHeadlight)
  {
    HWY_DYNAMIC_DISPATCH(arriveFromEye)(count, light);
    if (shines)
    {
      HWY_DYNAMIC_DISPATCH(shine)(count, material.specularPower, light.base, light);
    }
  }
  else
  {
    alignas(64) float dx[TilePoints::Room], dy[TilePoints::Room], dz[TilePoints::Room];
    alignas(64) float attenuation[TilePoints::Room], cosine[TilePoints::Room];
    if (from.light->atInfinity())
    {
      std::fill_n(dx, count + TilePoints::Step, from.direction.x);
      std::fill_n(dy, count + TilePoints::Step, from.direction.y);
      std::fill_n(dz, count + TilePoints::Step, from.direction.z);
      std::fill_n(attenuation, count + TilePoints::Step, 1.0f);
    }
    else
    {
      HWY_DYNAMIC_DISPATCH(arriveFromPosition)(from, count, dx, dy, dz, attenuation, light);
    }
    if (from.light->hasCone())
    {
      HWY_DYNAMIC_DISPATCH(towardsAxis)(from, count, dx, dy, dz, cosine);
      for (int i = 0; i < count; ++i)
      {
        attenuation[i] *= coneLane(*from.light, from.coneCosine, cosine[i]);
      }
    }
    HWY_DYNAMIC_DISPATCH(arriveAtSurface)(count, shines, dx, dy, dz, attenuation, light);
    if (shines)
    {
      HWY_DYNAMIC_DISPATCH(shineAttenuated)(count, material.specularPower, attenuation, light);
    }
  }
  HWY_DYNAMIC_DISPATCH(reach)(count, light);
}

void addLight(const ViewLight& from, float remaining, int count, TileLight& light)
{
  HWY_DYNAMIC_DISPATCH(add)(from.light->color, remaining, count, light);
}

void addShares(const ViewLight& from, int count, TileLight& light)
{
  HWY_DYNAMIC_DISPATCH(addParts)(from.light->color, count, light);
}

void finishLight(const Lighting& lighting, const Material& material, const TilePoints& points,
  int first, int last, bool hasColor, const TileLight& light, TileColors& colors)
{
  assert(first >= 0 && first < last && last <= points.count);
  const bool lit = material.lighting && !lighting.lights.empty();
  if (hasColor)
  {
    HWY_DYNAMIC_DISPATCH(finish)
    (material, lit, last - first, points.colorR + first, points.colorG + first,
      points.colorB + first, light, colors.r + first, colors.g + first, colors.b + first);
    return;
  }
  HWY_DYNAMIC_DISPATCH(finishPlain)
  (material.ambient * material.ambientColor, material.diffuse * material.diffuseColor,
    material.specular * material.specularColor, lit, last - first, light, colors.r + first,
    colors.g + first, colors.b + first);
}
}
#endif
