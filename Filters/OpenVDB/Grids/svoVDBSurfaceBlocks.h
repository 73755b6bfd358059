// The blocks of 8x8x8 voxels that the surface of a grid passes.
//
// The field is that of all values, active or not, of leaf nodes, constant tiles and the background,
// as OpenVDB's own mesher sees it. A voxel that the surface passes has values of both sides among
// itself and its neighbours. So it lies in a leaf node, or beside one, or at the border of a tile.
// As that mesher does, this looks at borders of active tiles only: where nothing is active, and
// there is no leaf node, tiles that differ from the background enclose nothing that was meant.
#ifndef svoVDBSurfaceBlocks_h
#define svoVDBSurfaceBlocks_h

#include "svoLevelSetPlane.h"
#include "svoNode.h"
#include "svoVDBBlocks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <openvdb/openvdb.h>

namespace svo
{
template <class GridT>
class SurfaceBlocks
{
public:
  using LeafT = typename GridT::TreeType::LeafNodeType;
  using ValueT = typename GridT::ValueType;

  /// `value`: that the field takes on the surface.
  SurfaceBlocks(const GridT& grid, double value, const VDBOptions& options)
    : Grid(grid)
    , Value(value)
    , Options(options)
  {
  }

  /// Throws BuildStopped where there are too many.
  std::vector<PlacedBlock> gather() const
  {
    std::vector<const LeafT*> leaves;
    this->Grid.tree().getNodes(leaves);
    Places places = this->besideLeaves(leaves);
    this->addTiles(places);
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    std::vector<PlacedBlock> blocks(leaves.size() + places.size());
    forEach(this->Options.parallelFor, blocks.size(), 64,
      [&](std::size_t i)
      {
        blocks[i].place =
          i < leaves.size() ? blockOf(leaves[i]->origin()) : places[i - leaves.size()];
        this->fill(blocks[i]);
      });
    dropEmpty(blocks);
    return blocks;
  }

private:
  using Coord = openvdb::Coord;
  using CoordBBox = openvdb::CoordBBox;
  using Places = std::vector<Coord>;
  using Accessor = typename GridT::ConstUnsafeAccessor;
  static constexpr int Ways = 27; // to the blocks around one, and to itself
  static constexpr int Wide = VoxelBlock::Edge + 2;

  static Coord way(int i) { return { i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1 }; }
  static bool exists(const Coord& place)
  {
    constexpr std::int32_t End = 1 << 28; // of indices of 32 bits
    return CoordBBox(Coord(-End), Coord(End - 1)).isInside(place);
  }
  static Coord coordOf(const Coord& place)
  {
    return { 8 * place.x(), 8 * place.y(), 8 * place.z() };
  }
  /// The face, the edge or the corner of a box that a way leads to.
  static CoordBBox border(CoordBBox box, const Coord& way)
  {
    for (int i = 0; i < 3; ++i)
    {
      box.min()[i] = way[i] > 0 ? box.max()[i] : box.min()[i];
      box.max()[i] = way[i] < 0 ? box.min()[i] : box.max()[i];
    }
    return box;
  }

  /// -1, 1, 0 on the surface, 2 of what is no number.
  int sideOf(const ValueT& value) const
  {
    const double v = static_cast<double>(value) - this->Value;
    return v < 0.0 ? -1 : v > 0.0 ? 1 : v == 0.0 ? 0 : 2;
  }

  /// Those without a leaf node that have one beside them with a value of another side there.
  Places besideLeaves(const std::vector<const LeafT*>& leaves) const
  {
    std::vector<std::uint32_t> ways(leaves.size(), 0);
    this->Options.parallelFor(0, leaves.size(), 64,
      [&](std::size_t first, std::size_t last)
      {
        const Accessor values(this->Grid.tree());
        for (std::size_t i = first; i < last; ++i)
        {
          for (int w = 0; w < Ways; ++w)
          {
            const Coord place = blockOf(leaves[i]->origin()) + way(w);
            if (exists(place) && !values.probeConstLeaf(coordOf(place)) &&
              this->changesTowards(
                *leaves[i], way(w), this->sideOf(values.getValue(coordOf(place)))))
            {
              ways[i] |= 1u << w;
            }
          }
        }
      });
    Places places;
    for (std::size_t i = 0; i < leaves.size(); ++i)
    {
      for (std::uint32_t left = ways[i]; left != 0; left &= left - 1)
      {
        places.push_back(blockOf(leaves[i]->origin()) + way(lowestBit(std::uint64_t(left))));
      }
    }
    return places;
  }

  /// Whether a voxel at a face, an edge or a corner has another side.
  bool changesTowards(const LeafT& leaf, const Coord& way, int side) const
  {
    const CoordBBox voxels(Coord(0), Coord(VoxelBlock::Edge - 1));
    for (auto voxel = border(voxels, way).begin(); voxel; ++voxel)
    {
      if (this->sideOf(leaf.getValue(LeafT::coordToOffset(*voxel))) != side)
      {
        return true;
      }
    }
    return false;
  }

