#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTileLighting.cxx"
#include <hwy/foreach_target.h>

#include "svoTileLighting.h"

#include "svoLaneBits-inl.h"
#include "svoLightingLane.h"

#include <cassert>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
constexpr int Step = TilePatch::Step;

/// Calls f(k) for the pixels of all Steps that the patch has some of.
template <class F>
HWY_INLINE void eachPoint(const TilePatch& patch, F&& f)
{
  for (int i = 0; i < TilePatch::Most; i += Step)
  {
    if (patch.has(i))
    {
      for (int k = i; k < i + Step; ++k)
      {
        f(k);
      }
    }
  }
}

/// The one light is a headlight.
void arriveFromEye(
  const glm::vec3& towards, const Material& material, const TilePatch& p, TileLight& l)
{
  const glm::vec3 axis = towards;
  const float power = material.specularPower, shines = material.specular > 0.0f ? 1.0f : 0.0f;
  eachPoint(p,
    [&](int k)
    {
      const float cosine = positiveLane(glm::dot(p.normal(k), axis));
      l.diffuse[k] = cosine;
      l.specular[k] = shines * powLane(cosine, power);
    });
}

/// The light of one lamp that arrives, by pixel.
struct Arriving
{
  PixelVectors direction;
  alignas(64) float attenuation[TilePatch::Most];
};

void arriveFromInfinity(const glm::vec3& direction, Arriving& a)
{
  const glm::vec3 along = direction;
  for (int k = 0; k < TilePatch::Most; ++k)
  {
    a.direction.set(k, along);
    a.attenuation[k] = 1.0f;
  }
}

void arriveFromPosition(const ViewLight& from, const TilePatch& p, Arriving& a)
{
  const glm::vec3 lamp(p.origin.position - from.light->position), axis = from.direction;
  const glm::vec3 constants = from.light->attenuation;
  eachPoint(p,
    [&](int k)
    {
      const ArrivingLane light = arriveLane(lamp + p.way(k), axis, constants);
      a.direction.set(k, light.direction);
      a.attenuation[k] = light.attenuation;
    });
}

void attenuateByCone(const ViewLight& from, const TilePatch& p, Arriving& a)
{
  const glm::vec3 axis = from.direction;
  const float exponent = static_cast<float>(from.light->exponent), coneCosine = from.coneCosine;
  alignas(64) float cosines[TilePatch::Most], fallen[TilePatch::Most];
  for (int i = 0; i < TilePatch::Most; i += Step)
  {
    if (!p.has(i))
    {
      continue;
    }
    for (int k = i; k < i + Step; ++k)
    {
      cosines[k] = fallen[k] = glm::dot(a.direction(k), axis);
    }
    for (int k = i; exponent != 1.0f && k < i + Step; ++k)
    {
      fallen[k] = powLane(cosines[k], exponent);
    }
    for (int k = i; k < i + Step; ++k)
    {
      a.attenuation[k] *= coneLane(fallen[k], coneCosine, cosines[k]);
    }
  }
}

void arriveAtSurface(const Lighting& lighting, const Material& material, const TilePatch& p,
  const Arriving& a, TileLight& l)
{
  const glm::vec3 origin(p.origin.position - lighting.eye), axis = lighting.towardsEye;
  const float power = material.specularPower;
  const bool shines = material.specular > 0.0f;
  alignas(64) float base[TilePatch::Most];
  for (int i = 0; i < TilePatch::Most; i += Step)
  {
    if (!p.has(i))
    {
      continue;
    }
    for (int k = i; k < i + Step; ++k)
    {
      l.diffuse[k] = diffuseLane(a.attenuation[k], p.normal(k), a.direction(k));
      l.specular[k] = 0.0f;
    }
    for (int k = i; shines && k < i + Step; ++k)
    {
      base[k] = highlightLane(origin + p.way(k), axis, p.normal(k), a.direction(k));
    }
    for (int k = i; shines && k < i + Step; ++k)
    {
      const float shone = a.attenuation[k] * powLane(base[k], power);
      l.specular[k] = l.diffuse[k] > 0.0f ? shone : 0.0f;
    }
  }
}

std::uint64_t arrive(const Lighting& lighting, const ViewLight& from, const Material& material,
  const TilePatch& p, TileLight& l)
{
  if (lighting.onlyHeadlight)
  {
    arriveFromEye(lighting.towardsEye, material, p, l);
  }
  else
  {
    Arriving arriving;
    if (from.light->atInfinity())
    {
      arriveFromInfinity(from.direction, arriving);
    }
    else
    {
      arriveFromPosition(from, p, arriving);
    }
    if (from.light->hasCone())
    {
      attenuateByCone(from, p, arriving);
    }
    arriveAtSurface(lighting, material, p, arriving, l);
  }
  const Floats floats;
  const auto zero = hn::Zero(floats);
  std::uint64_t reached = 0;
  for (int i = 0; i < TilePatch::Most; i += width())
  {
    const auto scatters = hn::Ne(hn::Load(floats, l.diffuse + i), zero);
    const auto shines = hn::Gt(hn::Load(floats, l.specular + i), zero);
    reached |= bitsOf(floats, hn::Or(scatters, shines)) << i;
  }
  return reached & p.mask;
}

