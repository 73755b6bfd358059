// From sources without triangles to a mesh that carries their octree.
#ifndef svoSourceOctree_h
#define svoSourceOctree_h

#include "svoOctree.h"
#include "svoSource.h"
#include "vtkSVOCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <string>

class vtkPolyData;

namespace svo
{
/// The mesh that carries an octree whose leaves are planes.
struct CarrierOptions
{
  /// It is the contour of the deepest level that has at most that many occupied cells.
  std::size_t cells = 1000000;
  /// Planes' normals point to larger values, the mesh's to smaller ones, as of VTK's contours.
  bool turned = false;
};

struct SourceOctree
{
  BuildStatus status;
  std::uint64_t voxels = 0;
  std::string message; // why there is no octree; else, and if the build was aborted, empty
  Octree octree{};     // as the mesh carries it
  int meshLevel = 0;   // whose cells the mesh is made of
};

/// Builds the octree of a source and makes `mesh` what carries it in its field data: the contour of
/// its planes (svoContour.h), or, where leaves are voxels, the faces of cells of an upper level.
/// Where the memory limit is 0 it is what the machine has available. On failure, and of a source
/// without a surface in its box, the mesh has no cells; in the latter case it carries an empty
/// octree. Throws nothing. `cube`: where the source has one already.
VTKSVOCORE_EXPORT SourceOctree buildSourceOctree(const SurfaceSource& source, BuildOptions options,
  const CarrierOptions& carrier, vtkPolyData* mesh, const Cube* cube = nullptr);
}

#endif
