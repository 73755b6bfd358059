#include "svoSourceOctree.h"

#include "svoCellPlanes.h"
#include "svoCellSurface.h"
#include "svoContour.h"
#include "svoMeshOctree.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include <glm/common.hpp>

namespace svo
{
namespace
{
/// The deepest level of cubes and bounds: some thousand cells.
constexpr int CoarseLevel = 5;

/// Of the planes, which pass their voxels by half a voxel, in the octree's own coordinates, as VTK
/// orders them; cut down to the box that a surface was looked for in.
void boundPlanes(const Octree& octree, const BuildOptions& options, double bounds[6])
{
  const int level = std::min(octree.level(), CoarseLevel);
  glm::ivec3 low(std::numeric_limits<int>::max()), high(-1);
  forEachCell(octree, level,
    [&](const OctreeCell& cell)
    {
      low = glm::min(low, cell.cell);
      high = glm::max(high, cell.cell + 1);
      return true;
    });
  const Header& header = octree.header();
  const double edge = std::ldexp(header.voxelSize, octree.level() - level);
  for (int i = 0; i < 3; ++i)
  {
    const bool any = high[i] >= 0;
    bounds[2 * i] = any ? header.origin[i] + low[i] * edge - 0.5 * header.voxelSize : 1.0;
    bounds[2 * i + 1] = any ? header.origin[i] + high[i] * edge + 0.5 * header.voxelSize : -1.0;
    const double least = options.modelLow[i], most = options.modelHigh[i];
    if (least < most && bounds[2 * i] <= most && least <= bounds[2 * i + 1])
    {
      bounds[2 * i] = std::max(bounds[2 * i], least);
      bounds[2 * i + 1] = std::min(bounds[2 * i + 1], most);
    }
  }
}

/// The faces of cells, as double precision: they hold the surface wherever it lies.
void makeCubes(const Octree& octree, int level, vtkPolyData* mesh)
{
  CellQuads quads;
  forEachVisibleCell(octree, level, false,
    [&](const OctreeCell& cell, int faces)
    {
      quads.add(cell.cell, faces);
      return true;
    });
  quads.write(octree, level, VTK_DOUBLE, mesh);
}

SourceOctree buildUnguarded(const SurfaceSource& source, const BuildOptions& options,
  const CarrierOptions& carrier, vtkPolyData* mesh, const Cube* cube)
{
  BuildResult result = cube ? build(source, *cube, options) : build(source, options);
  if (result.status != BuildStatus::Built)
  {
    return { result.status, 0,
      result.status == BuildStatus::Aborted ? std::string() : result.message, {} };
  }
  std::string message;
  Octree octree = Octree::open(result.data, result.size, nullptr, message);
  if (!octree)
  {
    return { BuildStatus::BadInput, 0, message, {} };
  }
  Header& header = *reinterpret_cast<Header*>(result.data.get());
  boundPlanes(octree, options, header.meshBounds);
  const bool cubes = options.leafGeometry == LeafGeometry::Voxel;
  const int level =
    cubes ? std::min(octree.level(), CoarseLevel) : deepestLevel(octree, carrier.cells);
  if (cubes)
  {
    makeCubes(octree, level, mesh);
  }
  else
  {
    makeContour(octree, level, options, carrier.turned, mesh);
  }
  header.signature = meshSignature(mesh);
  header.pointCount = static_cast<std::uint64_t>(mesh->GetNumberOfPoints());
  header.cellCount = static_cast<std::uint64_t>(mesh->GetNumberOfCells());
  attachOctree(mesh, octree);
  return { BuildStatus::Built, header.voxelCount, std::string(), octree, level };
}
}

SourceOctree buildSourceOctree(const SurfaceSource& source, BuildOptions options,
  const CarrierOptions& carrier, vtkPolyData* mesh, const Cube* cube)
{
  mesh->Initialize();
  options.memoryLimit = options.memoryLimit != 0 ? options.memoryLimit : availableMemory();
  try
  {
    return buildUnguarded(source, options, carrier, mesh, cube);
  }
  catch (const std::bad_alloc&)
  {
    mesh->Initialize();
    return { BuildStatus::TooLarge, 0,
      "there is not enough memory for an octree of level " + std::to_string(options.level) };
  }
}
}
