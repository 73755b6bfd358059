// From VTK's meshes to the engine's octrees and back: building, and travelling as field data.
#ifndef svoMeshOctree_h
#define svoMeshOctree_h

#include "svoBuild.h"
#include "svoMeshSignature.h"
#include "svoOctree.h"
#include "svoSMPParallel.h"
#include "vtkSVOCoreModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

class vtkPolyData;

namespace svo
{
/// Bounds that say nothing, as VTK orders them.
constexpr std::array<double, 6> NoBounds{ 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };

struct MeshOctreeOptions
{
  int level = 10; // 1..MaximumLevel
  LeafGeometry leafGeometry = LeafGeometry::Automatic;
  /// Bounds of the whole that the mesh is a part of, as VTK orders them; low above high: the mesh
  /// is the whole.
  std::array<double, 6> modelBounds = NoBounds;
  std::size_t memoryLimit = 0; // bytes at the peak of the build; 0: what the machine has available
  std::uint64_t signature = 0; // of the mesh, where it is known
  ParallelFor parallelFor = smpParallelFor();
  /// Called now and then on the calling thread with 0..1; returning false aborts the build.
  std::function<bool(double)> progress;
};

/// Builds the octree of a mesh (polygons of any size and strips, triangulated as VTK's OpenGL
/// mapper does), with its surface, and signs it with the mesh's signature. Does not attach it, does
/// not change the mesh. A mesh without polygons has an empty octree. `message` says why there is no
/// octree, or, although one was built, what was left out of it (points that are not finite); it is
/// empty otherwise and when the build was aborted. On failure `octree` is empty. Throws nothing.
VTKSVOCORE_EXPORT BuildStatus buildMeshOctree(
  vtkPolyData* mesh, const MeshOctreeOptions& options, Octree& octree, std::string& message);

/// True if buildMeshOctree() would choose the cube that the octree of the same mesh has.
VTKSVOCORE_EXPORT bool fitsModel(const Octree& octree, const std::array<double, 6>& modelBounds);

/// Name of the field-data array (unsigned bytes, the layout of svoLayout.h) that an octree travels
/// in.
constexpr char OctreeArrayName[] = "SparseVoxelOctree";

/// Puts a copy of the octree's bytes into the mesh's field data in place of any other.
VTKSVOCORE_EXPORT void attachOctree(vtkPolyData* mesh, const Octree& octree);

/// Field data of one value each that says what an octree is like, for people: "SVO Level", "SVO
/// Voxels", "SVO Memory" (KiB) and "SVO Build Time" (s).
VTKSVOCORE_EXPORT void attachStatistics(vtkPolyData* mesh, const Octree& octree, double buildTime);

/// Takes the octree off the mesh's field data, if there is one.
VTKSVOCORE_EXPORT void detachOctree(vtkPolyData* mesh);

enum class Attached
{
  Found,
  None,
  Foreign, // it was built from another mesh, or from this one before it changed
  Damaged  // message says how
};

/// Opens the octree that travels on a mesh, with its surface. Only Found yields an octree. None and
/// Foreign are ordinary states downstream of other filters and have no message. The octree has a
/// copy of the array's bytes: writing to the array changes no open octree. Does not change
/// the mesh. While the octree is open somewhere, and the array was not modified, opening it again
/// costs a look-up.
VTKSVOCORE_EXPORT Attached openAttachedOctree(
  vtkPolyData* mesh, Octree& octree, std::string& message);

/// True if the mesh carries an octree of a surface that is no mesh: its polygons are not the
/// surface.
VTKSVOCORE_EXPORT bool carriesPlanes(vtkPolyData* mesh);

/// A sentence for users about why there is no octree to open; empty if it was found.
VTKSVOCORE_EXPORT std::string describe(Attached state, const std::string& message);

/// Bytes of memory that this process can still expect to get, 0 if unknown.
VTKSVOCORE_EXPORT std::size_t availableMemory();
}

#endif
