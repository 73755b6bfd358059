// From sources without triangles to a mesh that carries their octree: a coarse hull of the surface.
#ifndef svoSourceOctree_h
#define svoSourceOctree_h

#include "svoOctree.h"
#include "svoSource.h"
#include "vtkSVOCoreModule.h"

#include <cstdint>
#include <string>

class vtkPolyData;

namespace svo
{
/// The deepest octree level whose cells the hull is made of: some thousand quads.
constexpr int HullLevel = 5;

struct SourceOctree
{
  BuildStatus status;
  std::uint64_t voxels = 0;
  std::string message; // why there is no octree; else, and if the build was aborted, empty
  Octree octree{};     // as the hull carries it
};

/// Builds the octree of a source and makes `hull` the surface of its cells of level HullLevel, or
/// of the voxels where there are fewer levels, with the octree in its field data. Where the memory
/// limit is 0 it is what the machine has available. On failure, and of a source without a surface
/// in its box, the hull has no cells; in the latter case it carries an empty octree. Throws
/// nothing.
/// `cube`: where the source has one already.
VTKSVOCORE_EXPORT SourceOctree buildSourceOctree(
  const SurfaceSource& source, BuildOptions options, vtkPolyData* hull, const Cube* cube = nullptr);
}

#endif
