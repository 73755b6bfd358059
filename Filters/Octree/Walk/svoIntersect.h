// Ray queries on an octree: nearest hit of one ray and of a block of 64, any hit of one ray.
#ifndef svoIntersect_h
#define svoIntersect_h

#include "svoOctree.h"
#include "svoRay.h"
#include "vtkSVOOctreeModule.h"

#include <functional>

namespace svo
{
/// The nearest hit of one ray, in double precision. Closed cells build, half-open cells trace: a
/// ray in the plane between two cells belongs to the upper one.
VTKSVOOCTREE_EXPORT Hit intersect(
  const Octree& octree, const Ray& ray, const TraceOptions& options);

/// True if the ray hits anything in [tMin, tMax].
VTKSVOOCTREE_EXPORT bool occluded(
  const Octree& octree, const Ray& ray, const TraceOptions& options);

/// True if the ray meets a triangle in [tMin, tMax] that `skipped` does not name. All triangles are
/// met exactly, in double, whatever leaf geometry the octree is for. The octree must have a surface
/// or be empty.
VTKSVOOCTREE_EXPORT bool occludedByOthers(
  const Octree& octree, const Ray& ray, const std::function<bool(Primitive)>& skipped);

/// The nearest hits of 64 rays, in float. Results do not depend on the other rays of the block, nor
/// on the instruction set that was chosen at run time.
VTKSVOOCTREE_EXPORT void intersect(
  const Octree& octree, const RayBlock& rays, const TraceOptions& options, HitBlock& hits);

/// As intersect() of a block, one ray at a time: the reference of the vector kernels.
VTKSVOOCTREE_EXPORT void intersectBlockScalar(
  const Octree& octree, const RayBlock& rays, const TraceOptions& options, HitBlock& hits);

/// Name of the instruction set that the block queries run on, and lanes of a vector.
VTKSVOOCTREE_EXPORT const char* instructionSet();
VTKSVOOCTREE_EXPORT int vectorLanes();
}

#endif
