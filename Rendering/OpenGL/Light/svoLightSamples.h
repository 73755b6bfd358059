// What samples of lights with a size, and of what is all around, have found at each pixel: sums,
// kept from frame to frame, to which more samples of the same are added.
#ifndef svoLightSamples_h
#define svoLightSamples_h

#include "svoBufferTexture.h"
#include "svoLightCode.h"
#include "svoPixelProgram.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkOpenGLState;

namespace svo
{
/// Of one renderer. All calls are made in its context; whoever owns one is told before it goes.
class LightSamples
{
public:
  /// Makes the program that takes them, by compute shaders or not; false, and `words` is why, if
  /// OpenGL refuses.
  bool link(const LightCode& asked, bool computes, std::string& words);
  /// Has room for sums, a layer each of what is sampled; 0: none. False if OpenGL refuses.
  bool resize(int width, int height, int layers);
  int layers() const { return this->Layers; }

  /// Takes those that are asked for, and not there yet, from where `places` say that surfaces lie,
  /// in slices of so many rows (ReceiverPlaces).
  void take(vtkOpenGLState* state, const LightCode& asked,
    const std::vector<ShaderValues::Texture>& places, int sliceRows);
  void forget() { this->Held = 0; }

  /// Layers by what is sampled (LightCode::sampled): red, green, blue, and how many.
  unsigned int sums() const { return this->Sums; }
  void release();

private:
  PixelProgram Program;
  BufferTexture Sequence{ BufferTexture::Texel::Word };
  int Width = 0, Height = 0, Layers = 0;
  unsigned int Sums = 0, Framebuffer = 0;
  int Held = 0; // samples of each pixel
  std::uint64_t Picture = 0;
};
}

#endif
