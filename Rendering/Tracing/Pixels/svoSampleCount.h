// How many samples of its lights a frame takes, and what more of them have changed.
#ifndef svoSampleCount_h
#define svoSampleCount_h

#include "svoFrame.h"
#include "svoFrameInputs.h"
#include "svoScene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
struct SampleCount
{
  int count;            // 0: nothing is sampled
  bool other = false;   // than the picture has: all of it is to be shaded anew
  bool refined = false; // they are more of what it shows already

  /// `changes`: since the picture with `before` samples.
  SampleCount(
    const Scene& scene, const FrameSettings& settings, const FrameChanges& changes, int before)
    : count(std::min(settings.lightSamples, settings.samplesNow))
  {
    const bool soft = settings.shadowTechnique != ShadowTechnique::None &&
      std::any_of(scene.lights.begin(), scene.lights.end(),
        [](const Light& light) { return light.soft() && light.castShadow; });
    if (!soft && !settings.asksHemispheres())
    {
      this->count = 0;
    }
    else if (changes.none())
    {
      this->refined = this->count > before;
      this->count = std::max(this->count, before);
    }
    this->other = this->count != before;
  }
};

/// RMS of colours (RGBA, of as many pixels), of those with an alpha.
inline double differenceOf(
  const std::vector<std::uint8_t>& before, const std::vector<std::uint8_t>& now)
{
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < std::min(before.size(), now.size()); i += 4)
  {
    for (int c = 0; now[i + 3] != 0 && c < 3; ++c)
    {
      const double difference = static_cast<double>(now[i + c]) - before[i + c];
      sum += difference * difference;
      ++count;
    }
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}
}

#endif
