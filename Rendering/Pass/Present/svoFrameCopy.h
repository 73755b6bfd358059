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
/// True if the framebuffer that is bound has one sample a pixel, colours of four bytes and depths
/// of 32 bits, as VTK's has, and OpenGL runs on the processor.
bool isWorthCopying();

/// Window depths, 0..1, as software OpenGL writes them into a depth buffer of 32 bits, which are
/// not those that it takes from an image of floats.
void toDepthBuffer(const float* depths, std::size_t count, std::uint32_t* words);

/// Copies rectangles, in pixels of the textures, from textures of these formats and of the
/// viewport's size into the viewport that is set. Returns false, and nothing is drawn, if OpenGL
/// does not take them.
bool copyRectangles(
  vtkTextureObject* colors, vtkTextureObject* depths, const std::vector<PixelRect>& rectangles);
}

#endif
