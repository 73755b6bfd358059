// How much of each light reaches each pixel: a picture, found once all surfaces have said where
// they lie, so that what is hidden asks nothing, and rays run side by side whatever triangles they
// start from ("deferred shadowing").
#ifndef svoShadowMask_h
#define svoShadowMask_h

#include "svoLightCode.h"
#include "svoLightSamples.h"
#include "svoPixelProgram.h"
#include "svoPlaceBuffer.h"
#include "svoVolumeCounter.h"
#include "vtkSVOOpenGLModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class vtkOpenGLState;

namespace svo
{
/// Of one renderer. All calls are made in its context; whoever owns one is told before it goes.
class VTKSVOOPENGL_EXPORT ShadowMask
{
public:
  /// Who asks: compute shaders (OpenGL 4.3), or a triangle over all pixels.
  enum class Method
  {
    Compute, // where there are such shaders
    Fragments
  };
  /// Before the first lookUp().
  void setMethod(Method method) { this->Wanted = method; }

  /// True if OpenGL compiles the code, or it is not costly. Else why not stands in refusal(), a
  /// sentence, until release(): VTK's own shaders, which have the same code in them, would fail.
  bool accepts(const LightCode& code);
  const std::string& refusal() const { return this->Refusal; }
  /// The same of what counts shadow volumes (LightCode::volumes), without which there is all else.
  bool acceptsVolumes();
  const std::string& volumeRefusal() const { return this->VolumeRefusal; }

  /// For a frame of so many pixels: code that looks up what find() will find of the code `asked`,
  /// until the next call. With `others` there are fragments that the mask says nothing of, parts of
  /// pixels and `translucent` ones: these ask themselves, or where something is sampled the mask
  /// knows translucent surfaces as well if it can (LightCode::translucent).
  /// `asked` itself, and nothing is to be found, if it is not costly, or if a mask does not fit
  /// into `room`, bytes, or OpenGL has none; then without what is sampled.
  const LightCode& lookUp(const LightCode& asked, int width, int height, bool others,
    std::size_t room, bool translucent = false);

  /// Fills the mask; `draw` as of PlaceBuffer::gather(), whose surfaces are those of the last call
  /// if they are the `same`. The current viewport is where the code will be used. With `measure`
  /// the mask is read where samples are added, and changed() is known.
  void find(vtkOpenGLState* state, const LightCode& asked, bool same, const PlaceBuffer::Draw& draw,
    bool measure = false);
  /// What more samples of the same picture have changed, RMS of 0..255; negative: not known.
  double changed() const { return this->Changed; }

  /// Bytes that a mask takes, of so many numbers (LightCode::count()) and of what is sampled.
  /// With `volumes` they are counted in it.
  static std::size_t bytesOf(int width, int height, int numbers, int sampled = 0,
    bool translucent = false, bool volumes = false);
  /// True if compute shaders asked last.
  bool computes() const { return this->Program.computes(); }
  std::size_t bytes() const;
  void release();

private:
  bool resize(int width, int height, bool translucent, const LightCode& asked, std::size_t room);
  bool link(const LightCode& asked, bool computes);
  std::vector<std::uint16_t> read() const;
  void compare(
    vtkOpenGLState* state, const LightCode& asked, const std::vector<std::uint16_t>& before);
  void releaseTextures();

  Method Wanted = Method::Compute;
  unsigned int Answering = 0; // the framebuffer that the mask is filled in
  PlaceBuffer Surfaces;
  PixelProgram Program;
  LightSamples Samples;
  VolumeCounter Counter;
  std::string Refusal, VolumeRefusal;
  // The code that the program asks:
  std::string Constants;
  const char* Text = nullptr;
  std::string Texts[2]; // of what looks up, without and with `others`
  // What a mask of samples is of; 0 samples: nothing.
  std::uint64_t Picture = 0;
  int Found = 0;
  double Changed = -1.0;
  LightCode Code;
};
}

#endif
