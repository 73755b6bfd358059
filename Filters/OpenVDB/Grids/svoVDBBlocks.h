// The blocks of 8x8x8 voxels of a grid that are occupied: of its leaf nodes, and of its active
// tiles.
#ifndef svoVDBBlocks_h
#define svoVDBBlocks_h

#include "svoBlockSource.h"
#include "svoLevelSetPlane.h"
#include "svoVDBOctree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include <glm/vec3.hpp>
#include <openvdb/openvdb.h>

namespace svo
{
/// What an octree and its build take of a voxel that is occupied, about: see svoSource.cxx.
constexpr double BytesAVoxel = 16.0;

struct Refused
{
  BuildStatus status;
  std::string message;
};

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

/// A place in index space, and the block that has it.
struct PlacedBlock
{
  glm::i64vec3 place; // in blocks
  VoxelBlock block;
};

inline glm::i64vec3 blockOf(const openvdb::Coord& at)
{
  const auto down = [](std::int64_t v) { return v >> 3; };
  return { down(at.x()), down(at.y()), down(at.z()) };
}

inline glm::ivec3 inBlock(const openvdb::Coord& at)
{
  return { at.x() & 7, at.y() & 7, at.z() & 7 };
}

/// Gathers them: a sparse walk over the nodes, never a dense grid.
template <class GridT>
class GridBlocks
{
public:
  using TreeT = typename GridT::TreeType;
  using LeafT = typename TreeT::LeafNodeType;
  using ValueT = typename GridT::ValueType;

  GridBlocks(const GridT& grid, bool surface, double value, const VDBOptions& options)
    : Grid(grid)
    , Surface(surface)
    , Value(value)
    , Options(options)
  {
  }

  /// Throws Refused where there are too many.
  std::vector<PlacedBlock> gather()
  {
    std::vector<const LeafT*> leaves;
    this->Grid.tree().getNodes(leaves);
    std::vector<PlacedBlock> blocks(leaves.size());
    this->Options.parallelFor(0, leaves.size(), 64,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t i = first; i < last; ++i)
        {
          blocks[i].place = blockOf(leaves[i]->origin());
          this->fill(*leaves[i], blocks[i].block);
        }
      });
    std::size_t voxels = 0;
    for (const PlacedBlock& block : blocks)
    {
      voxels += block.block.count();
    }
    blocks.erase(std::remove_if(blocks.begin(), blocks.end(),
                   [](const PlacedBlock& b) { return b.block.empty(); }),
      blocks.end());
    if (!this->Surface)
    {
      this->addTiles(static_cast<double>(voxels), blocks);
    }
    return blocks;
  }

private:
  void fill(const LeafT& leaf, VoxelBlock& block) const
  {
    if constexpr (!std::is_same_v<ValueT, bool>)
    {
      if (this->Surface)
      {
        this->fillSurface(leaf, block);
        return;
      }
    }
    for (auto voxel = leaf.cbeginValueOn(); voxel; ++voxel)
    {
      if (isAbove<GridT>(*voxel, this->Value))
      {
        block.add(inBlock(voxel.getCoord()));
      }
    }
  }

  /// Those that the surface passes.
  void fillSurface(const LeafT& leaf, VoxelBlock& block) const
  {
    if constexpr (!std::is_same_v<ValueT, bool>)
    {
      constexpr int Wide = 10; // a voxel more on each side
      double around[Wide][Wide][Wide];
      const typename GridT::ConstUnsafeAccessor values(this->Grid.tree());
      for (int z = 0; z < Wide; ++z)
      {
        for (int y = 0; y < Wide; ++y)
        {
          for (int x = 0; x < Wide; ++x)
          {
            around[z][y][x] =
              static_cast<double>(values.getValue(beside(leaf.origin(), x - 1, y - 1, z - 1))) -
              this->Value;
          }
        }
      }
      for (auto voxel = leaf.cbeginValueOn(); voxel; ++voxel)
      {
        const glm::ivec3 at = inBlock(voxel.getCoord());
        VoxelValues near;
        for (int i = 0; i < VoxelValues::Count; ++i)
        {
          near.at[i] = around[at.z + i / 9][at.y + i / 3 % 3][at.x + i % 3];
        }
        SourcePlane plane;
        if (levelSetPlane(near, plane))
        {
          block.add(at);
        }
      }
    }
  }

  /// Active tiles: all of their voxels have one value.
  void addTiles(double voxels, std::vector<PlacedBlock>& blocks) const
  {
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
    const double needed = voxels * BytesAVoxel;
    if (voxels > 0x7fffffff || needed > static_cast<double>(this->Options.memoryLimit))
    {
      constexpr double Mebi = 1024.0 * 1024.0;
      std::ostringstream text;
      text << "the grid has " << std::fixed << std::setprecision(0) << voxels
           << " occupied voxels, constant tiles included, and an octree of them needs about "
           << needed / Mebi << " MiB, which is more than there is";
      throw Refused{ BuildStatus::TooLarge, text.str() };
    }
    for (const openvdb::CoordBBox& box : tiles)
    {
      const glm::i64vec3 low = blockOf(box.min()), high = blockOf(box.max());
      for (std::int64_t z = low.z; z <= high.z; ++z)
      {
        for (std::int64_t y = low.y; y <= high.y; ++y)
        {
          for (std::int64_t x = low.x; x <= high.x; ++x)
          {
            PlacedBlock full;
            full.place = { x, y, z };
            std::fill(
              std::begin(full.block.bricks), std::end(full.block.bricks), ~std::uint64_t(0));
            blocks.push_back(full);
          }
        }
      }
    }
  }

  const GridT& Grid;
  const bool Surface;
  const double Value;
  const VDBOptions& Options;
};
}

#endif
