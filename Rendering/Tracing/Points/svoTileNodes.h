// The visible points of a tile that lie on nodes above the bricks. What is seen of nodes without a
// triangle that faces the viewer is asked for all of them at once.
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
  const SurfaceFrame& frame, const View& view, int firstRun, int lastRun, TilePoints& points);
}

#endif
