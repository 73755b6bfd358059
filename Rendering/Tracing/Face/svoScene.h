// A scene: instances of octrees with their look, receivers, and lights. Plain data, collected anew
// for every frame.
#ifndef svoScene_h
#define svoScene_h

#include "svoInstance.h"
#include "svoLight.h"

#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
/// The box, in the world, of a surface that is no instance but receives shadows of instances.
struct Receiver
{
  glm::dvec3 low, high;
};

struct Scene
{
  std::vector<Instance> instances;
  std::vector<Receiver> receivers;
  std::vector<Light> lights;  // only those that are switched on, in the renderer's order
  bool onlyHeadlight = false; // VTK shades by the headlight alone; lights that are off count, too
};
}

#endif
