// What another grid has at the leaves of an octree: colours of a surface, or of voxels.
#ifndef svoVDBColors_h
#define svoVDBColors_h

#include "svoParallel.h"
#include "svoSourceOctree.h"
#include "vtkSVOOpenVDBModule.h"
#include "vtkSmartPointer.h"

#include <functional>

#include <openvdb/Grid.h>

class vtkDataArray;

namespace svo
{
/// The trilinear values of a grid of numbers, or of vectors of three, at the surface in each leaf
/// of an octree, in their order; wherever either grid lies, whatever its voxels are. Doubles of
/// grids of doubles, else floats. nullptr for grids of other things, and where `progress` returned
/// false.
VTKSVOOPENVDB_EXPORT vtkSmartPointer<vtkDataArray> valuesAtLeaves(const openvdb::GridBase& grid,
  const SourceOctree& built, const ParallelFor& parallelFor,
  const std::function<bool(double)>& progress);
}

#endif
