// What the eye sees of octrees that are traced where VTK draws: code for VTK's own fragment
// shaders. Plain data, which says all that a program needs.
#ifndef svoEyeCode_h
#define svoEyeCode_h

#include "svoShaderValues.h"

#include <cstddef>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
struct EyeCode
{
  /// GLSL 1.50 that stands before main(): constants, which may differ from frame to frame, and what
  /// never does. May stand beside LightCode's. The text has
  ///
  ///   vec4 svoViewOf(vec3 corner)
  ///   bool svoSees(vec3 end, vec3 viewEnd, out svoSeen seen)
  ///   float svoDepthOf(vec3 position)
  ///
  /// and `svoSeen` the position, the facet's unit normal and that for shading, both towards the
  /// viewer, and a colour: in view coordinates, and 0..1. svoViewOf() takes the coordinates of a
  /// surface's box to the view's; `end` and `viewEnd` is where a line of sight leaves the box, in
  /// both; svoDepthOf() is the window depth of a position. With the uniform matrix svoViewToClip.
  std::string constants;
  const char* text = "";

  struct Surface
  {
    std::size_t instance; // of Scene::instances
    glm::vec3 low, high;  // its box
    bool turned;          // corners that are wound to the left in the box are so in the window
    bool colored;         // the seen colour takes the place of the material's
    ShaderValues values;
  };
  std::vector<Surface> surfaces;
  ShaderValues values; // of all
};
}

#endif
