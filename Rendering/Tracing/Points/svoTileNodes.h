// The visible points of a tile that lie on nodes above the bricks. Lines of sight to nodes without
// a triangle that faces the viewer are traced all at once.
//
// The results are those of surfacePoint() (svoSurfacePoint.h), bit for bit.
#ifndef svoTileNodes_h
#define svoTileNodes_h

#include "svoTilePoints.h"

namespace svo
{
/// Sets facets, normals and colours of the runs on nodes among runs [firstRun, lastRun), which are
/// of one instance; its octree has a surface, and the points are placed.
void lookAtNodes(
  const SurfaceMatrices& frame, const View& view, int firstRun, int lastRun, TilePoints& points);
}

#endif
