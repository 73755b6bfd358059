// Drawing by shaders that walk through octrees, some rows of pixels at a time: drivers end what
// takes two seconds, and what else is on the screen waits for it.
#ifndef svoStrips_h
#define svoStrips_h

#include "svoOpenGL.h"

#include <algorithm>

namespace svo
{
constexpr int RowsAtOnce = 128;

/// draw(row, rows) for strips of so many rows at most, from `first` up to `end`; OpenGL begins each
/// at once.
template <typename Draw>
void eachStrip(int first, int end, const Draw& draw)
{
  for (int row = first; row < end; row += RowsAtOnce)
  {
    draw(row, std::min(RowsAtOnce, end - row));
    glFlush();
  }
}
}

#endif
