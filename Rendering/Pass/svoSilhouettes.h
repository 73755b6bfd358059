// Pixels that surfaces share with each other or with the background: what each of them covers.
//
// The tracer answers one ray a pixel. In a window with multisampling VTK's rasteriser gives every
// pixel several depths, and one colour for each surface in it; this does the same for traced
// surfaces, along their silhouettes only, so that their edges are as smooth as everybody else's.
#ifndef svoSilhouettes_h
#define svoSilhouettes_h

#include "svoParallel.h"
#include "svoScene.h"
#include "svoTracer.h"
#include "svoView.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace svo
{
/// What one surface covers of one pixel.
struct PixelPart
{
  std::uint32_t samples = 0; // bit i: sample i
  std::uint16_t x = 0;       // pixel
  std::uint16_t y = 0;
  float depth = 1.0f;      // window depth, mean of its samples
  std::uint8_t color[4]{}; // RGBA, of the nearest pixel whose centre shows the surface
};

struct Silhouettes
{
  std::vector<PixelPart> parts;    // by `samples`, then row by row
  std::vector<std::size_t> pixels; // of the frame with a hit, which the parts replace

  void clear()
  {
    this->parts.clear();
    this->pixels.clear();
  }
};

/// Finds the pixels where the instance or the depth changes and traces a ray through each of their
/// samples, at `positions` in a pixel, 0..1, at most 32. `scene`, `view` and `pixelError` are what
/// `frame` was rendered with. A pixel that one surface fills is left to the frame.
void findSilhouettes(const Scene& scene, const View& view, double pixelError, const Frame& frame,
  const std::vector<glm::vec2>& positions, const ParallelFor& parallelFor, Silhouettes& result);
}

#endif
