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
  /// GLSL 1.50 that stands before a fragment shader's main(): constants, which may differ from
  /// frame to frame, and what never does. It may stand beside LightCode's. The text has
  ///
  ///   struct svoSeen { vec3 position, facet, normal, color; };
  ///   bool svoSees(vec3 end, vec3 viewEnd, out svoSeen seen)
  ///   float svoDepthOf(vec3 position)
  ///
  /// What the line of sight meets that leaves a surface's box at `end`, in the box's coordinates,
  /// and at `viewEnd`, in the view's: a position, the unit normals of its own plane and for
  /// shading, both towards the viewer, in view coordinates; a colour, 0..1. The window depth of a
  /// position. Corners of the box go through the uniform matrices svoBoxToView and svoViewToClip.
  std::string constants;
  const char* text = "";

  struct Surface
  {
    std::size_t instance; // of Scene::instances
    glm::vec3 low, high;  // its box
    bool turned;          // what is wound to the left in the box is not so in the window
    bool colored;         // the seen colour takes the place of the material's
    int rows;             // of pixels, from its lowest to its highest
    ShaderValues values;
  };
  std::vector<Surface> surfaces;
  ShaderValues values; // of all
};
}

#endif
