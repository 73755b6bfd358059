// What tracing did, counted: built with VTKSVO_COUNTERS only. Without it SVO_COUNT is nothing, and
// what it is given is not evaluated.
#ifndef svoCounters_h
#define svoCounters_h

#include "vtkSVOOctreeModule.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace svo
{
enum class Counter
{
  NodesVisited,         // by rays that are walked: one for every cell of a node that a ray looks at
  IdleLanes,            // turns of a packet's lanes that only waited for other lanes
  TrianglesTested,      // by rays that are walked: pairs of a ray and a triangle
  TileNodesOpened,      // whose 64 cells were compared with the pyramid of a tile, or of a group
  TileTriangles,        // tested by the rays of a tile together
  TileTrianglesOutside, // left out since they lie outside of the tile's pyramid
  TilesAccepted,        // in whose pyramid nodes lie
  TilesRejected         // in whose pyramid none lies
};
constexpr std::size_t CounterCount = 8;

using Counts = std::array<std::uint64_t, CounterCount>;

/// What a counter counts, in words.
constexpr const char* counterName(std::size_t counter)
{
  constexpr const char* names[CounterCount] = { "nodes visited", "idle lanes", "triangles tested",
    "nodes opened by pyramids", "triangles tested by tiles", "triangles outside of tiles",
    "tiles accepted", "tiles rejected" };
  return names[counter];
}

#ifdef VTKSVO_COUNTERS
/// Adds to a counter; any thread may.
VTKSVOOCTREE_EXPORT void count(Counter counter, std::uint64_t amount);

/// What all threads have counted since the last call. Threads that are counting meanwhile may be
/// seen now or the next time.
VTKSVOOCTREE_EXPORT Counts takeCounts();

#define SVO_COUNT(counter, amount) ::svo::count(::svo::Counter::counter, amount)
#else
#define SVO_COUNT(counter, amount) static_cast<void>(0)
#endif
}

#endif
