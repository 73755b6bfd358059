#include "svoSourceOctree.h"

#include "svoCellSurface.h"
#include "svoMeshOctree.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <new>

namespace svo
{
namespace
{
/// Double precision: bounds of the hull have to hold the surface wherever it lies.
void makeHull(const Octree& octree, vtkPolyData* hull)
{
  const int level = std::min(octree.level(), HullLevel);
  CellQuads quads;
  forEachVisibleCell(octree, level, false,
    [&](const OctreeCell& cell, int faces)
    {
      for (int f = 0; f < CellFaces; ++f)
      {
        if (faces >> f & 1)
        {
          quads.add(cell.cell, FacesOfCell[f]);
        }
      }
      return true;
    });
  quads.write(octree, level, VTK_DOUBLE, hull);
}

SourceOctree buildUnguarded(
  const SurfaceSource& source, const BuildOptions& options, vtkPolyData* hull)
{
  BuildResult result = build(source, options);
  if (result.status != BuildStatus::Built)
  {
    return { result.status, 0,
      result.status == BuildStatus::Aborted ? std::string() : result.message };
  }
  std::string message;
  Octree octree = Octree::open(result.data, result.size, nullptr, message);
  if (!octree)
  {
    return { BuildStatus::BadInput, 0, message };
  }
  makeHull(octree, hull);
  Header& header = *reinterpret_cast<Header*>(result.data.get());
  header.signature = meshSignature(hull);
  header.pointCount = static_cast<std::uint64_t>(hull->GetNumberOfPoints());
  header.cellCount = static_cast<std::uint64_t>(hull->GetNumberOfCells());
  hull->GetBounds(header.meshBounds);
  attachOctree(hull, octree);
  return { BuildStatus::Built, header.voxelCount, std::string() };
}
}

SourceOctree buildSourceOctree(const SurfaceSource& source, BuildOptions options, vtkPolyData* hull)
{
  hull->Initialize();
  options.memoryLimit = options.memoryLimit != 0 ? options.memoryLimit : availableMemory();
  try
  {
    return buildUnguarded(source, options, hull);
  }
  catch (const std::bad_alloc&)
  {
    hull->Initialize();
    return { BuildStatus::TooLarge, 0,
      "there is not enough memory for an octree of level " + std::to_string(options.level) };
  }
}
}
