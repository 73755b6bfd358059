#include "vtkSVOToPolyData.h"

#include "svoAbort.h"
#include "svoMeshOctree.h"
#include "svoNode.h"
#include "svoOctreeCells.h"
#include "svoRepresentative.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSVOToPolyData);

namespace
{
/// The faces of a cell: which neighbour they look at, and their corners, counter-clockwise seen
/// from there.
struct Face
{
  glm::ivec3 neighbour;
  glm::ivec3 corners[4];
};
const Face Faces[6] = {
  { { -1, 0, 0 }, { { 0, 0, 0 }, { 0, 0, 1 }, { 0, 1, 1 }, { 0, 1, 0 } } },
  { { 1, 0, 0 }, { { 1, 0, 0 }, { 1, 1, 0 }, { 1, 1, 1 }, { 1, 0, 1 } } },
  { { 0, -1, 0 }, { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 1 }, { 0, 0, 1 } } },
  { { 0, 1, 0 }, { { 0, 1, 0 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 1, 0 } } },
  { { 0, 0, -1 }, { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 1, 0, 0 } } },
  { { 0, 0, 1 }, { { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } } },
};

bool isOccupied(
  const svo::Octree& octree, const svo::OctreeCell& cell, const glm::ivec3& at, int level)
{
  // Most neighbours are in the same block, where its mask is the answer.
  const glm::ivec3 difference = (at ^ cell.cell) >> (cell.bitCount == 1 ? 2 : 1);
  if (cell.bitCount < 64 && difference == glm::ivec3(0))
  {
    const svo::Node& node = octree.nodes()[cell.node];
    return cell.bitCount == 1
      ? svo::hasChild(node, svo::cellIndex(at.x & 3, at.y & 3, at.z & 3))
      : svo::groupCells(node, svo::GroupSize * svo::cellIndex(at.x & 1, at.y & 1, at.z & 1)) != 0;
  }
  return octree.occupied(at, level);
}

/// Corners have up to 2^20 + 1 coordinates on an axis, so 21 bits each.
std::uint64_t cornerKey(const glm::ivec3& corner)
{
  return static_cast<std::uint64_t>(corner.z) << 42 | static_cast<std::uint64_t>(corner.y) << 21 |
    static_cast<std::uint64_t>(corner.x);
}

/// Corner keys of the quads, four each, and the mesh cell of each quad.
struct Quads
{
  std::vector<std::uint64_t> corners;
  std::vector<std::uint32_t> cellIds;
};

/// Calls visit(cell, faces), a bit for each face that is shown, for every cell that shows any.
template <class Visit>
bool forEachVisibleCell(const svo::Octree& octree, int level, bool interior, const Visit& visit)
{
  return svo::forEachCell(octree, level,
    [&](const svo::OctreeCell& cell)
    {
      int faces = 0;
      for (int f = 0; f < 6; ++f)
      {
        if (interior || !isOccupied(octree, cell, cell.cell + Faces[f].neighbour, level))
        {
          faces |= 1 << f;
        }
      }
      return faces == 0 || visit(cell, faces);
    });
}
}

