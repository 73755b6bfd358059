// Balls as the rays of a tile of 8x8 pixels meet them: the true surface of each, and which is the
// nearest.
#ifndef svoTileBalls_h
#define svoTileBalls_h

#include "svoLocalView.h"
#include "vtkSVOTracingModule.h"

#include <cstdint>

namespace svo
{
/// What the rays of a tile have met so far.
struct TileBalls
{
  static constexpr std::int64_t None = -1;

  // Of 64 bits each, so that loops choose between them side by side.
  alignas(64) double depth[64]; // linear; infinity where there is none
  alignas(64) double t[64];     // a float: the depth minus the base of the ball's LocalView
  alignas(64) std::int64_t ball[64];

  VTKSVOTRACING_EXPORT void clear();

  /// Merges the ball of radius 1 around the origin of the mesh of an octree: for each ray the
  /// nearer of the two points where it meets the ball that is not before the ray's start, if it
  /// is not beyond its end. Of balls that are equally deep the larger `name` stays, so any order
  /// gives the same. Returns the depth beyond which nothing is seen any more.
  VTKSVOTRACING_EXPORT double merge(
    const Octree& octree, const LocalView& local, int tileX, int tileY, std::int64_t name);
};
}

#endif
