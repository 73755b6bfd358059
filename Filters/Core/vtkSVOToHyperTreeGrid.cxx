#include "vtkSVOToHyperTreeGrid.h"

#include "svoAbort.h"
#include "svoCellPlanes.h"
#include "svoLeafValues.h"
#include "svoMeshOctree.h"
#include "svoNode.h"
#include "svoOctreeCells.h"
#include "svoRepresentative.h"

#include "vtkBitArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkHyperTreeGrid.h"
#include "vtkHyperTreeGridNonOrientedCursor.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <new>
#include <string>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

vtkStandardNewMacro(vtkSVOToHyperTreeGrid);

namespace
{
/// Goes down octree and grid side by side.
class TreeWriter
{
public:
  TreeWriter(const svo::Octree& octree, int level, std::size_t cells, svo::LeafArrays arrays,
    std::function<bool()> goOn)
    : Octree(octree)
    , Level(level)
    , Arrays(std::move(arrays))
    , GoOn(std::move(goOn))
  {
    this->Mask->SetNumberOfValues(static_cast<vtkIdType>(cells));
    this->Levels->SetName("Level");
    this->Levels->SetNumberOfValues(static_cast<vtkIdType>(cells));
    if (octree.surface())
    {
      this->CellIds->SetName("CellId");
      this->CellIds->SetNumberOfValues(static_cast<vtkIdType>(cells));
    }
    for (auto& [values, copy] : this->Arrays)
    {
      copy->SetNumberOfTuples(static_cast<vtkIdType>(cells));
    }
  }

  /// False if it was stopped.
  bool write(vtkHyperTreeGrid* grid)
  {
    vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
    cursor->Initialize(grid, 0, true);
    cursor->SetGlobalIndexStart(0);
    if (this->Octree.empty())
    {
      this->set(cursor->GetGlobalNodeIndex(), 0, nullptr);
    }
    else
    {
      this->descend(cursor, { glm::ivec3(0), 0, 0, svo::NodeLevels - this->Octree.rootBits(0) }, 0);
    }
    grid->SetMask(this->Mask);
    grid->GetCellData()->AddArray(this->Levels);
    if (this->Octree.surface())
    {
      grid->GetCellData()->AddArray(this->CellIds);
    }
    for (auto& [values, copy] : this->Arrays)
    {
      grid->GetCellData()->AddArray(copy);
    }
    return !this->Stopped;
  }

private:
  void set(vtkIdType index, int level, const svo::OctreeCell* cell)
  {
    this->Mask->SetValue(index, cell ? 0 : 1);
    this->Levels->SetValue(index, static_cast<unsigned char>(level));
    if (this->Octree.surface())
    {
      this->CellIds->SetValue(index,
        cell ? this->Octree.surface()->cells[svo::nearestTriangle(this->Octree, *cell, level)]
             : vtkIdType(-1));
    }
    for (auto& [values, copy] : this->Arrays)
    {
      copy->SetTuple(index, cell ? svo::firstLeaf(this->Octree, *cell) : 0, values);
    }
  }

  /// Child i of a cell, one that is occupied or not.
  svo::OctreeCell child(const svo::OctreeCell& cell, int i, bool& occupied) const
  {
    const svo::Node* nodes = this->Octree.nodes();
    const glm::ivec3 at = 2 * cell.cell + glm::ivec3(i & 1, i >> 1 & 1, i >> 2);
    svo::OctreeCell below{ at, cell.node, cell.firstBit, cell.above };
    if (below.above == 0)
    {
      below.node = svo::child(nodes[cell.node], cell.firstBit);
      below.firstBit = 0;
      below.above = svo::NodeLevels;
    }
    --below.above;
    below.firstBit += i * svo::cellsBelow(below.above);
    occupied = svo::occupiedBelow(nodes[below.node], below.firstBit, below.above) != 0;
    return below;
  }

  void descend(vtkHyperTreeGridNonOrientedCursor* cursor, const svo::OctreeCell& cell, int level)
  {
    this->set(cursor->GetGlobalNodeIndex(), level, &cell);
    if (level == this->Level || this->Stopped)
    {
      return;
    }
    cursor->SubdivideLeaf();
    for (int i = 0; i < 8; ++i)
    {
      bool occupied = false;
      const svo::OctreeCell below = this->child(cell, i, occupied);
      cursor->ToChild(static_cast<unsigned char>(i));
      if (occupied)
      {
        this->descend(cursor, below, level + 1);
      }
      else
      {
        this->set(cursor->GetGlobalNodeIndex(), level + 1, nullptr);
      }
      cursor->ToParent();
    }
    this->Stopped = this->Stopped || !this->GoOn();
  }

