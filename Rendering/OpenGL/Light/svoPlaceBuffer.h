// Where the surfaces lie that VTK draws, pixel by pixel, and what reaches them of lights. (A
// G-buffer, as of Saito and Takahashi 1990, of places and planes.)
#ifndef svoPlaceBuffer_h
#define svoPlaceBuffer_h

#include "vtkSVOOpenGLModule.h"

#include <cstddef>
#include <functional>

class vtkOpenGLState;

namespace svo
{
struct LightCode;
struct ReceiverPlaces;

/// All calls are made in one context; whoever owns one is told before it goes.
class VTKSVOOPENGL_EXPORT PlaceBuffer
{
public:
  /// Slices of what is translucent: the nearest surfaces, and those behind them.
  static constexpr int TranslucentSlices = 2;

  /// Has room for so many pixels, and for slices one above the other, as ReceiverPlaces has them;
  /// and for a mask of them, shares of four lights a layer, of a format of OpenGL's. False, and
  /// nothing is there, if OpenGL refuses.
  bool resize(int width, int height, bool translucent, int layers, unsigned int format);
  /// True if it has.
  bool fits(int width, int height, bool translucent, int layers, unsigned int format) const
  {
    return this->any() && width == this->Width && height == this->Height &&
      translucent == this->translucent() && layers == this->Layers && format == this->Format;
  }
  void release();

  /// Draws the opaque surfaces of slice 0, or all translucent ones, with shaders that write where
  /// they lie as svoShadowReceiver.glsl does while svoGather is 1, into the framebuffer that is
  /// bound then. Its viewport is the slice's, which begins in row `behind` if that is above 0: only
  /// what lies behind the slice before is to be drawn then.
  using Draw = std::function<void(int slice, int behind)>;
  /// Other state is as before.
  void gather(vtkOpenGLState* state, const Draw& draw);
  /// Has code look up the mask, in a picture of so many pixels; aim() says where that lies. With
  /// `others` it knows of what the mask has something to say.
  void describe(LightCode& code, int width, int height, bool others) const;
  /// The code will be used in the current viewport.
  static void aim(vtkOpenGLState* state, LightCode& code);
  /// What was gathered.
  void read(vtkOpenGLState* state, ReceiverPlaces& places) const;

  bool any() const { return this->Framebuffer != 0; }
  int width() const { return this->Width; }
  int height() const { return this->Height; } // of a slice
  bool translucent() const { return this->Slices > 1; }
  /// Of all slices, of `height` rows with margins, so that nothing is beside another slice.
  static int rowsOf(int height, bool translucent)
  {
    return translucent ? (1 + TranslucentSlices) * ((height + 7) / 8 * 8 + 8) : height;
  }
  /// True if OpenGL has room for so many, of all slices.
  static bool hasRows(int height);
  int rows() const { return rowsOf(this->Height, this->translucent()); }
  int sliceRows() const { return this->rows() / this->Slices; }
  unsigned int places() const { return this->Places; } // ReceiverPlaces
  unsigned int planes() const { return this->Planes; }
  unsigned int shares() const { return this->Shares; } // the mask
  int layers() const { return this->Layers; }
  unsigned int format() const { return this->Format; }
  /// With so many more of each pixel, those of the mask.
  static std::size_t bytesOf(int width, int height, bool translucent, int more)
  {
    const int numbers =
      (16 + 8 + 4 + more) * rowsOf(height, translucent) + (translucent ? 16 * height : 0);
    return static_cast<std::size_t>(width) * numbers;
  }

private:
  int Width = 0, Height = 0, Slices = 1, Layers = 0;
  unsigned int Places = 0, Planes = 0, Depths = 0, Before = 0, Shares = 0; // textures
  unsigned int Format = 0, Framebuffer = 0;
};
}

#endif
