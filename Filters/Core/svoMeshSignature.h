// What an octree remembers of the mesh it was built from.
#ifndef svoMeshSignature_h
#define svoMeshSignature_h

#include "vtkSVOCoreModule.h"

#include <cstdint>

class vtkPolyData;

namespace svo
{
/// 64-bit hash of the points (in their own precision), the polygons, the strips and the number of
/// vertices and lines before them; never 0. Point and cell arrays are not part of it: recolouring
/// a mesh keeps its octree. Independent of the integer width that the cells are stored in and of
/// threads.
///
/// Computed once per change: the hashes of points and cells are remembered by the identity and
/// modification time of the vtkPoints and vtkCellArrays. So whoever edits points in place calls
/// Modified() on the vtkPoints, as VTK's mappers need it too. Does not change the mesh; may be
/// called from any thread.
VTKSVOCORE_EXPORT std::uint64_t meshSignature(vtkPolyData* mesh);

/// How many arrays have been hashed so far in this process, for tests.
VTKSVOCORE_EXPORT std::uint64_t numberOfHashedArrays();
}

#endif
