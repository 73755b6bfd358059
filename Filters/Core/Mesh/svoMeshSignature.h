// The hash of a mesh that an octree carries, so that the mesh it was built from is recognised.
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
/// Computed once per change: the hashes of points and cells are remembered by their identity and
/// modification time. Code that edits them in place calls Modified() on them or on the mesh. Does
/// not change the mesh; may be called from any thread.
VTKSVOCORE_EXPORT std::uint64_t meshSignature(vtkPolyData* mesh);

/// Tells that `to` is a shallow copy that was made of `from` right now, so that its signature is
/// known. (Any other copy is younger than what is remembered, so it is hashed once.)
VTKSVOCORE_EXPORT void copySignature(vtkPolyData* from, vtkPolyData* to);

/// How many arrays have been hashed so far in this process, for tests.
VTKSVOCORE_EXPORT std::uint64_t numberOfHashedArrays();
}

#endif
