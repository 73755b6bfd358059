// What the rays of a view hit: all that marks, shading, edges, silhouettes and shadow tests know of
// how it was found.
#ifndef svoHits_h
#define svoHits_h

#include "svoDepthBuffer.h"
#include "svoMergedTiles.h"
#include "svoViewedInstances.h"

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
}

#endif
