// Voxels that somebody has already, in blocks of 8x8x8, as a source: those of a sparse grid.
//
// The octree's voxels are the grid's own, so nothing is resampled. Which of them may be occupied
// stands in masks; blocks without any are not there. Whether one is, and as which plane, a subclass
// says when it is asked.
#ifndef svoBlockSource_h
#define svoBlockSource_h

#include "svoSource.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
struct VTKSVOOCTREE_EXPORT VoxelBlock
{
  static constexpr int Edge = 8; // voxels

  std::uint64_t key = 0; // Morton key of the block's place, in blocks from the cube's corner
  std::uint64_t
    bricks[8] = {}; // the 4x4x4 voxels of each octant, octants and voxels in Morton order

  /// Voxel of the block, 0..7 along each axis.
  void add(const glm::ivec3& voxel);
  bool empty() const;
  std::size_t count() const;
};

/// Which blocks there are, and where.
class VTKSVOOCTREE_EXPORT BlockSource : public SurfaceSource
{
public:
  /// `blocks`: in ascending order of their keys, each once; inside of the cube, of 2^level voxels
  /// along an edge, level 3 to MaximumLevel.
  BlockSource(std::vector<VoxelBlock> blocks, const Cube& cube, int level);

  bool mayPass(const glm::dvec3& centre, double half) const override;
  bool planeIn(const glm::dvec3& centre, double half, SourcePlane& plane) const override;

protected:
  /// Whether a voxel that has a bit is occupied, and then as which plane. `voxel`: its place in the
  /// cube. The offset is in voxels.
  virtual bool planeOf(const glm::ivec3& voxel, SourcePlane& plane) const = 0;

private:
  glm::ivec3 cellAt(const glm::dvec3& centre, double half) const;
  const VoxelBlock* find(const glm::ivec3& block) const;

  std::vector<VoxelBlock> Blocks;
  Cube Bounds;
  double Voxel; // edge
};

/// The deepest level of a cube that holds `size` voxels along each axis, at least 3.
VTKSVOOCTREE_EXPORT int levelOfVoxels(const glm::i64vec3& size);
}

#endif
