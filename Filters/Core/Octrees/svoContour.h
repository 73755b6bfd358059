// The surface that the planes of an octree describe, as quads that share vertices with normals.
#ifndef svoContour_h
#define svoContour_h

#include "svoBuild.h"
#include "svoOctree.h"
#include "vtkSVOCoreModule.h"

class vtkPolyData;

namespace svo
{
/// Makes points, normals and quads of a mesh, in the octree's local coordinates, of an octree of
/// planes. The first cellsOfLevel() (svoCellPlanes.h) points are the cells' vertices in their
/// order, each near its cell's plane and in its cell, or, at the border of the box, up to half a
/// cell beside it. Deterministic.
///
/// `level`: whose cells have a vertex each. `built`: what the octree was built with; the surface
/// ends at its box, and its border is moved there. `turned`: false where the quads, and the
/// normals, look to where planes' normals point, true where they look to the other side.
///
/// A corner of cells lies before or behind the surface by the mean of what the planes of the cells
/// around it say. A quad joins the four cells around each edge of a cell whose corners disagree, so
/// that quads meet (Gibson, "Constrained Elastic Surface Nets", 1998). Cells that have a part of
/// the surface but no corner behind it, as in sheets that are thinner than a cell, get a piece of
/// their plane.
VTKSVOCORE_EXPORT void makeContour(
  const Octree& octree, int level, const BuildOptions& built, bool turned, vtkPolyData* mesh);
}

#endif
