// The arithmetic of VTK's lighting of surfaces without textures and PBR, as its OpenGL shaders
// compute it (vtkOpenGLPolyDataMapper::ReplaceShaderLight), for one point. The loops over the
// points of a tile (svoTileLighting.cxx) call it, and become vectors; the tests' reference calls it
// for one point.
//
// Coordinates: the world's axes and unit of length; points are ways from the eye, or from a
// lamp, whose rounding does not grow with how far the world's origin is.
#ifndef svoLightingLane_h
#define svoLightingLane_h

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

/// One of two vectors, by components: a choice between two objects were one between places.
inline glm::vec3 chosenLane(bool first, const glm::vec3& a, const glm::vec3& b)
{
  return { first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z };
}

/// The light of a lamp at a place that arrives at a point.
struct ArrivingLane
{
  glm::vec3 direction; // the way it goes, unit
  float attenuation;   // without the cone's
};

/// `way`: from the lamp to the point; `axis`: the direction at the lamp's own place; `attenuation`:
/// constant, linear, quadratic.
inline ArrivingLane arriveLane(
  const glm::vec3& way, const glm::vec3& axis, const glm::vec3& attenuation)
{
  const float distance = std::sqrt(glm::dot(way, way));
  const glm::vec3 along = way * (1.0f / distance);
  return { chosenLane(distance > 0.0f, along, axis),
    1.0f / (attenuation.x + attenuation.y * distance + attenuation.z * distance * distance) };
}

/// Share of the light of a lamp with a cone that it sends `cosine` off its axis. `coneCosine`: of
/// the half angle; `fallen`: the cosine to the power of the fall-off, which is mostly itself.
inline float coneLane(float fallen, float coneCosine, float cosine)
{
  return cosine >= coneCosine ? fallen : 0.0f;
}

/// Share of the light that the surface scatters.
inline float diffuseLane(float attenuation, const glm::vec3& normal, const glm::vec3& direction)
{
  return positiveLane(attenuation * glm::dot(normal, -direction));
}

/// The base of the highlight's power: the cosine between the mirrored light and the way to the eye.
/// `point`: the way from there, `axis`: the eye's own, towards it.
inline float highlightLane(const glm::vec3& point, const glm::vec3& axis, const glm::vec3& normal,
  const glm::vec3& direction)
{
  const float length = std::sqrt(glm::dot(point, point));
  const glm::vec3 towards = chosenLane(length > 0.0f, point * (-1.0f / length), axis);
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
