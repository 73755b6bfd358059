// The surface that the planes of an octree describe, as quads that share vertices with normals.
#ifndef svoContour_h
#define svoContour_h

#include "svoBox.h"
#include "svoOctree.h"
#include "svoParallel.h"
#include "vtkSVOCoreModule.h"

class vtkPolyData;

namespace svo
{
struct ContourOptions
{
  int level = 1; // whose cells have a vertex each
  /// Where the surface ends, octree's own frame: its border is moved there.
  Box box{};
  /// False: the quads, and the normals, look to where planes' normals point. True: to the other
  /// side.
  bool turned = false;
  ParallelFor parallelFor = serialFor;
};

/// Makes points, normals and quads of a mesh, in the octree's local frame, of an octree of planes.
/// The first cellsOfLevel() (svoCellPlanes.h) points are the cells' vertices in their order, each
/// near its cell's plane and in its cell, or, at the border of the box, up to half a cell beside
/// it. Deterministic.
///
/// A corner of cells lies before or behind the surface by the mean of what the planes of the cells
/// around it say. A quad joins the four cells around each edge of a cell whose corners disagree, so
/// that quads meet (Gibson, "Constrained Elastic Surface Nets", 1998). Cells that have a part of
/// the surface but no corner behind it, as in sheets that are thinner than a cell, get a piece of
/// their plane.
VTKSVOCORE_EXPORT void makeContour(
  const Octree& octree, const ContourOptions& options, vtkPolyData* mesh);
}

#endif
