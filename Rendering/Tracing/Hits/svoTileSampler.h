// Further rays of a view whose hits are there, for those who smooth edges and find silhouettes.
#ifndef svoTileSampler_h
#define svoTileSampler_h

#include "svoRay.h"

#include <cstddef>
#include <cstdint>

namespace svo
{
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
