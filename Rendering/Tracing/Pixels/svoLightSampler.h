// Takes the samples of a frame's lights, tile by tile.
#ifndef svoLightSampler_h
#define svoLightSampler_h

#include "svoFrame.h"
#include "svoHemisphereRays.h"
#include "svoKeptTiles.h"
#include "svoLightImages.h"
#include "svoLightShadow.h"
#include "svoParallel.h"
#include "svoPatchShadows.h"
#include "svoSampleSums.h"
#include "svoShadedScene.h"
#include "svoSkyGradient.h"

namespace svo
{
/// What of the points of a query is closed off around them, 0..1.
void sampleOcclusion(const ShadowQuery& query, const HemisphereRays& rays, SampleSums& closed);
/// What they see of the sky, of SkyGradient::brightest(): three sums, of red, green and blue. The
/// query's are the first.
void sampleSky(
  const ShadowQuery& query, const HemisphereRays& rays, const SkyGradient& sky, SampleSums* seen);

/// Adds the samples of stale tiles to a frame's images, or begins them anew, and notes what the
/// answers hang on. Counts its rays.
void sampleLights(const ShadedScene& shaded, const PatchShadows& points,
  const ParallelFor& parallelFor, KeptTiles& kept, LightImages& images,
  FrameStatistics& statistics);
}

#endif
