// Values of an octree's leaves: a field-data array of the mesh that carries it, of any type, with a
// tuple for each voxel in the octree's order. Colour maps, files and ParaView take it as the array
// that it is.
//
// The mesh has cell data of the same name, means of the voxels around each quad, so that a mapper
// can be told to colour by it, and whoever draws the mesh shows about the same.
#ifndef svoLeafValues_h
#define svoLeafValues_h

#include "svoOctree.h"
#include "svoOctreeCells.h"
#include "svoParallel.h"
#include "svoSourceOctree.h"
#include "vtkSVOCoreModule.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

class vtkDataArray;
class vtkPolyData;

namespace svo
{
/// Calls visit(voxel, point) for each voxel of an octree of planes, by several threads: its number
/// in the octree's order and the point of its plane that is nearest to its centre, as far as that
/// lies in the voxel; octree's own coordinates. `progress`, 0..1, is called on the calling thread;
/// returns false where it does.
VTKSVOCORE_EXPORT bool forEachLeaf(const Octree& octree, const ParallelFor& parallelFor,
  const std::function<bool(double)>& progress,
  const std::function<void(std::size_t, const glm::dvec3&)>& visit);

/// Gives the mesh of an octree that was built of a source an array that has a name and a tuple for
/// each voxel. The mesh's cell data of that name tells the range of all voxels as its own.
VTKSVOCORE_EXPORT void attachLeafValues(
  vtkPolyData* mesh, const SourceOctree& built, vtkDataArray* values);

/// Copies of all values of the octree that a mesh carries, of the same types and names, without
/// tuples yet, each with what it is copied from.
using LeafArrays = std::vector<std::pair<vtkDataArray*, vtkSmartPointer<vtkDataArray>>>;
LeafArrays emptyCopiesOfLeafValues(vtkPolyData* mesh);

/// The number of the first voxel in a cell of an octree of planes, whose values stand for it.
vtkIdType firstLeaf(const Octree& octree, const OctreeCell& cell);

/// The values of that name of the octree that a mesh carries; nullptr if there are none.
VTKSVOCORE_EXPORT vtkDataArray* leafValues(vtkPolyData* mesh, const char* name);
}

#endif
