// Where the surfaces lie that VTK draws, pixel by pixel. (A G-buffer, as of Saito and Takahashi
// 1990, of places and planes.)
#ifndef svoPlaceBuffer_h
#define svoPlaceBuffer_h

#include "vtkSVOOpenGLModule.h"

#include <cstddef>
#include <functional>

class vtkOpenGLState;

namespace svo
{
struct ReceiverPlaces;

/// All calls are made in one context; whoever owns one is told before it goes.
class VTKSVOOPENGL_EXPORT PlaceBuffer
{
public:
  /// Has room for so many pixels; none: it has no textures. False if OpenGL refuses.
  bool resize(int width, int height);

  /// `draw` draws the surfaces, with shaders that write where they lie as svoShadowReceiver.glsl
  /// does while svoGather is 1, into the framebuffer that is bound then. Its viewport is the
  /// buffer's. Other state is as before.
  void gather(vtkOpenGLState* state, const std::function<void()>& draw);
  /// What was gathered.
  void read(vtkOpenGLState* state, ReceiverPlaces& places) const;

  bool any() const { return this->Framebuffer != 0; }
  int width() const { return this->Width; }
  int height() const { return this->Height; }
  unsigned int places() const { return this->Places; } // ReceiverPlaces
  unsigned int planes() const { return this->Planes; }
  static constexpr std::size_t BytesOfPixel = 16 + 8 + 4;
  std::size_t bytes() const { return BytesOfPixel * this->Width * this->Height; }

private:
  int Width = 0, Height = 0;
  unsigned int Places = 0, Planes = 0, Depths = 0; // textures
  unsigned int Framebuffer = 0;
};
}

#endif
