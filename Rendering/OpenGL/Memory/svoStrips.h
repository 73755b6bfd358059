// Drawing by shaders that walk through octrees, some rows of pixels at a time: drivers end what
// takes two seconds, and what else is on the screen waits for it.
#ifndef svoStrips_h
#define svoStrips_h

#include "svoOpenGL.h"

#include <algorithm>
#include <cmath>

namespace svo
{
/// ... as many pixels, that is, as these rows of a picture have.
constexpr int RowsAtOnce = 128;

/// draw(row, rows) for strips from row `first` up to `end`, of whole groups of 8 rows but for the
/// last; OpenGL begins each at once. `share`: of the rows' pixels those that are asked for, one
/// that is asked for twice as two.
template <typename Draw>
void eachStrip(int first, int end, double share, const Draw& draw)
{
  const double strips = std::max(std::ceil(share * (end - first) / RowsAtOnce), 1.0);
  const int rows = 8 * std::max(static_cast<int>(std::ceil((end - first) / (8.0 * strips))), 1);
  for (int row = first; row < end; row += rows)
  {
    draw(row, std::min(rows, end - row));
    glFlush();
  }
}
}

#endif