  const svo::Octree& Octree;
  const int Level;
  svo::LeafArrays Arrays;
  const std::function<bool()> GoOn;
  bool Stopped = false;
  vtkNew<vtkBitArray> Mask;
  vtkNew<vtkUnsignedCharArray> Levels;
  vtkNew<vtkIdTypeArray> CellIds;
};

/// True if cells are boxes along the axes of the mesh's coordinates.
bool liesAlongAxes(const glm::dmat4& transform)
{
  for (int i = 0; i < 3; ++i)
  {
    if (!(transform[i][i] > 0.0) || transform[i][(i + 1) % 3] != 0.0 ||
      transform[i][(i + 2) % 3] != 0.0)
    {
      return false;
    }
  }
  return true;
}

void setCube(const svo::Octree& octree, vtkHyperTreeGrid* grid)
{
  const glm::dmat4 transform = octree.transform();
  const svo::Header& h = octree.header();
  const double edge = std::ldexp(h.voxelSize, octree.level());
  grid->SetDimensions(2, 2, 2);
  grid->SetBranchFactor(2);
  void (vtkHyperTreeGrid::*const setters[3])(vtkDataArray*) = { &vtkHyperTreeGrid::SetXCoordinates,
    &vtkHyperTreeGrid::SetYCoordinates, &vtkHyperTreeGrid::SetZCoordinates };
  for (int i = 0; i < 3; ++i)
  {
    vtkNew<vtkDoubleArray> coordinates;
    for (const double at : { h.origin[i], h.origin[i] + edge })
    {
      coordinates->InsertNextValue(
        octree.hasTransform() ? transform[i][i] * at + transform[3][i] : at);
    }
    (grid->*setters[i])(coordinates);
  }
}
}

//------------------------------------------------------------------------------
int vtkSVOToHyperTreeGrid::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkSVOToHyperTreeGrid::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkHyperTreeGrid");
  return 1;
}

//------------------------------------------------------------------------------
int vtkSVOToHyperTreeGrid::ProcessTrees(vtkHyperTreeGrid*, vtkDataObject*)
{
  return 1;
}

//------------------------------------------------------------------------------
int vtkSVOToHyperTreeGrid::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkHyperTreeGrid* output = vtkHyperTreeGrid::GetData(outputVector);
  output->Initialize();
  svo::Octree octree;
  std::string message;
  const svo::Attached attached = svo::openAttachedOctree(input, octree, message);
  if (attached != svo::Attached::Found)
  {
    vtkErrorMacro(<< svo::describe(attached, message));
    return 1;
  }
  if (!liesAlongAxes(octree.transform()))
  {
    vtkErrorMacro("The octree's cells are turned, mirrored or sheared, which those of a hyper tree "
                  "grid cannot be. vtkSVOToPolyData shows them.");
    return 1;
  }
  const int level = this->Level < 0 ? octree.level() : std::min(this->Level, octree.level());
  std::size_t cells = 1; // the root, and the eight of each occupied cell above the level
  for (int l = 0; l < level; ++l)
  {
    cells += 8 * svo::cellsOfLevel(octree, l);
  }
  // Of a cell its arrays, and of the eight together VTK's indices of parent and children, twice
  // while they grow.
  const std::size_t needed = cells * (1 + (octree.surface() ? 8 : 0) + 2 * 6);
  const std::size_t available = svo::availableMemory();
  const auto refuse = [&]
  {
    output->Initialize();
    vtkErrorMacro("The hyper tree grid of level "
      << level << " has " << cells << " cells and needs about " << (needed >> 20)
      << " MiB, which is more than there is. Choose a lower Level.");
    return 1;
  };
  if (available != 0 && needed > available)
  {
    return refuse();
  }
  try
  {
    std::size_t visited = 0;
    TreeWriter writer(octree, level, cells, svo::emptyCopiesOfLeafValues(input),
      [&]
      {
        if ((++visited & 0xffff) == 0)
        {
          this->UpdateProgress(
            std::min(1.0, 8.0 * static_cast<double>(visited) / static_cast<double>(cells)));
        }
        return !svo::isAborted(this);
      });
    setCube(octree, output);
    if (!writer.write(output))
    {
      output->Initialize();
    }
  }
  catch (const std::bad_alloc&)
  {
    return refuse();
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkSVOToHyperTreeGrid::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Level: " << this->Level << "\n";
}
