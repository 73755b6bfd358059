// Building from anything that has a surface: a source says where it passes, an octree of planes
// comes out.
//
// The cube is cut into eight, again and again, wherever the source cannot rule the surface out,
// down to the voxels. So time and memory go with the surface. Cells are visited in Morton order,
// which is the order of the buffer: nothing has to be sorted.
#ifndef svoSource_h
#define svoSource_h

#include "svoBuild.h"

#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// A plane that stands for the surface in a voxel.
struct SourcePlane
{
  glm::dvec3 normal; // unit, outwards
  double offset;     // from the voxel's centre along the normal, in the source's units
};

/// The voxels of a brick, in Morton order.
struct SourceBrick
{
  glm::dvec3 low;      // corner
  double half;         // of a voxel's edge
  std::uint64_t asked; // voxels that planes are wanted of
};

/// A surface that is no mesh. All functions are called by several threads at a time, unless the
/// executor of the build is serial.
class VTKSVOOCTREE_EXPORT SurfaceSource
{
public:
  virtual ~SurfaceSource() = default;

  /// False if no surface passes through the cube, faces included. True is always right, and costs
  /// time. `half`: of the cube's edge.
  virtual bool mayPass(const glm::dvec3& centre, double half) const = 0;

  /// Whether a surface passes through a voxel, and then as which plane.
  virtual bool planeIn(const glm::dvec3& centre, double half, SourcePlane& plane) const = 0;

  /// The same of the voxels of a brick: which of those asked for, with their planes in their
  /// places.
  virtual std::uint64_t planesIn(const SourceBrick& brick, SourcePlane planes[NodeCells]) const;

  /// How far planes have to be seen beyond voxels of that size, for those next to each other to
  /// meet, in 1/16 voxel: 1 to LongestReach.
  virtual std::uint32_t planeReach(double /*half*/) const { return LongestReach; }
};

/// The octree of planes of what of a source lies in the box of modelLow and modelHigh, which has to
/// be finite and somewhere larger than 0. The cube is the box's bounding cube as of a mesh of those
/// bounds; voxels that the box does not touch stay empty. Deterministic for any executor, if the
/// source is. The build stops with TooLarge where it takes more memory than there is.
VTKSVOOCTREE_EXPORT BuildResult build(const SurfaceSource& source, const BuildOptions& options);

/// The same in a cube that is given, so that its voxels are those that the source has already. The
/// source's units and options' box are those of the octree's own coordinates, see
/// options.transform.
VTKSVOOCTREE_EXPORT BuildResult build(
  const SurfaceSource& source, const Cube& cube, const BuildOptions& options);
}

#endif
