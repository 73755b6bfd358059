// The arithmetic of VTK's lighting of surfaces without textures and PBR, as its OpenGL shaders
// compute it (vtkOpenGLPolyDataMapper::ReplaceShaderLight), for one point. The loops over the
// points of a tile (svoTileLighting.cxx) call it, and become vectors; the tests' reference calls it
// for one point.
//
// Frame of reference: view space; lengths in the world's unit.
#ifndef svoLightingLane_h
#define svoLightingLane_h

#include "svoLight.h"
#include "svoPowerLane.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
inline float positiveLane(float value)
{
  return 0.0f < value ? value : 0.0f;
}

/// The light of a lamp at a place that arrives at a point.
struct ArrivingLane
{
  glm::vec3 direction; // the way it goes, unit
  float attenuation;   // without the cone's
};

/// `lamp`: the place; `axis`: the direction at the lamp's own place; `attenuation`: constant,
/// linear, quadratic.
inline ArrivingLane arriveLane(const glm::vec3& point, const glm::vec3& lamp, const glm::vec3& axis,
  const glm::vec3& attenuation)
{
  const glm::vec3 way = point - lamp;
  const float distance = std::sqrt(glm::dot(way, way));
  return { distance > 0.0f ? way / distance : axis,
    1.0f / (attenuation.x + attenuation.y * distance + attenuation.z * distance * distance) };
}

/// Share of the light of a lamp with a cone that it sends `cosine` off its axis. `coneCosine`: of
/// the half angle.
inline float coneLane(const Light& lamp, float coneCosine, float cosine)
{
  const float exponent = static_cast<float>(lamp.exponent);
  return cosine >= coneCosine ? (exponent == 1.0f ? cosine : powLane(cosine, exponent)) : 0.0f;
}

/// Share of the light that the surface scatters.
inline float diffuseLane(float attenuation, const glm::vec3& normal, const glm::vec3& direction)
{
  return positiveLane(attenuation * glm::dot(normal, -direction));
}

/// The base of the highlight's power: the cosine between the mirrored light and the way to the eye.
inline float highlightLane(
  const glm::vec3& point, const glm::vec3& normal, const glm::vec3& direction)
{
  const float length = std::sqrt(glm::dot(point, point));
  const glm::vec3 towards = length > 0.0f ? -point / length : glm::vec3(0.0f, 0.0f, 1.0f);
  const glm::vec3 mirrored = direction - normal * glm::dot(normal, direction) * 2.0f;
  return positiveLane(glm::dot(mirrored, towards));
}

/// A component of the colour: `ambient`, `diffuse` and `specular` of the material, `scattered` and
/// `shining` light of all lamps together.
inline float colorLane(
  bool lit, float ambient, float scattered, float diffuse, float shining, float specular)
{
  return lit ? ambient + scattered * diffuse + shining * specular : ambient + diffuse;
}
}

#endif
