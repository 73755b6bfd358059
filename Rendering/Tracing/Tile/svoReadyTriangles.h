// Makes triangles ready for a group of tiles, many at a time.
#ifndef svoReadyTriangles_h
#define svoReadyTriangles_h

#include "svoTriangleGroup.h"

namespace svo
{
/// Projects triangles of one owner, each of them once. They become slots, or, if there are
/// `points`, points where they have a few pixels; those that have to be made ready alone are named
/// in slots.crossing. Behind the last id there is room for a vector of zeros.
void readyTriangles(const Surface& surface, const std::uint32_t* ids, std::size_t count,
  const GroupView& view, std::uint32_t owner, TriangleGroup::Slots& slots, SeenPoints* points);
}

#endif
