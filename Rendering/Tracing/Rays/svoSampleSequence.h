// Samples of a square that fill it evenly however many are taken, and in another order of the same
// evenness for each pixel, so that what few of them leave of error looks like fine grain.
//
// Number i is the i-th point of the (0, 2)-sequence whose coordinates are the radical inverse and
// Sobol's second dimension (I. Sobol, 1967; Kollig and Keller, "Efficient Multidimensional
// Sampling", 2002), scrambled once for all pixels (A. Owen, "Randomly Permuted (t,m,s)-Nets", 1995)
// because its points lie along diagonals, where edges at 45 degrees have thrice the error of
// others; and rotated by what a blue-noise mask of 64 x 64 pixels has there (R. Ulichney,
// "The void-and-cluster method for dither array generation", 1993; rotations: Cranley and
// Patterson, 1976). All is computed in whole numbers: a sample is a function of the view, the
// pixel, the stream and the index alone, the same bits everywhere.
#ifndef svoSampleSequence_h
#define svoSampleSequence_h

#include "svoView.h"
#include "vtkSVOTracingModule.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace svo
{
/// A point of the unit square, in fractions of 2^32.
struct SquarePoint
{
  std::uint32_t u, v;

  /// [0, 1)^2.
  glm::vec2 position() const
  {
    constexpr float Unit = 1.0f / (1 << 24);
    return { Unit * static_cast<float>(this->u >> 8), Unit * static_cast<float>(this->v >> 8) };
  }
  /// Rotated on the torus.
  SquarePoint operator+(const SquarePoint& by) const { return { this->u + by.u, this->v + by.v }; }
};

/// Swaps the halves of intervals of 1/1, 1/2, 1/4 ... of a coordinate, of each interval or not:
/// what is spread evenly stays so. Laine and Karras, "Stratified Sampling for Stochastic
/// Transparency", 2011.
inline std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed)
{
  const auto reversed = [](std::uint32_t bits)
  {
    bits = (bits >> 1 & 0x55555555u) | (bits & 0x55555555u) << 1;
    bits = (bits >> 2 & 0x33333333u) | (bits & 0x33333333u) << 2;
    bits = (bits >> 4 & 0x0f0f0f0fu) | (bits & 0x0f0f0f0fu) << 4;
    bits = (bits >> 8 & 0x00ff00ffu) | (bits & 0x00ff00ffu) << 8;
    return bits >> 16 | bits << 16;
  };
  std::uint32_t bits = reversed(x);
  bits ^= bits * 0x3d20adeau;
  bits += seed;
  bits *= seed >> 16 | 1u;
  bits ^= bits * 0x05526c56u;
  bits ^= bits * 0x53a22864u;
  return reversed(bits);
}

/// Number `index` of the sequence.
inline SquarePoint sequencePoint(std::uint32_t index)
{
  SquarePoint point{ 0, 0 };
  std::uint32_t a = 1u << 31, b = 1u << 31;
  for (std::uint32_t bits = index; bits != 0; bits >>= 1)
  {
    point.u ^= bits & 1 ? a : 0;
    point.v ^= bits & 1 ? b : 0;
    a >>= 1;
    b ^= b >> 1;
  }
  // Of 250 pairs of seeds the one whose errors at straight edges in a disc are the smallest, over
  // twelve directions and 4 to 256 samples.
  return { scrambled(point.u, 0x5ad45edbu), scrambled(point.v, 0x774758bdu) };
}

inline std::vector<SquarePoint> firstPoints(int count)
{
  std::vector<SquarePoint> points;
  points.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
  {
    points.push_back(sequencePoint(static_cast<std::uint32_t>(i)));
  }
  return points;
}

/// Where a view's picture lies in the mask, 0..63: elsewhere for another view, so that grain does
/// not stand still on the screen while what it lies on moves. Of where the eye is and looks, and
/// how wide, to eight digits: not of how floats round, nor of what is near or far.
VTKSVOTRACING_EXPORT glm::ivec2 noiseShift(const View& view);

/// The rotation of a pixel of the mask. `stream`: of samples that have nothing to do with another
/// stream's, as those of two lights.
VTKSVOTRACING_EXPORT SquarePoint pixelRotation(int x, int y, unsigned stream);

/// The rotations of a view's pixels, of one stream.
class PixelRotations
{
public:
  PixelRotations(const View& view, unsigned stream)
    : Shift(noiseShift(view))
    , Stream(stream)
  {
  }
  /// Of the pixel that a place of the image lies in.
  SquarePoint at(double x, double y) const
  {
    return pixelRotation(this->Shift.x + static_cast<int>(std::floor(x)),
      this->Shift.y + static_cast<int>(std::floor(y)), this->Stream);
  }

private:
  glm::ivec2 Shift;
  unsigned Stream;
};
}

#endif
