// Counts shadow volumes for each pixel, in a stencil buffer. (Crow, SIGGRAPH 1977; Heidmann, Real
// Shadows, Real Time, IRIS Universe 18, 1991; by what lies behind a point, Everitt and Kilgard,
// 2002; both ways in one pass.)
#ifndef svoVolumeCounter_h
#define svoVolumeCounter_h

#include "svoVolumeDraws.h"
#include "vtkSVOOpenGLModule.h"

#include <functional>
#include <string>

class vtkOpenGLState;

namespace svo
{
/// Seven bits count: a point in 128 volumes, or 256, is taken to be in none. Of closed meshes those
/// are so many surfaces one behind the other that face the light.
///
/// Of one renderer. All calls are made in its context; whoever owns one is told before it goes.
class VTKSVOOPENGL_EXPORT VolumeCounter
{
public:
  /// Makes the programs. False if OpenGL refuses; then `words`, a line, is why.
  bool link(std::string& words);
  /// Has room for so many pixels; none: it has no texture. False if OpenGL refuses.
  /// `shares`: the texture of the first find().
  bool resize(int width, int height, unsigned int shares);
  bool any() const { return this->Framebuffer != 0; }
  static constexpr int PixelBytes = 8;

  /// What a light's number is written to: `shares`, layers of four; and what is seen, as
  /// svoShadowMaskShader.glsl reads it.
  struct Pixels
  {
    unsigned int places, planes, shares;
  };
  /// Has `rays` draw over the pixels whose light the volumes do not tell, or not alone, into the
  /// framebuffer that it is given.
  using Rays = std::function<void(unsigned int framebuffer)>;
  /// Finds a light's number of all pixels.
  void find(vtkOpenGLState* state, const VolumeDraws& draws, int number, const Pixels& pixels,
    const Rays& rays);
  void release();

private:
  class Scope;
  void receive(const VolumeDraws& draws, int number, const Pixels& pixels);
  void darken(const VolumeDraws& draws, int number, const Pixels& pixels);

  int Width = 0, Height = 0;
  unsigned int Depths = 0, Framebuffer = 0, Vertices = 0;
  unsigned int Sides = 0, Caps = 0, Receivers = 0, Dark = 0; // programs
};
}

#endif
