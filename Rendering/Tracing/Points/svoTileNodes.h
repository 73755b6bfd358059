// The visible points of a patch that lie on nodes above the bricks. Lines of sight to nodes without
// a triangle that faces the viewer are traced all at once.
//
// The results are those of surfacePoint() (svoReferencePoint.h), bit for bit.
#ifndef svoTileNodes_h
#define svoTileNodes_h

#include "svoTilePatch.h"

#include <cstdint>

namespace svo
{
/// Sets facets, normals and colours of those points of a patch that are in `lanes`, all on nodes;
/// the octree has a surface.
void lookAtNodes(const SurfaceMatrices& frame, std::uint64_t lanes, TilePatch& patch);
}

#endif
