// What the rays of a view hit: all that marks, shading, edges, silhouettes and shadow tests know of
// how it was found.
#ifndef svoHits_h
#define svoHits_h

#include "svoDepthBuffer.h"
#include "svoViewedInstances.h"

#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
/// Later than all that were taken before, of whatever view. Whoever makes something of tiles takes
/// one: it has to be made anew of those that have changed since.
inline std::uint64_t nextTileVersion()
{
  static std::atomic<std::uint64_t> last{ 0 };
  return ++last;
}

/// Read only, but for the view that traces them.
struct Hits
{
  DepthBuffer depth;
  std::vector<std::uint64_t> versions; // of the depth buffer's tiles: when each was another one
  std::uint64_t version = 0;           // the latest of them
  const ViewedInstances& instances;

  bool changedSince(std::size_t tile, std::uint64_t when) const
  {
    assert(tile < this->versions.size());
    return this->versions[tile] > when;
  }
  double base(std::uint32_t instance) const { return this->instances.base(instance); }
};
}

#endif
