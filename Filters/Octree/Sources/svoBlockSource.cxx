#include "svoBlockSource.h"

#include "svoMorton.h"
#include "svoNode.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>

namespace svo
{
namespace
{
/// Index of the octant of a block that a voxel of it lies in.
int octantOf(const glm::ivec3& v)
{
  return (v.x >> NodeLevels & 1) | (v.y >> NodeLevels & 1) << 1 | (v.z >> NodeLevels & 1) << 2;
}

std::uint64_t keyOf(const glm::ivec3& block)
{
  const glm::uvec3 b(block);
  return mortonKey(b.x, b.y, b.z);
}

bool before(const VoxelBlock& block, std::uint64_t key)
{
  return block.key < key;
}
}

void VoxelBlock::add(const glm::ivec3& voxel)
{
  this->bricks[octantOf(voxel)] |= cellBit(svo::cellAt(voxel));
}

bool VoxelBlock::empty() const
{
  return std::all_of(
    std::begin(this->bricks), std::end(this->bricks), [](std::uint64_t mask) { return mask == 0; });
}

std::size_t VoxelBlock::count() const
{
  std::size_t sum = 0;
  for (const std::uint64_t mask : this->bricks)
  {
    sum += static_cast<std::size_t>(countBits(mask));
  }
  return sum;
}

BlockSource::BlockSource(std::vector<VoxelBlock> blocks, const Cube& cube, int level)
  : Blocks(std::move(blocks))
  , Bounds(cube)
  , Voxel(std::ldexp(cube.edge, -level))
{
  assert(level >= 3 && level <= MaximumLevel);
}

glm::ivec3 BlockSource::cellAt(const glm::dvec3& centre, double half) const
{
  // Rounded, since a cell's lower corner need not be a whole number of voxels to the last bit.
  return glm::ivec3(glm::round((centre - half - this->Bounds.origin) / this->Voxel));
}

const VoxelBlock* BlockSource::find(const glm::ivec3& block) const
{
  const std::uint64_t key = keyOf(block);
  const auto found = std::lower_bound(this->Blocks.begin(), this->Blocks.end(), key, before);
  return found != this->Blocks.end() && found->key == key ? &*found : nullptr;
}

bool BlockSource::mayPass(const glm::dvec3& centre, double half) const
{
  const glm::ivec3 low = this->cellAt(centre, half);
  const int edge = static_cast<int>(std::lround(2.0 * half / this->Voxel));
  if (edge >= VoxelBlock::Edge)
  {
    // All blocks below a cell follow each other.
    const std::uint64_t blocks = static_cast<std::uint64_t>(edge / VoxelBlock::Edge);
    const std::uint64_t first = keyOf(low / VoxelBlock::Edge);
    const auto found = std::lower_bound(this->Blocks.begin(), this->Blocks.end(), first, before);
    return found != this->Blocks.end() && found->key - first < blocks * blocks * blocks;
  }
  const VoxelBlock* block = this->find(low / VoxelBlock::Edge);
  if (!block)
  {
    return false;
  }
  // A power of two; below the voxels, where a build is of a deeper level, what is around them.
  const int above = lowestBit(static_cast<std::uint64_t>(std::max(edge, 1)));
  const int first = firstBelow(svo::cellAt(low), above);
  return occupiedBelow(block->bricks[octantOf(low)], first, above) != 0;
}

bool BlockSource::planeIn(const glm::dvec3& centre, double half, SourcePlane& plane) const
{
  const glm::ivec3 voxel = this->cellAt(centre, half);
  const VoxelBlock* block = this->find(voxel / VoxelBlock::Edge);
  if (!block || (block->bricks[octantOf(voxel)] & cellBit(svo::cellAt(voxel))) == 0 ||
    !this->planeOf(voxel, plane))
  {
    return false;
  }
  plane.offset *= this->Voxel;
  return true;
}

int levelOfVoxels(const glm::i64vec3& size)
{
  const std::int64_t most = std::max({ size.x, size.y, size.z });
  int level = 3;
  while (std::int64_t(1) << level < most)
  {
    ++level;
  }
  return level;
}
}
