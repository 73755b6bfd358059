// Whether a ray meets any triangle but some that are named: those that it starts on.
#ifndef svoOccludedByOthers_h
#define svoOccludedByOthers_h

#include "svoOctree.h"
#include "svoRay.h"
#include "vtkSVOOctreeModule.h"

#include <functional>

namespace svo
{
/// True if the ray meets a triangle in [tMin, tMax] that `skipped` does not name. All triangles are
/// met exactly, in double, whatever leaf geometry the octree is for. The octree must have a surface
/// or be empty.
VTKSVOOCTREE_EXPORT bool occludedByOthers(
  const Octree& octree, const Ray& ray, const std::function<bool(Primitive)>& skipped);
}

#endif
