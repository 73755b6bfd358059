// Silhouettes and edges in a window with multisampling: the samples of pixels that surfaces share
// with each other or with the background, and of pixels on edges inside of surfaces.
//
// The tracer answers one ray a pixel. VTK's rasteriser gives every pixel of such a window several
// depths, and one colour for each triangle in it. Samples do the same for traced surfaces, along
// their edges only, so that these are as smooth as rasterised ones.
#ifndef svoSilhouettes_h
#define svoSilhouettes_h

#include "svoFrame.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
/// Samples of one pixel that one facet covers at one depth.
struct PixelPart
{
  std::uint32_t samples = 0; // bit i: sample i
  std::uint16_t x = 0;       // pixel
  std::uint16_t y = 0;
  float depth = 1.0f;      // window depth
  std::uint8_t color[4]{}; // RGBA
};

struct Silhouettes
{
  /// A pixel of the frame with a hit, and the colour that it has in this window: the mean of its
  /// samples where one surface fills it evenly, alpha 0 where parts replace it.
  struct Pixel
  {
    std::size_t index = 0;
    std::uint8_t color[4]{}; // RGBA
  };
  std::vector<PixelPart> parts; // by `samples`, then row by row
  std::vector<Pixel> pixels;

  void clear()
  {
    this->parts.clear();
    this->pixels.clear();
  }
  /// Exchanges the colours of `pixels` with the frame's: once to use them, once more to go back.
  void exchange(Frame& frame)
  {
    for (Pixel& pixel : this->pixels)
    {
      std::swap_ranges(pixel.color, pixel.color + 4, frame.color.data() + 4 * pixel.index);
    }
  }
};
}

#endif
