// The sides of a tile's pyramid in float, with what rounding can do to them allowed for.
#ifndef svoPyramidSides_h
#define svoPyramidSides_h

#include "svoPyramidNodes.h"

#include <cmath>

namespace svo
{
/// What ten roundings to float can do to a linear function of octree coordinates, which begin at 1.
inline double roundingSlack(const glm::dvec4& f)
{
  return (std::abs(f.x) + std::abs(f.y) + std::abs(f.z) + std::abs(f.x + f.y + f.z + f.w)) /
    (1 << 18);
}

/// As functions of octree coordinates minus 1, negative beyond the side.
struct PyramidSides
{
  alignas(16) float x[4], y[4], z[4], w[4];

  explicit PyramidSides(const TilePyramid& pyramid)
  {
    for (int k = 0; k < 4; ++k)
    {
      const glm::dvec4& f = pyramid.side[k];
      x[k] = static_cast<float>(f.x);
      y[k] = static_cast<float>(f.y);
      z[k] = static_cast<float>(f.z);
      w[k] = static_cast<float>(f.x + f.y + f.z + f.w + roundingSlack(f));
    }
  }
};
}

#endif
