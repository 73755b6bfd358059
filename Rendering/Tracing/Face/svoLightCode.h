// How much of each light reaches what VTK draws itself: code for VTK's own fragment shaders. Plain
// data, which says all that a program needs.
#ifndef svoLightCode_h
#define svoLightCode_h

#include "svoShaderValues.h"

#include <string>
#include <vector>

namespace svo
{
struct LightCode : ShaderValues
{
  /// By number in the code: index into Scene::lights. A light that is there several times gets the
  /// product. Empty: there is no code.
  std::vector<int> lights;

  /// GLSL 1.50 that stands before main(): constants, which may differ from frame to frame, and what
  /// never does. The text has
  ///
  ///   float svoLeft(int number, vec3 position, vec3 facet, vec3 normal, vec3 lift, float extent)
  ///
  /// the share, 0..1, of a light that casters leave at a point. In view coordinates: where that is;
  /// the unit normal of its own plane, towards the viewer; the unit normal that it is shaded with;
  /// how far the smooth surface lies over the facet, 0 where it does not; how wide a piece of the
  /// surface the fragment shows.
  std::string constants;
  const char* text = "";

  /// Asking takes so long that each pixel is worth to be asked once, when it is known what is seen
  /// there (svoShadowMask.h).
  bool costly = false;
  /// The text reads what has been found so: surfaces are drawn once before, and say where they lie.
  bool fromPlaces = false;

  /// Why there is no code although it was asked for, in a sentence; empty if all is well.
  std::string complaint;

  bool empty() const { return this->lights.empty(); }
};
}

#endif
