// Takes the samples of a frame's lights, tile by tile.
#ifndef svoLightSampler_h
#define svoLightSampler_h

#include "svoFrame.h"
#include "svoLightImages.h"
#include "svoParallel.h"
#include "svoPatchShadows.h"
#include "svoShadedScene.h"
#include "svoShadedTiles.h"

namespace svo
{
/// Adds the samples of stale tiles to a frame's images, or begins them anew, and notes what the
/// answers hang on. Counts its rays.
void sampleLights(const ShadedScene& shaded, const PatchShadows& points,
  const ParallelFor& parallelFor, ShadedTiles& kept, LightImages& images,
  FrameStatistics& statistics);
}

#endif
