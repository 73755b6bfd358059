// The nearest triangles of 64 rays that lie close together: an 8x8 tile of pixels or light texels.
//
// The rays of a tile fill a narrow pyramid. Instead of walking each of them through the octree, the
// octree is gone through once for all of them: nodes outside the pyramid are left out, and nodes
// with few triangles (svoShortLists.h) settle the rest, each triangle against all rays side by
// side. The hits are those of LeafGeometry::Triangle, to the last bit: the nearest triangle, of
// equally near ones the one with the smallest id. It pays off while the triangles that a tile sees
// are few; where they are smaller than pixels, walking each ray (svoIntersect.h) does not depend on
// their number.
#ifndef svoIntersectTile_h
#define svoIntersectTile_h

#include "svoOctree.h"
#include "svoPyramidNodes.h"
#include "svoRay.h"
#include "vtkSVOTracingModule.h"

#include <vector>

namespace svo
{
/// The nearest hits of the rays, all inside the pyramid, among the triangles of `nodes`. Results do
/// not depend on the instruction set.
VTKSVOTRACING_EXPORT void intersectTile(const Octree& octree, const TilePyramid& pyramid,
  const std::vector<TileNode>& nodes, const RayBlock& rays, HitBlock& hits);

/// Sets t of rays that hit the triangles that `hits` names, to the same bits as intersectTile().
VTKSVOTRACING_EXPORT void depthsOnTriangles(
  const Octree& octree, const RayBlock& rays, HitBlock& hits);
}

#endif
