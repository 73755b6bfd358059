// From a grid to an octree whose leaves are the grid's voxels.
#ifndef svoVDBOctree_h
#define svoVDBOctree_h

#include "svoParallel.h"
#include "svoSourceOctree.h"
#include "vtkSVOOpenVDBModule.h"

#include <cstddef>
#include <functional>

#include <openvdb/Grid.h>

class vtkPolyData;

namespace svo
{
/// What a grid is taken for.
enum class VDBConversion
{
  Automatic, // grids of class level set are surfaces, all others voxels
  Surface,   // where the values cross a value
  Voxels     // active voxels above a value
};

struct VDBOptions
{
  VDBConversion conversion = VDBConversion::Automatic;
  /// Of voxels: values above it are occupied. Of surfaces: the value there, but of level sets,
  /// whose surface is at 0. Of masks and bools nothing: active and true is occupied.
  double threshold = 0.0;
  std::size_t memoryLimit = 0; // bytes; 0: what the machine has available
  CarrierOptions carrier{};
  ParallelFor parallelFor = serialFor;
  /// Called now and then on the calling thread with 0..1; returning false aborts.
  std::function<bool(double)> progress;
};

/// Metadata that our own writer adds: with it a grid gets the cube again that it was written from.
constexpr char LevelMetadata[] = "vtksvo_level";

/// Whether the grid becomes a surface: planes, not voxels.
VTKSVOOPENVDB_EXPORT bool isSurface(const openvdb::GridBase& grid, VDBConversion conversion);

/// The octree of a grid, attached to its mesh, as buildSourceOctree() does it, with planes as
/// leaves of surfaces, else voxels. Each leaf is a voxel of the grid. Throws nothing.
VTKSVOOPENVDB_EXPORT SourceOctree octreeOfGrid(
  const openvdb::GridBase& grid, const VDBOptions& options, vtkPolyData* mesh);
}

#endif
