// What the eye sees of octrees that are traced where VTK draws: code for VTK's own fragment
// shaders. Plain data, which says all that a program needs.
#ifndef svoEyeCode_h
#define svoEyeCode_h

#include "svoShaderValues.h"

#include <cstddef>
#include <string>
#include <vector>

namespace svo
{
struct EyeCode
{
  /// GLSL 1.50 that stands before a fragment shader's main(): constants, which may differ from
  /// frame to frame, and what never does. It may stand beside LightCode's. The text has
  ///
  ///   struct svoSeen { vec3 position, facet, normal, color; };
  ///   bool svoSees(int box, vec3 end, vec3 viewEnd, out svoSeen seen)
  ///   float svoDepthOf(vec3 position)
  ///
  /// What the line of sight meets that leaves a surface's box at `end`, in the box's coordinates,
  /// and at `viewEnd`, in the view's: a position, the unit normals of its own plane and for
  /// shading, both towards the viewer, in view coordinates; a colour, 0..1. The window depth of a
  /// position that svoSees() has found.
  std::string constants;
  const char* text = "";
  /// ... and before a vertex shader's:
  ///
  ///   vec4 svoCorner(int box, vec3 corner, out vec3 end, out vec3 viewEnd)
  ///
  /// What goes through gl_Position of a corner, 0 or 1 along each axis of a box whose sides are
  /// wound to the left, seen from outside and in the window.
  const char* vertexText = "";

  /// What is seen in a box. Boxes have numbers from 0 on.
  struct Surface
  {
    std::size_t instance; // of Scene::instances
    bool tinted;          // the seen colour takes the place of the material's
    double share;         // of the picture: of its rectangle; 0: none of it is seen
  };
  std::vector<Surface> surfaces;
  ShaderValues values; // of all
};
}

#endif