//------------------------------------------------------------------------------
int vtkSVOToPolyData::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  svo::detachOctree(output); // the executive passes it on; it does not belong to the new surface
  svo::Octree octree;
  std::string message;
  const svo::Attached attached = svo::openAttachedOctree(input, octree, message);
  if (attached != svo::Attached::Found)
  {
    vtkErrorMacro(<< svo::describe(attached, message));
    return 1;
  }
  const int level = this->Level < 0 ? octree.level() : std::min(this->Level, octree.level());

  // Counting first costs a walk, and spares growing arrays of unknown size.
  const double cellCount = static_cast<double>(octree.header().voxelCount);
  std::size_t visited = 0;
  const auto goOn = [&](double begin, double share)
  {
    if ((++visited & 0xffff) == 0)
    {
      this->UpdateProgress(begin + share * std::min(1.0, static_cast<double>(visited) / cellCount));
    }
    return !svo::isAborted(this);
  };
  std::size_t count = 0;
  forEachVisibleCell(octree, level, this->InteriorFaces,
    [&](const svo::OctreeCell&, int faces)
    {
      count += static_cast<std::size_t>(svo::countBits(static_cast<unsigned>(faces)));
      return goOn(0.0, 0.3);
    });
  if (svo::isAborted(this))
  {
    return 1;
  }
  // Keys twice, connectivity, cell data, and about one point a quad.
  const std::size_t needed = count * (4 * 16 + 4 * 8 + 8 + 4 + 8 + 4 + 24);
  const std::size_t available = svo::availableMemory();
  const auto refuse = [&]
  {
    vtkErrorMacro("The surface of the cells of level "
      << level << " has " << count << " quads and needs about " << (needed >> 20)
      << " MiB, which is more than there is.");
    return 1;
  };
  if (available != 0 && needed > available)
  {
    return refuse();
  }

  try
  {
    Quads quads;
    quads.corners.reserve(4 * count);
    quads.cellIds.reserve(count);
    visited = 0;
    forEachVisibleCell(octree, level, this->InteriorFaces,
      [&](const svo::OctreeCell& cell, int faces)
      {
        const std::uint32_t triangle = svo::nearestTriangle(octree, cell, level);
        for (int f = 0; f < 6; ++f)
        {
          if (faces >> f & 1)
          {
            for (const glm::ivec3& corner : Faces[f].corners)
            {
              quads.corners.push_back(cornerKey(cell.cell + corner));
            }
            quads.cellIds.push_back(octree.surface()->cells[triangle]);
          }
        }
        return goOn(0.3, 0.4);
      });
    if (svo::isAborted(this))
    {
      return 1;
    }

    std::vector<std::uint64_t> points = quads.corners;
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    this->UpdateProgress(0.8);

    const svo::Header& header = octree.header();
    const double edge = std::ldexp(header.voxelSize, octree.level() - level);
    vtkNew<vtkPoints> outPoints;
    outPoints->SetDataType(input->GetPoints() ? input->GetPoints()->GetDataType() : VTK_FLOAT);
    outPoints->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const std::uint64_t key = points[i];
      outPoints->SetPoint(static_cast<vtkIdType>(i),
        header.origin[0] + static_cast<double>(key & 0x1fffff) * edge,
        header.origin[1] + static_cast<double>(key >> 21 & 0x1fffff) * edge,
        header.origin[2] + static_cast<double>(key >> 42) * edge);
    }

    vtkNew<vtkIdTypeArray> connectivity;
    connectivity->SetNumberOfValues(static_cast<vtkIdType>(4 * count));
    for (std::size_t i = 0; i < 4 * count; ++i)
    {
      const auto found = std::lower_bound(points.begin(), points.end(), quads.corners[i]);
      connectivity->SetValue(static_cast<vtkIdType>(i), found - points.begin());
    }
    vtkNew<vtkCellArray> polys;
    polys->SetData(4, connectivity);

    vtkNew<vtkIntArray> levels;
    levels->SetName("Level");
    levels->SetNumberOfValues(static_cast<vtkIdType>(count));
    levels->FillValue(level);
    vtkNew<vtkIdTypeArray> cellIds;
    cellIds->SetName("CellId");
    cellIds->SetNumberOfValues(static_cast<vtkIdType>(count));
    std::copy(quads.cellIds.begin(), quads.cellIds.end(), cellIds->GetPointer(0));

    output->SetPoints(outPoints);
    output->SetPolys(polys);
    output->GetCellData()->AddArray(levels);
    output->GetCellData()->AddArray(cellIds);
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    output->Initialize();
    return refuse();
  }
}

//------------------------------------------------------------------------------
void vtkSVOToPolyData::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Level: " << this->Level << "\n";
  os << indent << "InteriorFaces: " << (this->InteriorFaces ? "On\n" : "Off\n");
}
