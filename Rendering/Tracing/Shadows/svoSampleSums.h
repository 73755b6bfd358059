// What samples have found of the points of a patch: sums, to which more samples of the same add.
#ifndef svoSampleSums_h
#define svoSampleSums_h

#include "svoTilePatch.h"

#include <cmath>

namespace svo
{
/// What a sample counts, 0..1, in 4096ths: sums of up to 4096 of them are exact in float, whatever
/// their order and in however many steps they are taken.
inline float sampleShare(float share)
{
  return std::floor(4096.0f * share + 0.5f) / 4096.0f;
}

/// By pixel. Where `count` is 0 no sample counts, and `sum` is what is known without any.
struct SampleSums
{
  int first = 0; // number of the first sample to be taken
  alignas(64) float sum[TilePatch::Most];
  alignas(64) float count[TilePatch::Most];

  void set(int pixel, float ofSamples, float samples)
  {
    this->sum[pixel] = ofSamples;
    this->count[pixel] = samples;
  }
  float mean(int pixel) const
  {
    return this->count[pixel] > 0.0f ? this->sum[pixel] / this->count[pixel] : this->sum[pixel];
  }
};
}

#endif
