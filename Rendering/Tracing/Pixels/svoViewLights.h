// The lights of a frame in view space.
#ifndef svoViewLights_h
#define svoViewLights_h

#include "svoScene.h"
#include "svoView.h"

#include <cmath>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>

namespace svo
{
/// A light in view space.
struct ViewLight
{
  glm::vec3 direction; // unit, the way it shines
  glm::vec3 position;
  const Light* light;
  float coneCosine;
};

inline ViewLight makeViewLight(const Light& light, const View& view)
{
  const glm::dmat3 rotation(view.worldToView);
  return { glm::vec3(rotation * light.direction),
    glm::vec3(view.worldToView * glm::dvec4(light.position, 1.0)), &light,
    static_cast<float>(std::cos(glm::radians(light.coneAngle))) };
}

/// The lights of a frame, as shading needs them.
struct Lighting
{
  std::vector<ViewLight> lights;
  bool onlyHeadlight = false;
  glm::dmat4 worldToView{ 1.0 };
  glm::mat3 rotation{ 1.0f };

  Lighting(const Scene& scene, const View& view)
    : onlyHeadlight(scene.onlyHeadlight)
    , worldToView(view.worldToView)
    , rotation(view.worldToView)
  {
    for (const Light& light : scene.lights)
    {
      lights.push_back(makeViewLight(light, view));
    }
  }
};

/// The share of a light that is left at a point that misses the share `darkness`, 0..1, if
/// `remaining` is left in a whole shadow. Exact at both ends.
inline float shareOfLight(float darkness, float remaining)
{
  return darkness >= 1.0f ? remaining
    : darkness > 0.0f     ? 1.0f - darkness * (1.0f - remaining)
                          : 1.0f;
}
}

#endif