/// `with`: how what is there already and what is added become one.
template <class With>
HWY_INLINE void addWith(const glm::vec3& color, const TilePatch& p, TileLight& l, With&& with)
{
  const glm::vec3 c = color;
  eachPoint(p,
    [&](int k)
    {
      const float share = l.share[k];
      l.scattered.set(k, with(l.scattered(k), share * (l.diffuse[k] * c)));
      l.shining.set(k, with(l.shining(k), share * l.specular[k] * c));
    });
}

void add(const glm::vec3& color, const TilePatch& p, bool first, TileLight& l)
{
  if (first)
  {
    addWith(color, p, l, [](const glm::vec3&, const glm::vec3& light) { return 0.0f + light; });
  }
  else
  {
    addWith(
      color, p, l, [](const glm::vec3& before, const glm::vec3& light) { return before + light; });
  }
}

/// A component of the colours: a + d * diffuse + s * specular. `own`: of each point's own colour,
/// whose shares a and d are; null: a and d are colours.
void mix(bool lit, const float* own, float a, float d, float s, const float* diffuse,
  const float* specular, const TilePatch& p, float* HWY_RESTRICT out)
{
  if (own)
  {
    eachPoint(p,
      [&](int k) { out[k] = colorLane(lit, a * own[k], diffuse[k], d * own[k], specular[k], s); });
  }
  else
  {
    eachPoint(p, [&](int k) { out[k] = colorLane(lit, a, diffuse[k], d, specular[k], s); });
  }
}

/// toByte() of each.
void pack(const TilePatch& p, TileColors& c)
{
  eachPoint(p,
    [&](int k)
    {
      const float r = c.rgb.x[k] > 0.0f ? (c.rgb.x[k] < 1.0f ? c.rgb.x[k] : 1.0f) : 0.0f;
      const float g = c.rgb.y[k] > 0.0f ? (c.rgb.y[k] < 1.0f ? c.rgb.y[k] : 1.0f) : 0.0f;
      const float b = c.rgb.z[k] > 0.0f ? (c.rgb.z[k] < 1.0f ? c.rgb.z[k] : 1.0f) : 0.0f;
      const auto red = static_cast<std::int32_t>(r * 255.0f + 0.5f);
      const auto green = static_cast<std::int32_t>(g * 255.0f + 0.5f);
      const auto blue = static_cast<std::int32_t>(b * 255.0f + 0.5f);
      c.rgba[k] = static_cast<std::uint32_t>(red | green << 8 | blue << 16) | 0xff000000u;
    });
}

void finish(const Material& m, bool lit, const TilePatch& p, const TileLight& l, TileColors& c)
{
  const bool own = p.hasColor;
  const glm::vec3 a = m.ambient * (own ? glm::vec3(1.0f) : m.ambientColor);
  const glm::vec3 d = m.diffuse * (own ? glm::vec3(1.0f) : m.diffuseColor);
  const glm::vec3 s = m.specular * m.specularColor;
  mix(lit, own ? p.color.x : nullptr, a.r, d.r, s.r, l.scattered.x, l.shining.x, p, c.rgb.x);
  mix(lit, own ? p.color.y : nullptr, a.g, d.g, s.g, l.scattered.y, l.shining.y, p, c.rgb.y);
  mix(lit, own ? p.color.z : nullptr, a.b, d.b, s.b, l.scattered.z, l.shining.z, p, c.rgb.z);
  pack(p, c);
}

void close(const Material& m, bool all, const TilePatch& p, const float* closed, TileColors& c)
{
  const bool own = p.hasColor;
  const glm::vec3 a = m.ambient * (own ? glm::vec3(1.0f) : m.ambientColor);
  const auto part = [&](float ambient, const float* color, float* HWY_RESTRICT out)
  {
    eachPoint(p,
      [&](int k)
      {
        const float from = all ? out[k] : own ? ambient * color[k] : ambient;
        out[k] -= closed[k] * from;
      });
  };
  part(a.r, p.color.x, c.rgb.x);
  part(a.g, p.color.y, c.rgb.y);
  part(a.b, p.color.z, c.rgb.z);
  pack(p, c);
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(arrive);
HWY_EXPORT(add);
HWY_EXPORT(finish);
HWY_EXPORT(close);

std::uint64_t arriveLight(const Lighting& lighting, std::size_t l, const Material& material,
  const TilePatch& patch, TileLight& light)
{
  assert(l < lighting.lights.size() && material.lighting);
  return HWY_DYNAMIC_DISPATCH(arrive)(lighting, lighting.lights[l], material, patch, light);
}

void addLight(const ViewLight& from, const TilePatch& patch, bool first, TileLight& light)
{
  HWY_DYNAMIC_DISPATCH(add)(from.light->color, patch, first, light);
}

void finishLight(const Material& material, bool lit, const TilePatch& patch, const TileLight& light,
  TileColors& colors)
{
  HWY_DYNAMIC_DISPATCH(finish)(material, lit, patch, light, colors);
}

void closeOff(const Material& material, bool all, const TilePatch& patch, const float* closed,
  TileColors& colors)
{
  HWY_DYNAMIC_DISPATCH(close)(material, all, patch, closed, colors);
}
}
#endif
