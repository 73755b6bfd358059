// What the rays of a view hit: all that marks, shading, edges, silhouettes and shadow tests know of
// how it was found.
#ifndef svoHits_h
#define svoHits_h

#include "svoDepthBuffer.h"
#include "svoMergedTiles.h"
#include "svoViewedInstances.h"

#include <cstddef>
#include <cstdint>

namespace svo
{
/// Read only, but for the view that traces them.
struct Hits
{
  DepthBuffer depth;
  MergedTiles tiles; // which of the depth buffer's are not what they were
  const ViewedInstances& instances;

  double base(std::uint32_t instance) const { return this->instances.base(instance); }
};

/// What 64 rays anywhere in a tile see.
struct TileSamples
{
  double x[64]; // points of the image, all in one tile
  double y[64];
  double t[64]; // linear depth
  std::uint32_t instance[64];
  Primitive primitive[64];
};

/// Traces further rays of a view, after its hits.
class TileSampler
{
public:
  virtual ~TileSampler() = default;
  /// Traces points of a tile, `count` times 64, through all instances.
  virtual void sample(int tileX, int tileY, TileSamples* samples, std::size_t count) const = 0;
};
}

#endif
