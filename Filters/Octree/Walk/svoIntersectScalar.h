// Block queries one ray at a time, in float: the reference of the vector kernels.
#ifndef svoIntersectScalar_h
#define svoIntersectScalar_h

#include "svoOctree.h"
#include "svoRay.h"
#include "vtkSVOOctreeModule.h"

namespace svo
{
/// As intersect() of a block in svoIntersect.h.
VTKSVOOCTREE_EXPORT void intersectBlockScalar(
  const Octree& octree, const RayBlock& rays, const TraceOptions& options, HitBlock& hits);
}

#endif
