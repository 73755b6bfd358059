// Voxelisation: which voxels of which bricks a triangle touches.
#ifndef svoVoxelize_h
#define svoVoxelize_h

#include "svoLattice.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// One triangle in one brick.
struct BrickRecord
{
  std::uint64_t key;      // Morton key of the brick
  std::uint64_t mask;     // the brick's voxels that the triangle touches, never 0
  std::uint32_t triangle; // id
};

/// Appends the records of a triangle whose vertices are on the lattice, in any order, each brick
/// at most once.
void voxelizeTriangle(
  const glm::ivec3 vertices[3], std::uint32_t id, int level, std::vector<BrickRecord>& records);
}

#endif