  /// Those on both sides of the borders of active tiles.
  void addTiles(Places& places) const
  {
    const Accessor values(this->Grid.tree());
    auto tile = this->Grid.tree().cbeginValueOn();
    tile.setMaxDepth(decltype(tile)::LEAF_DEPTH - 1);
    for (; tile; ++tile)
    {
      const int side = this->sideOf(*tile);
      const CoordBBox blocks = blocksOf(tile.getBoundingBox());
      const Coord size = blocks.dim();
      for (int w = 0; w < Ways; ++w)
      {
        const Coord to = way(w);
        const Coord next =
          blocks.min().offsetBy(to.x() * size.x(), to.y() * size.y(), to.z() * size.z());
        // A tile of the same size or larger is of one value.
        const bool same = !exists(next) ||
          (values.getValueDepth(coordOf(next)) <= static_cast<int>(tile.getDepth()) &&
            this->sideOf(values.getValue(coordOf(next))) == side);
        if (!same)
        {
          this->addBorder(border(blocks, to), to, values, places);
        }
      }
    }
  }

  /// Those at the border of a box of blocks that a way leads to, inside and outside.
  void addBorder(
    const CoordBBox& border, const Coord& way, const Accessor& values, Places& places) const
  {
    refuseTooMany(static_cast<double>(places.size()) + 2.0 * static_cast<double>(border.volume()),
      "blocks of 8x8x8 voxels at the borders of constant tiles",
      sizeof(Coord) + sizeof(PlacedBlock), memoryFor(this->Options));
    for (auto inside = border.begin(); inside; ++inside)
    {
      for (const Coord& place : { *inside, *inside + way })
      {
        if (exists(place) && !values.probeConstLeaf(coordOf(place)))
        {
          places.push_back(place);
        }
      }
    }
  }

  /// The voxels that the surface passes.
  void fill(PlacedBlock& block) const
  {
    struct
    {
      const LeafT* leaf = nullptr;
      ValueT value{};
    } near[Ways];
    const Accessor values(this->Grid.tree());
    bool same = true;
    for (int w = 0; w < Ways; ++w)
    {
      const Coord place = block.place + way(w);
      near[w].value = this->Grid.background();
      if (exists(place))
      {
        near[w].leaf = values.probeConstLeaf(coordOf(place));
        near[w].value = near[w].leaf ? near[w].value : values.getValue(coordOf(place));
      }
      same = same && !near[w].leaf && this->sideOf(near[w].value) == this->sideOf(near[0].value);
    }
    if (same)
    {
      return;
    }
    double around[Wide][Wide][Wide];
    // Of each row a bit for each value: those that are not above the surface, those that are not
    // below it, and those that are no numbers.
    std::uint32_t below[Wide][Wide] = {}, above[Wide][Wide] = {}, bad[Wide][Wide] = {};
    for (int z = 0; z < Wide; ++z)
    {
      for (int y = 0; y < Wide; ++y)
      {
        for (int x = 0; x < Wide; ++x)
        {
          const auto& from = near[(z + 7) / 8 * 9 + (y + 7) / 8 * 3 + (x + 7) / 8];
          const ValueT value = from.leaf
            ? from.leaf->getValue(LeafT::coordToOffset({ (x + 7) % 8, (y + 7) % 8, (z + 7) % 8 }))
            : from.value;
          const double v = static_cast<double>(value) - this->Value;
          around[z][y][x] = v;
          below[z][y] |= std::uint32_t(v <= 0.0) << x;
          above[z][y] |= std::uint32_t(v >= 0.0) << x;
          bad[z][y] |= std::uint32_t(!std::isfinite(v)) << x;
        }
      }
    }
    for (int z = 0; z < VoxelBlock::Edge; ++z)
    {
      for (int y = 0; y < VoxelBlock::Edge; ++y)
      {
        std::uint32_t low = 0, high = 0, none = 0;
        for (int i = 0; i < 9; ++i)
        {
          low |= below[z + i / 3][y + i % 3];
          high |= above[z + i / 3][y + i % 3];
          none |= bad[z + i / 3][y + i % 3];
        }
        const auto spread = [](std::uint32_t row) { return row | row >> 1 | row >> 2; };
        const std::uint32_t changes = spread(low) & spread(high) & ~spread(none);
        for (int x = 0; x < VoxelBlock::Edge; ++x)
        {
          if ((changes >> x & 1) != 0 && valuesAround(around, x, y, z).passed())
          {
            block.block.add({ x, y, z });
          }
        }
      }
    }
  }

  static VoxelValues valuesAround(const double (&around)[Wide][Wide][Wide], int x, int y, int z)
  {
    VoxelValues near;
    for (int i = 0; i < VoxelValues::Count; ++i)
    {
      near.at[i] = around[z + i / 9][y + i / 3 % 3][x + i % 3];
    }
    return near;
  }

  const GridT& Grid;
  const double Value;
  const VDBOptions& Options;
};
}

#endif
