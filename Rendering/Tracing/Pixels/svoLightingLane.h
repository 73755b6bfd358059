// The arithmetic of VTK's lighting of surfaces without textures and PBR, as its OpenGL shaders
// compute it (vtkOpenGLPolyDataMapper::ReplaceShaderLight), for one point, on plain floats. The
// loops over the points of a tile (svoTileLighting.cxx) call it, and become vectors; the tests'
// reference calls it for one point.
//
// Frame of reference: view space. Vectors are three floats; lengths in the world's unit.
#ifndef svoLightingLane_h
#define svoLightingLane_h

#include <cmath>

#include <glm/vec3.hpp>

namespace svo
{
struct Lane3
{
  float x, y, z;

  Lane3(float a, float b, float c)
    : x(a)
    , y(b)
    , z(c)
  {
  }
  explicit Lane3(const glm::vec3& v)
    : x(v.x)
    , y(v.y)
    , z(v.z)
  {
  }
};

inline float dotLane(const Lane3 a, const Lane3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline float positiveLane(float value)
{
  return 0.0f < value ? value : 0.0f;
}

/// The light of a lamp at a place that arrives at a point.
struct ArrivingLane
{
  Lane3 direction;   // the way it goes, unit
  float attenuation; // without the spot's
};

/// `lamp`: the place; `axis`: the direction at the lamp's own place; `attenuation`: constant,
/// linear, quadratic.
inline ArrivingLane arriveLane(
  const Lane3 point, const Lane3 lamp, const Lane3 axis, const Lane3 attenuation)
{
  const Lane3 way(point.x - lamp.x, point.y - lamp.y, point.z - lamp.z);
  const float distance = std::sqrt(dotLane(way, way));
  return { Lane3(distance > 0.0f ? way.x / distance : axis.x,
             distance > 0.0f ? way.y / distance : axis.y,
             distance > 0.0f ? way.z / distance : axis.z),
    1.0f / (attenuation.x + attenuation.y * distance + attenuation.z * distance * distance) };
}

/// Share of the light that the surface scatters.
inline float diffuseLane(float attenuation, const Lane3 normal, const Lane3 direction)
{
  return positiveLane(
    attenuation * (normal.x * -direction.x + normal.y * -direction.y + normal.z * -direction.z));
}

/// The base of the highlight's power: the cosine between the mirrored light and the way to the eye.
inline float highlightLane(const Lane3 point, const Lane3 normal, const Lane3 direction)
{
  const float length = std::sqrt(dotLane(point, point));
  const Lane3 towards(length > 0.0f ? -point.x / length : 0.0f,
    length > 0.0f ? -point.y / length : 0.0f, length > 0.0f ? -point.z / length : 1.0f);
  const float along = dotLane(normal, direction);
  const Lane3 mirrored(direction.x - normal.x * along * 2.0f, direction.y - normal.y * along * 2.0f,
    direction.z - normal.z * along * 2.0f);
  return positiveLane(dotLane(mirrored, towards));
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
