// A scene: instances of octrees with their look, receivers, and lights. Plain data, collected anew
// where something changed.
#ifndef svoScene_h
#define svoScene_h

#include "svoBox.h"
#include "svoInstance.h"
#include "svoLight.h"

#include <cstdint>
#include <vector>

namespace svo
{
struct Scene
{
  std::vector<Instance> instances;
  /// Another one where any of `instances` has another version, or there are more or fewer; 0: that
  /// may be. Of what follows it says nothing.
  std::uint64_t version = 0;
  /// Of surfaces that are no instances but receive shadows of instances; world.
  std::vector<Box> receivers;
  std::vector<Light> lights;  // only those that are switched on, in the renderer's order
  bool onlyHeadlight = false; // VTK shades by the headlight alone; lights that are off count, too
};
}

#endif
