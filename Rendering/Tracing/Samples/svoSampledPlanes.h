// What of a frame's light samples answer for, as planes of an image each.
#ifndef svoSampledPlanes_h
#define svoSampledPlanes_h

#include "svoScene.h"
#include "svoShadows.h"

#include <cstddef>
#include <vector>

namespace svo
{
struct SampledPlanes
{
  static constexpr int None = -1;

  std::vector<int> ofLights; // what is missed, by index into Scene::lights
  int ofOcclusion = None;    // what is closed off
  int ofSky = None;          // the first of red, green and blue of what is seen, of the brightest
  int count = 0;

  SampledPlanes() = default;
  SampledPlanes(const Scene& scene, const Shadows& dark)
  {
    for (std::size_t l = 0; l < scene.lights.size(); ++l)
    {
      this->ofLights.push_back(dark.sampled(l) ? this->count++ : None);
    }
    if (dark.occlusion())
    {
      this->ofOcclusion = this->count++;
    }
    if (dark.sky())
    {
      this->ofSky = this->count;
      this->count += 3;
    }
  }

  bool any() const { return this->count > 0; }
};
}

#endif
