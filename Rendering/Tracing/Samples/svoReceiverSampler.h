// Samples of the light on surfaces that VTK draws: as those of traced ones are, from where VTK says
// that they lie.
#ifndef svoReceiverSampler_h
#define svoReceiverSampler_h

#include "svoHits.h"
#include "svoLightImages.h"
#include "svoParallel.h"
#include "svoReceivers.h"
#include "svoScene.h"
#include "svoShadows.h"
#include "svoView.h"
#include "vtkSVOTracingModule.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// What is sampled, of a frame that has been traced, and its settings with the samples that it has.
struct SampledFrame
{
  const Scene& scene;
  const View& view;
  const FrameSettings& settings;
  const Hits& eye;
  const Shadows& shadows;
};

class VTKSVOTRACING_EXPORT ReceiverSampler
{
public:
  /// Begins a frame, in which so much is sampled. `other`: than in the last one, but for what
  /// `more` samples add.
  void begin(const SampledPlanes& sampled, bool other, bool more);
  /// Of what was sampled last.
  SampleNoise noise() const { return this->Images.noise(); }
  /// The frame's; their numbers are there after sample().
  const ReceiverShares& shares() const { return this->Shares; }

  /// Takes samples where surfaces lie that nothing hides which the eye has traced. `same`: they lie
  /// where they did. Returns how many rays there were.
  std::uint64_t sample(const SampledFrame& frame, const ReceiverPlaces& places, bool same,
    const ParallelFor& parallelFor);

private:
  void write(const ReceiverPlaces& places, const ParallelFor& parallelFor);

  ReceiverShares Shares;
  LightImages Images;
  std::vector<std::uint8_t> Filled; // by tile: something was there
  bool More = false;                // what is there is a part of what there is to be
};
}

#endif
