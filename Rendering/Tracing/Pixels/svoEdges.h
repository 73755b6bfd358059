// Where a picture changes from one surface, depth or colour to another: the rule for any picture.
#ifndef svoEdges_h
#define svoEdges_h

#include "svoDepthBuffer.h"

#include <cmath>
#include <cstdint>

namespace svo
{
/// True if depth steps between three pixels in a row, in any measure that is linear on planes, in
/// which a pixel is `width` wide. One surface bends little between pixels; a step is of more than a
/// few pixels' size.
template <class Real>
bool depthSteps(Real before, Real here, Real after, Real width)
{
  return std::abs(before - 2 * here + after) > 3 * width;
}

/// True if pixel (x, y) of a picture is an edge. A picture has instance(x, y), NoInstance outside;
/// and changes(x, y), within the instance that the pixel and its four neighbours show.
template <class Picture>
bool isEdge(const Picture& picture, int x, int y)
{
  const std::uint32_t here = picture.instance(x, y);
  return picture.instance(x - 1, y) != here || picture.instance(x + 1, y) != here ||
    picture.instance(x, y - 1) != here || picture.instance(x, y + 1) != here ||
    (here != NoInstance && picture.changes(x, y));
}
}

#endif
