// How much of each light reaches what VTK draws itself: code for VTK's own fragment shaders. Plain
// data, which says all that a program needs.
#ifndef svoLightCode_h
#define svoLightCode_h

#include "svoShaderValues.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace svo
{
struct VolumeDraws;

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
  bool translucent = false; // ... and so do those that something is seen through

  /// Numbers behind those of the lights: what is open all around (1 less ambient occlusion), and
  /// the first of three, red, green and blue, of what is seen of the sky, of
  /// Sky::brightest().
  static constexpr int None = -1;
  int occlusion = None, sky = None;
  bool hasAround() const { return this->occlusion != None || this->sky != None; }
  bool unlit = false; // there are no lights, not even some that cast nothing
  /// All numbers.
  int count() const
  {
    return static_cast<int>(this->lights.size()) + (this->occlusion != None) +
      (this->sky != None ? 3 : 0);
  }

  /// What is the mean of samples, and is so costly that only a shadow mask has it: what is around,
  /// and lights with a size. Code alone takes these for points.
  struct Sampled
  {
    int number;      // the first one
    unsigned stream; // pixelRotation()
    /// Of a ball its radius, of a disc the tangent of half its angle; else how far rays go.
    float size;
  };
  std::vector<Sampled> sampled;
  int samples = 0;           // of each, a pixel
  std::uint64_t picture = 0; // another one wherever earlier samples say nothing

  /// What is drawn to find the shadows that opaque casters of triangles throw (svoVolumeDraws.h),
  /// in a shadow mask; null: the code finds all. Nothing is sampled then.
  std::shared_ptr<const VolumeDraws> volumes;

  /// What is to be told of it, in a sentence; empty if all is as the settings ask.
  std::string remark;
  /// Why there is no code although it was asked for, in a sentence; empty if all is well.
  std::string complaint;

  bool empty() const { return this->count() == 0; }
};
}

#endif
