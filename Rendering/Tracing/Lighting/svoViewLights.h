// The lights of a frame, as shading needs them.
#ifndef svoViewLights_h
#define svoViewLights_h

#include "svoScene.h"
#include "svoView.h"

#include <cmath>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// A light, along the world's axes.
struct ViewLight
{
  glm::vec3 direction; // unit, the way it shines
  const Light* light;
  float coneCosine;
};

/// The lights of a frame, as shading needs them. VTK's shaders light in view space; nothing that
/// they compute there depends on how its axes are turned, so here these are the world's.
struct Lighting
{
  std::vector<ViewLight> lights;
  bool onlyHeadlight = false;
  glm::dvec3 eye{ 0.0 };           // the origin of view space
  glm::vec3 towardsEye{ 0, 0, 1 }; // the view's axis, unit
  glm::mat3 rotation{ 1.0f };      // to view space

  Lighting(const Scene& scene, const View& view)
    : onlyHeadlight(scene.onlyHeadlight)
    , eye(view.eye)
    , towardsEye(view.worldToView[0][2], view.worldToView[1][2], view.worldToView[2][2])
    , rotation(view.worldToView)
  {
    for (const Light& light : scene.lights)
    {
      lights.push_back({ glm::vec3(light.direction), &light,
        static_cast<float>(std::cos(glm::radians(light.coneAngle))) });
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
