// The blocks of 8x8x8 voxels of a grid that are active and above a threshold: of its leaf nodes,
// and of its active tiles.
#ifndef svoVDBBlocks_h
#define svoVDBBlocks_h

#include "svoBlockSource.h"
#include "svoBuildStopped.h"
#include "svoMeshOctree.h"
#include "svoVDBOctree.h"
#include "svoWork.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include <openvdb/openvdb.h>

namespace svo
{
/// What an octree and its build take of a voxel that is occupied, about: see svoSource.cxx.
constexpr double BytesAVoxel = 16.0;

/// A place in index space, and the block that has it.
struct PlacedBlock
{
  openvdb::Coord place; // in blocks
  VoxelBlock block;
};

/// Throws where so many things of some bytes each are beyond a limit. `advice`: what else to do.
inline void refuseTooMany(double count, const std::string& things, double bytesOfOne,
  std::size_t limit, const std::string& advice = {})
{
  if (count > 0x7fffffff || count * bytesOfOne > static_cast<double>(limit))
  {
    char digits[32];
    std::snprintf(digits, sizeof(digits), "%.0f ", count);
    throw BuildStopped{ BuildStatus::TooLarge,
      "it has " + (digits + things) + ", and an octree of them needs about " +
        bytesAsText(count * bytesOfOne) + ", more memory than the limit of " +
        bytesAsText(static_cast<double>(limit)) + advice };
  }
}

/// The limit that is set; else what there is, but no more than `most`.
inline std::size_t memoryFor(
  const VDBOptions& options, std::size_t most = std::numeric_limits<std::size_t>::max())
{
  const std::size_t available = availableMemory();
  return options.memoryLimit != 0 ? options.memoryLimit
                                  : std::min(available != 0 ? available : most, most);
}

inline void dropEmpty(std::vector<PlacedBlock>& blocks)
{
  blocks.erase(std::remove_if(blocks.begin(), blocks.end(),
                 [](const PlacedBlock& b) { return b.block.empty(); }),
    blocks.end());
}

/// A voxel's neighbour. Indices end at those of 32 bits: beyond them there is the last one again.
inline openvdb::Coord beside(const openvdb::Coord& at, int x, int y, int z)
{
  const auto moved = [](std::int32_t from, int by)
  {
    const std::int64_t to = std::int64_t(from) + by;
    return static_cast<std::int32_t>(
      std::clamp<std::int64_t>(to, openvdb::Coord::min().x(), openvdb::Coord::max().x()));
  };
  return { moved(at.x(), x), moved(at.y(), y), moved(at.z(), z) };
}

/// Which active values are occupied: of masks, which have none, all.
template <class GridT>
bool isAbove(
  [[maybe_unused]] const typename GridT::ValueType& value, [[maybe_unused]] double threshold)
{
  if constexpr (std::is_same_v<typename GridT::TreeType::LeafNodeType::BuildType,
                  openvdb::ValueMask>)
  {
    return true;
  }
  else if constexpr (std::is_same_v<typename GridT::ValueType, bool>)
  {
    return value;
  }
  else
  {
    return static_cast<double>(value) > threshold;
  }
}

/// The block of a voxel, and those of a box of voxels.
inline openvdb::Coord blockOf(const openvdb::Coord& voxel)
{
  return voxel >> std::size_t(3);
}
inline openvdb::CoordBBox blocksOf(const openvdb::CoordBBox& voxels)
{
  return voxels >> std::size_t(3);
}
static_assert(VoxelBlock::Edge == 8, "");

/// Gathers them: a sparse walk over the nodes, never a dense grid.
template <class GridT>
class GridBlocks
{
public:
  using TreeT = typename GridT::TreeType;
  using LeafT = typename TreeT::LeafNodeType;
  using ValueT = typename GridT::ValueType;

  GridBlocks(const GridT& grid, const VDBOptions& options)
    : Grid(grid)
    , Value(options.threshold)
    , Options(options)
  {
  }

  /// Throws BuildStopped where there are too many.
  std::vector<PlacedBlock> gather()
  {
    std::vector<const LeafT*> leaves;
    this->Grid.tree().getNodes(leaves);
    std::vector<PlacedBlock> blocks(leaves.size());
    forEach(this->Options.parallelFor, leaves.size(), 64,
      [&](std::size_t i)
      {
        blocks[i].place = blockOf(leaves[i]->origin());
        this->fill(*leaves[i], blocks[i].block);
      });
    std::size_t voxels = 0;
    for (const PlacedBlock& block : blocks)
    {
      voxels += block.block.count();
    }
    dropEmpty(blocks);
    this->addTiles(static_cast<double>(voxels), blocks);
    return blocks;
  }

private:
  void fill(const LeafT& leaf, VoxelBlock& block) const
  {
    for (auto voxel = leaf.cbeginValueOn(); voxel; ++voxel)
    {
      if (isAbove<GridT>(*voxel, this->Value))
      {
        const openvdb::Coord in = voxel.getCoord() & (VoxelBlock::Edge - 1);
        block.add({ in.x(), in.y(), in.z() });
      }
    }
  }

  /// Active tiles: all of their voxels have one value. A few of them can stand for more voxels than
  /// anybody waits for, so without a limit that is set there is one for them.
  void addTiles(double voxels, std::vector<PlacedBlock>& blocks) const
  {
    constexpr std::size_t TileMemory = std::size_t(4) << 30;
    std::vector<openvdb::CoordBBox> tiles;
    auto tile = this->Grid.tree().cbeginValueOn();
    tile.setMaxDepth(decltype(tile)::LEAF_DEPTH - 1);
    for (; tile; ++tile)
    {
      if (isAbove<GridT>(*tile, this->Value))
      {
        tiles.push_back(tile.getBoundingBox());
        const openvdb::CoordBBox& box = tiles.back();
        voxels += (1.0 + box.max().x() - box.min().x()) * (1.0 + box.max().y() - box.min().y()) *
          (1.0 + box.max().z() - box.min().z());
      }
    }
    refuseTooMany(voxels, "occupied voxels, those of constant tiles included", BytesAVoxel,
      tiles.empty() ? memoryFor(this->Options) : memoryFor(this->Options, TileMemory),
      std::string(tiles.empty() ? "" : "; MemoryLimit can allow more") +
        (std::is_same_v<ValueT, bool> ? "" : "; as a surface it has voxels at its border only"));
    PlacedBlock full;
    std::fill(std::begin(full.block.bricks), std::end(full.block.bricks), ~std::uint64_t(0));
    for (const openvdb::CoordBBox& box : tiles)
    {
      for (auto place = blocksOf(box).begin(); place; ++place)
      {
        full.place = *place;
        blocks.push_back(full);
      }
    }
  }

  const GridT& Grid;
  const double Value;
  const VDBOptions& Options;
};
}

#endif
