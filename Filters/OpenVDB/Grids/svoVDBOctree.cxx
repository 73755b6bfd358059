#include "svoVDBOctree.h"

#include "svoLevelSetPlane.h"
#include "svoMeshOctree.h"
#include "svoMorton.h"
#include "svoVDBBlocks.h"
#include "svoVDBSurfaceBlocks.h"
#include "svoVDBTransform.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <new>
#include <type_traits>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <openvdb/openvdb.h>

namespace svo
{
namespace
{
using openvdb::Coord;
constexpr std::int64_t Edge = VoxelBlock::Edge;

/// The grid's values, asked by several threads. Accessors that are not registered with the tree are
/// made where they are used: nobody changes the tree.
template <class GridT>
class GridSource : public BlockSource
{
public:
  using ValueT = typename GridT::ValueType;

  /// `first`: index of the voxel in the cube's lower corner.
  GridSource(const GridT& grid, bool surface, double value, bool levelSet, const Coord& first,
    std::vector<VoxelBlock> blocks, const Cube& cube, int level)
    : BlockSource(std::move(blocks), cube, level)
    , Grid(grid)
    , Surface(surface)
    , Value(value)
    , Outwards(levelSet ? 1.0 : -1.0)
    , First(first)
  {
  }

protected:
  bool planeOf(const glm::ivec3& voxel, SourcePlane& plane) const override
  {
    const typename GridT::ConstUnsafeAccessor values(this->Grid.tree());
    const Coord at = this->First.offsetBy(voxel.x, voxel.y, voxel.z);
    if constexpr (!std::is_same_v<ValueT, bool>)
    {
      const auto near = [&](int x, int y, int z)
      {
        return this->Outwards *
          (static_cast<double>(values.getValue(beside(at, x, y, z))) - this->Value);
      };
      if (this->Surface)
      {
        VoxelValues around;
        for (int i = 0; i < VoxelValues::Count; ++i)
        {
          around.at[i] = near(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        }
        return levelSetPlane(around, plane);
      }
      const glm::dvec3 out(near(1, 0, 0) - near(-1, 0, 0), near(0, 1, 0) - near(0, -1, 0),
        near(0, 0, 1) - near(0, 0, -1));
      const double length = glm::length(out);
      if (length > 0.0 && std::isfinite(length) && std::isfinite(1.0 / length))
      {
        plane = { out / length, 0.0 };
        return true;
      }
    }
    plane = { this->fromNeighbours(values, voxel, at), 0.0 };
    return true;
  }

private:
  /// Of the occupied voxels around one: across the sheet that they are, and away from them. In the
  /// midst of a solid there is no such direction: its voxels get one and its opposite by turns, so
  /// that they say nothing in the mean of a block.
  template <class Accessor>
  glm::dvec3 fromNeighbours(const Accessor& values, const glm::ivec3& voxel, const Coord& at) const
  {
    const auto occupied = [&](int x, int y, int z)
    {
      ValueT value;
      return values.probeValue(beside(at, x, y, z), value) && isAbove<GridT>(value, this->Value);
    };
    const glm::dvec3 inner(0.0, 0.0, (voxel.x + voxel.y + voxel.z) % 2 ? 1.0 : -1.0);
    if (occupied(-1, 0, 0) && occupied(1, 0, 0) && occupied(0, -1, 0) && occupied(0, 1, 0) &&
      occupied(0, 0, -1) && occupied(0, 0, 1))
    {
      return inner;
    }
    constexpr int Reach = 2;
    double count = 0.0;
    glm::dvec3 sum(0.0);
    glm::dmat3 products(0.0);
    for (int i = 0; i < 125; ++i)
    {
      const glm::ivec3 step(i % 5 - Reach, i / 5 % 5 - Reach, i / 25 - Reach);
      if (occupied(step.x, step.y, step.z))
      {
        const glm::dvec3 way(step);
        count += 1.0;
        sum += way;
        products += glm::outerProduct(way, way);
      }
    }
    // Powers of the covariance's inverse turn a vector to where the voxels spread least: across a
    // sheet, however thin. Where several directions are alike, as at a solid's edges, it stays
    // between them.
    const glm::dvec3 mean = sum / count;
    const glm::dmat3 spread = products / count - glm::outerProduct(mean, mean) + glm::dmat3(0.05);
    const glm::dmat3 turn = glm::inverse(spread);
    glm::dvec3 out = -mean + 0.01 * glm::dvec3(1.0, 1.1, 1.3); // symmetric ones have no mean
    for (int k = 0; k < 4; ++k)
    {
      out = turn * glm::normalize(out);
    }
    const double length = glm::length(out);
    return length > 0.0 && std::isfinite(length) ? out / length : inner;
  }

  const GridT& Grid;
  const bool Surface;
  const double Value;
  const double Outwards; // -1: values fall towards the outside, as of fog
  const Coord First;
};

/// Whether a block has a voxel at a side: its last layer along an axis, or its first.
bool reachesSide(const VoxelBlock& block, int axis, bool last)
{
  VoxelBlock layer;
  for (int i = 0; i < VoxelBlock::Edge * VoxelBlock::Edge; ++i)
  {
    glm::ivec3 voxel(last ? VoxelBlock::Edge - 1 : 0);
    voxel[(axis + 1) % 3] = i % VoxelBlock::Edge;
    voxel[(axis + 2) % 3] = i / VoxelBlock::Edge;
    layer.add(voxel);
  }
  bool any = false;
  for (int i = 0; i < 8; ++i)
  {
    any = any || (layer.bricks[i] & block.bricks[i]) != 0;
  }
  return any;
}

/// Rays begin at the octree's cube, and planes reach a little beyond their voxels: so a surface
/// gets a block more where it has voxels at the cube's sides.
void leaveRoom(const std::vector<PlacedBlock>& blocks, openvdb::CoordBBox& bounds)
{
  const Coord low = bounds.min(), high = bounds.max();
  Coord &first = bounds.min(), &last = bounds.max();
  for (const PlacedBlock& block : blocks)
  {
    for (int i = 0; i < 3; ++i)
    {
      if (block.place[i] == low[i] && first[i] == low[i] && reachesSide(block.block, i, false))
      {
        --first[i];
      }
      if (block.place[i] == high[i] && last[i] == high[i] && reachesSide(block.block, i, true))
      {
        ++last[i];
      }
    }
  }
}

/// Blocks in voxels, which may be more than 32 bits can number.
glm::i64vec3 voxelsOf(const Coord& blocks)
{
  return Edge * glm::i64vec3(blocks.x(), blocks.y(), blocks.z());
}

/// The cube of an octree around blocks: its first block and its level.
void boundBlocks(const openvdb::GridBase& grid, bool surface,
  const std::vector<PlacedBlock>& blocks, Coord& first, int& level)
{
  const Coord any = blocks.empty() ? Coord() : blocks.front().place;
  openvdb::CoordBBox bounds(any, any);
  for (const PlacedBlock& block : blocks)
  {
    bounds.expand(block.place);
  }
  const auto own = grid.getMetadata<openvdb::Int32Metadata>(LevelMetadata);
  if (own && own->value() >= 3 && own->value() <= MaximumLevel &&
    !Coord::lessThan(bounds.min(), Coord()) &&
    levelOfVoxels(voxelsOf(bounds.max().offsetBy(1))) <= own->value())
  {
    level = own->value();
    first = Coord();
    return;
  }
  if (surface)
  {
    leaveRoom(blocks, bounds);
  }
  first = bounds.min();
  level = levelOfVoxels(voxelsOf(bounds.dim()));
}

template <class GridT>
SourceOctree convert(const GridT& grid, const VDBOptions& options, vtkPolyData* mesh)
{
  const bool levelSet = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
  const bool surface = isSurface(grid, options.conversion);
  const double value = surface && levelSet ? 0.0 : options.threshold;
  glm::dmat4 world;
  if (!indexToWorld(grid.transform(), world))
  {
    return { BuildStatus::BadInput, 0, "the grid has a frustum map, and that is not affine" };
  }
  if (!isTransform(world))
  {
    return { BuildStatus::BadInput, 0, "the grid's map is not finite, or cannot be inverted" };
  }
  std::vector<PlacedBlock> placed;
  if constexpr (!std::is_same_v<typename GridT::ValueType, bool>)
  {
    placed = surface ? SurfaceBlocks<GridT>(grid, value, options).gather() : placed;
  }
  placed = surface ? std::move(placed) : GridBlocks<GridT>(grid, options).gather();
  Coord first;
  BuildOptions build;
  boundBlocks(grid, surface, placed, first, build.level);
  if (build.level > MaximumLevel)
  {
    return { BuildStatus::TooLarge, 0,
      "the grid's occupied voxels are spread over more than 2^20 along an axis" };
  }
  std::vector<VoxelBlock> blocks(placed.size());
  for (std::size_t i = 0; i < placed.size(); ++i)
  {
    const Coord at = placed[i].place - first;
    blocks[i] = placed[i].block;
    blocks[i].key = mortonKey(at.x(), at.y(), at.z());
  }
  placed = {};
  std::sort(blocks.begin(), blocks.end(),
    [](const VoxelBlock& a, const VoxelBlock& b) { return a.key < b.key; });

  const glm::dvec3 corner = glm::dvec3(voxelsOf(first)) - 0.5; // of the first voxel, in index space
  Cube cube{ corner, std::ldexp(1.0, build.level) };
  if (onlyMovesAndScales(world))
  {
    cube = { glm::dvec3(world * glm::dvec4(corner, 1.0)), world[0][0] * cube.edge };
  }
  else
  {
    build.transform = world;
  }
  build.modelLow = cube.origin;
  build.modelHigh = cube.origin + cube.edge;
  build.leafGeometry = surface ? LeafGeometry::Plane : LeafGeometry::Voxel;
  build.memoryLimit = options.memoryLimit;
  build.parallelFor = options.parallelFor;
  build.progress = options.progress;
  const auto index = [&](int i) { return static_cast<std::int32_t>(voxelsOf(first)[i]); };
  const GridSource<GridT> source(grid, surface, value, levelSet,
    Coord(index(0), index(1), index(2)), std::move(blocks), cube, build.level);
  SourceOctree built = buildSourceOctree(source, build, options.carrier, mesh, &cube);
  if (built.status == BuildStatus::TooLarge)
  {
    built.message = "its voxels need more memory than there is"; // the level is the grid's
  }
  return built;
}
}

bool isSurface(const openvdb::GridBase& grid, VDBConversion conversion)
{
  const bool mask = grid.isType<openvdb::BoolGrid>() || grid.isType<openvdb::MaskGrid>();
  return !mask &&
    (conversion == VDBConversion::Surface ||
      (conversion == VDBConversion::Automatic && grid.getGridClass() == openvdb::GRID_LEVEL_SET));
}

SourceOctree octreeOfGrid(
  const openvdb::GridBase& grid, const VDBOptions& options, vtkPolyData* mesh)
{
  using Known = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid,
    openvdb::Int64Grid, openvdb::BoolGrid, openvdb::MaskGrid>;
  mesh->Initialize();
  SourceOctree built{ BuildStatus::BadInput, 0, {} };
  try
  {
    if (!grid.apply<Known>([&](const auto& typed) { built = convert(typed, options, mesh); }))
    {
      built.message = "grids of " + grid.valueType() +
        " have no surface; those of float, double, int32, int64, bool and mask have";
    }
    return built;
  }
  catch (const BuildStopped& stopped)
  {
    built = { stopped.status, 0, stopped.message };
  }
  catch (const std::bad_alloc&)
  {
    built = { BuildStatus::TooLarge, 0, "there is not enough memory for the grid's voxels" };
  }
  catch (const std::exception& failure)
  {
    built.message = failure.what();
  }
  mesh->Initialize();
  return built;
}
}
