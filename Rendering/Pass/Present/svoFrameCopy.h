// Copies pixels into the framebuffer as they are, colour and depth, without a shader.
//
// Software OpenGL takes ten times as long to draw a texel as to copy it: 16 ms of 1920x1080 pixels
// against 1.2 ms. Copies know no depth test, so they are for pixels before which nothing has been
// drawn; and formats have to be equal, to the bit.
#ifndef svoFrameCopy_h
#define svoFrameCopy_h

#include "svoView.h"

#include <cstddef>
#include <cstdint>

#include <vector>

class vtkTextureObject;

namespace svo
{
/// The depth buffers that can be copied to.
enum class DepthFormat
{
  None,
  Bits32, // as VTK's framebuffers have them,
  Bits24  // and where windows have a stencil: in words with its bits, which are cleared
};

/// That of the framebuffer that is bound, if it has one sample a pixel and colours of four bytes,
/// and OpenGL runs on the processor; else none.
DepthFormat formatForCopies();

/// True if the framebuffer that is bound keeps colours beyond 1.
bool keepsLight();

/// Window depths, 0..1, as software OpenGL writes them into such a depth buffer, which are not
/// those that it takes from an image of floats.
void toDepthBuffer(
  const float* depths, std::size_t count, DepthFormat format, std::uint32_t* words);

/// Copies rectangles, in pixels of the textures, from textures of these formats and of the
/// viewport's size into the viewport that is set. Returns false, and nothing is drawn, if OpenGL
/// does not take them.
bool copyRectangles(vtkTextureObject* colors, vtkTextureObject* depths, DepthFormat format,
  const std::vector<PixelRect>& rectangles);
}

#endif
