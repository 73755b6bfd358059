// Means of few samples a pixel, taken over the surface around it as far as it does not show.
//
// Around a pixel there are squares of 1, 3, 5, 9 and 17 pixels' edge. Of each the mean is that of
// the samples of all pixels in it that are of the same surface: with about the same normal, and
// near to the plane of the pixel in the middle. Whose they are does not matter: blocks of one
// surface have no seams. The wider a square is the less its mean varies by chance, and the more it
// is off where the light changes. The widest one is taken in which, as in all narrower ones, pixels
// differ from their mean by no more than chance explains, and whose mean lies in the intervals of
// the narrower ones: the intersection of confidence intervals (Goldenshluger and Nemirovski, 1997;
// Katkovnik, "A New Method for Varying Adaptive Bandwidth Selection", 1999). The former tells
// edges, the latter gradients. More samples a pixel make chance explain less, so squares get
// narrower: what is filtered goes to what is not.
//
// How far a penumbra reaches would follow from where rays are blocked, too (Mehta et al.,
// "Axis-Aligned Filtering for Interactive Sampled Soft Shadows", 2012). But of rays that ask
// whether anything is in the way what they meet depends on their company; the shares do not.
#ifndef svoLightFilter_h
#define svoLightFilter_h

#include "svoRawArray.h"
#include "vtkSVOTracingModule.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace svo
{
/// Of pixels, row by row. A surface's depth is 1/t in perspective views, in which it is linear in
/// the pixel on a plane, and t in parallel ones.
struct SampledSurfaces
{
  RawArray<float> normalX, normalY, normalZ;
  RawArray<float> depth;
  RawArray<float> depthX, depthY; // how it grows on the facet, a pixel
  RawArray<float> pixel; // what it is for a pixel's width off the facet; negative: there is none

  /// There are none at all then.
  void resize(std::size_t pixels);
  /// There is none whose light is sampled.
  void remove(std::size_t first, std::size_t count);
};

namespace LightFilter
{
/// What is sampled, of which each pixel has so many samples, spread evenly: errors of the sequence
/// fall as N to the -0.7, so variances by N^0.4 more than those of independent samples.
struct Evenness
{
  float samples;
  /// Of how many N is twice the number that see what is less, the light or what blocks it: that may
  /// be anywhere all around, and of 32 samples one or two fall on it as they like. A light's disc
  /// is cut at an edge; there N is all.
  float ofShare;

  static Evenness allAround(int samples)
  {
    return { static_cast<float>(samples), 2.0f * static_cast<float>(samples) };
  }
  static Evenness ofLight(int samples) { return { static_cast<float>(samples), 1e30f }; }
};

/// How samples vary by chance: by no more than m (1 - m) where their mean is m, as if one more were
/// in between. Of roots all machines have the same bits.
inline float spreadOf(float sum, float count, const Evenness& even)
{
  const float about = (sum + 0.5f) / (count + 1.0f);
  const float rest = 1.0f - about;
  const float n = std::max(std::min(even.ofShare * std::min(about, rest), even.samples), 1.0f);
  return std::max(about * rest, 0.0f) / std::sqrt(std::sqrt(std::sqrt(n * n * n)));
}

/// Of the mean of `count` of them.
inline float varianceOf(float sum, float count, const Evenness& even)
{
  return spreadOf(sum, count, even) / std::max(count, 1.0f);
}

constexpr int Reach = 8;   // pixels beyond the one in the middle
constexpr int Margin = 16; // pixels beside an image, without surfaces
constexpr int Block = 64;  // pixels along an edge of what is filtered at once

/// A plane of an image: sums and counts of samples, each of which is 0..1. Both are defined where
/// surfaces are.
struct Pixels
{
  const SampledSurfaces& surfaces;
  std::size_t stride;
  const float *sum, *count;
  float* mean;     // is set,
  float* variance; // and that which chance gives it
  Evenness even;
};

/// Of `rows` rows of a block whose first pixel is number `first` in all arrays. Pixels without
/// samples get 0.
VTKSVOTRACING_EXPORT void filter(const Pixels& pixels, std::size_t first, int rows);
}
}

#endif
