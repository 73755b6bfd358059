// Finds the pixels of svoSilhouettes.h and traces a ray through each of their samples.
#ifndef svoSilhouetteFinder_h
#define svoSilhouetteFinder_h

#include "svoParallel.h"
#include "svoSilhouettes.h"

#include <vector>

#include <glm/vec2.hpp>

namespace svo
{
class LightImages;
class PixelShader;
struct ShadedScene;

/// Finds the pixels where the instance, the depth, or the colour from one facet to the next
/// changes, and traces a ray through each of their samples, at `positions` in a pixel, 0..1, at
/// most 32. `sampled` and `frame` are what `shaded` was rendered with, and to. Other pixels are
/// left to the frame. See Tracer::divideEdges().
void findSilhouettes(const ShadedScene& shaded, const PixelShader& shader,
  const LightImages& sampled, const Frame& frame, const std::vector<glm::vec2>& positions,
  const ParallelFor& parallelFor, Silhouettes& result);
}

#endif
