// VTK's lighting of one visible point, light by light: the oracle of the tile shader.
#ifndef svoReferenceShading_h
#define svoReferenceShading_h

#include "svoLightingLane.h"
#include "svoPowerLane.h"
#include "svoSurfacePoint.h"
#include "svoViewLights.h"

#include <cstddef>
#include <utility>

namespace svo
{
/// Diffuse and specular light that arrives at a point, before any shadow.
struct Arriving
{
  glm::vec3 diffuse;
  float specular; // times the light's colour
};

/// `origin`: a place in the world, and `way` to the point from there. `onlyHeadlight`: VTK shades
/// the scene by its headlight alone, for which it has a shorter formula with another highlight.
inline Arriving arriving(const Lighting& lighting, const ViewLight& l, const glm::vec3& normal,
  const glm::dvec3& origin, const glm::vec3& way, const Material& material)
{
  const bool shines = material.specular > 0.0f;
  if (lighting.onlyHeadlight)
  {
    const float df = positiveLane(glm::dot(normal, lighting.towardsEye));
    return { df * l.light->color, shines ? powLane(df, material.specularPower) : 0.0f };
  }
  ArrivingLane light{ l.direction, 1.0f };
  if (!l.light->atInfinity())
  {
    light =
      arriveLane(glm::vec3(origin - l.light->position) + way, l.direction, l.light->attenuation);
    if (l.light->hasCone())
    {
      const float cosine = glm::dot(light.direction, l.direction);
      const float exponent = static_cast<float>(l.light->exponent);
      light.attenuation *=
        coneLane(exponent == 1.0f ? cosine : powLane(cosine, exponent), l.coneCosine, cosine);
    }
  }
  const glm::vec3 fromEye = glm::vec3(origin - lighting.eye) + way;
  const float df = diffuseLane(light.attenuation, normal, light.direction);
  const float base = highlightLane(fromEye, lighting.towardsEye, normal, light.direction);
  const float sf =
    shines && df > 0.0f ? light.attenuation * powLane(base, material.specularPower) : 0.0f;
  return { df * l.light->color, sf };
}

/// Colour of a visible point, 0..1 and beyond. dark(light) is asked for lights that reach the
/// point only, and says which share of the light, 0..1, something between them takes, or whether
/// something does; of what is taken `remaining` is left. The point is at `way` from `origin`.
template <class Dark>
glm::vec3 shade(const Lighting& lighting, const Instance& instance, const SurfacePoint& point,
  const glm::dvec3& origin, const glm::vec3& way, float remaining, Dark&& dark)
{
  const Material& material = instance.material;
  const glm::vec3 ambient =
    material.ambient * (point.hasColor ? point.color : material.ambientColor);
  const glm::vec3 diffuseColor =
    material.diffuse * (point.hasColor ? point.color : material.diffuseColor);
  const glm::vec3 shine = material.specular * material.specularColor;
  glm::vec3 diffuse(0.0f);
  glm::vec3 specular(0.0f);
  const auto colored = [&](bool lit)
  {
    glm::vec3 color;
    for (int c = 0; c < 3; ++c)
    {
      color[c] = colorLane(lit, ambient[c], diffuse[c], diffuseColor[c], specular[c], shine[c]);
    }
    return color;
  };
  if (!material.lighting || lighting.lights.empty())
  {
    return colored(false);
  }
  for (std::size_t l = 0; l < lighting.lights.size(); ++l)
  {
    const Light& light = *lighting.lights[l].light;
    const Arriving a = arriving(lighting, lighting.lights[l], point.normal, origin, way, material);
    const bool reached = a.diffuse != glm::vec3(0.0f) || a.specular > 0.0f;
    const float share = reached && instance.receiveShadow && light.castShadow
      ? shareOfLight(static_cast<float>(dark(l)), remaining)
      : 1.0f;
    diffuse += share * a.diffuse;
    specular += share * a.specular * light.color;
  }
  return colored(true);
}

/// The same of a point that is its own origin.
template <class Dark>
glm::vec3 shade(const Lighting& lighting, const Instance& instance, const SurfacePoint& point,
  float remaining, Dark&& dark)
{
  return shade(lighting, instance, point, point.position, glm::vec3(0.0f), remaining,
    std::forward<Dark>(dark));
}
}

#endif
