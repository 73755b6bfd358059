// A mask of what a tracer without OpenGL has sampled of the light, for what VTK draws.
#ifndef svoSampledMask_h
#define svoSampledMask_h

#include "svoFrame.h"
#include "svoLightCode.h"
#include "svoPlaceBuffer.h"
#include "svoReceivers.h"
#include "svoView.h"
#include "vtkSVOOpenGLModule.h"

#include <cstddef>
#include <map>
#include <string>
#include <utility>

class vtkOpenGLState;

namespace svo
{
/// Of one renderer. All calls are made in its context; whoever owns one is told before it goes.
class VTKSVOOPENGL_EXPORT SampledMask
{
public:
  /// For a frame: code that looks up these shares, until the next call, and of other lights what
  /// `maps` say. The mask has the view's pixels, the picture so many. With `others` there are
  /// fragments that the mask says nothing of, parts of pixels and `translucent` ones: they take
  /// their neighbours' light, or that of `maps`. `maps`, if nothing is sampled, or OpenGL has no
  /// room.
  const LightCode& lookUp(const LightCode& maps, const ReceiverShares& shares,
    const FrameSettings& settings, const View& view, bool unlit, int width, int height, bool others,
    bool translucent);
  /// True if the last call gave code of its own.
  bool any() const { return !this->Code.empty(); }

  /// The code will be used in the current viewport.
  void aim(vtkOpenGLState* state) { PlaceBuffer::aim(state, this->Code); }
  /// Gathers where surfaces lie; see PlaceBuffer::gather().
  void gather(vtkOpenGLState* state, const PlaceBuffer::Draw& draw, ReceiverPlaces& places);
  /// Has these numbers.
  void upload(const ReceiverShares& shares);
  /// True if it has some, and what was gathered.
  bool filled() const { return this->Filled; }

  std::size_t bytes() const;
  void release();

private:
  const char* textOf(const LightCode& maps, bool others);

  PlaceBuffer Surfaces;
  bool Filled = false;
  std::map<std::pair<const char*, bool>, std::string> Texts; // by that of maps, and others
  LightCode Code;
};
}

#endif
