// Queries of blocks of 64 rays.
#include "svoIntersect.h"

#include "svoIntersectScalar.h"

namespace svo
{
void intersect(
  const Octree& octree, const RayBlock& rays, const TraceOptions& options, HitBlock& hits)
{
  intersectBlockScalar(octree, rays, options, hits);
}

std::uint64_t occluded(const Octree& octree, const RayBlock& rays, const TraceOptions& options)
{
  return occludedBlockScalar(octree, rays, options);
}

const char* instructionSet()
{
  return "scalar";
}

int vectorLanes()
{
  return 1;
}
}
