// Building: triangles in, one sparse voxel octree out.
#ifndef svoBuild_h
#define svoBuild_h

#include "svoLayout.h"
#include "svoParallel.h"
#include "svoSurface.h"
#include "vtkSVOOctreeModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// A mesh in its local coordinates, already cut into triangles. Vertices need not be welded,
/// triangles may be degenerate. Triangles with a point that is not finite, or with a coordinate
/// beyond 1e290, are dropped and counted.
struct TriangleMesh
{
  const glm::dvec3* points = nullptr;
  std::size_t pointCount = 0;
  const glm::uvec3* triangles = nullptr;
  std::size_t triangleCount = 0;
};

struct BuildOptions
{
  int level = 10; // 1..MaximumLevel
  LeafGeometry leafGeometry = LeafGeometry::Automatic;
  /// Bounds of what the mesh is a part of, local coordinates: the cube is then that of the whole,
  /// so that all parts have the same voxels. Low above high: the mesh is all there is.
  glm::dvec3 modelLow{ 1.0 };
  glm::dvec3 modelHigh{ -1.0 };
  /// From the octree's own coordinates to the local coordinates, see TRANSFORMS in svoLayout.h;
  /// isTransform() has to hold. 1: they are the same. Only where the octree is one of planes.
  glm::dmat4 transform{ 1.0 };
  /// The build is refused before it allocates if it is expected to need more than this at its
  /// peak. 0: no limit.
  std::size_t memoryLimit = 0; // bytes
  ParallelFor parallelFor = serialFor;
  /// Called now and then on the calling thread with 0..1; returning false aborts the build.
  std::function<bool(double)> progress;
};

enum class BuildStatus
{
  Built,
  Aborted,
  TooLarge, // `message` names the size
  BadInput  // level out of range, or more triangles than an id can name
};

struct BuildResult
{
  BuildStatus status = BuildStatus::BadInput;
  std::string message;
  std::shared_ptr<std::byte> data;  // the layout of svoLayout.h; signature, pointCount, cellCount
                                    // and meshBounds of the header are left 0 for the caller
  std::size_t size = 0;             // bytes
  std::size_t droppedTriangles = 0; // with a NaN or infinite vertex
};

/// Conservative and exact: vertices are snapped to a lattice of 1/256 voxel, every voxel's closed
/// box grown by one lattice unit is tested against the triangle in integers (Schwarz & Seidel 2010:
/// plane, three projections, box), touching counts. So every ray that hits a triangle hits a voxel.
/// The octree's cube is the mesh's bounding cube with the mesh in its middle (half a voxel beside
/// it where the mesh is flat, so that it fills one layer of voxels), two lattice units of margin on
/// the longest axis; a mesh whose points all coincide gets a cube of a size that its coordinates
/// can resolve, and no voxel is smaller than the steps between doubles where the mesh lies.
/// Deterministic: the same bytes for any executor and instruction set. Time grows with the bricks
/// that the triangles touch, never with the volume of their boxes.
VTKSVOOCTREE_EXPORT BuildResult build(const TriangleMesh& mesh, const BuildOptions& options);

/// Peak bytes that build() is expected to need, from the triangles' areas in voxels. Tests hold it
/// to a third of what is taken.
VTKSVOOCTREE_EXPORT std::size_t estimateBuildMemory(const TriangleMesh& mesh, int level);

/// The cube that build() chooses for a mesh: its lower corner and edge.
struct Cube
{
  glm::dvec3 origin;
  double edge;
};
VTKSVOOCTREE_EXPORT Cube boundingCube(const TriangleMesh& mesh, int level);

/// The same from bounds.
VTKSVOOCTREE_EXPORT Cube boundingCube(const glm::dvec3& low, const glm::dvec3& high, int level);

/// The surface in the octree coordinates of a given header. Points that are not finite are put at
/// the cube's corner (no list names their triangles). `cells` is copied as it is.
VTKSVOOCTREE_EXPORT std::shared_ptr<const Surface> makeSurface(const TriangleMesh& mesh,
  std::vector<std::uint32_t> cells, const Header& header, const ParallelFor& parallelFor);
}

#endif
