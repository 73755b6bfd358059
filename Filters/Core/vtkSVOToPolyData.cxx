#include "vtkSVOToPolyData.h"

#include "svoAbort.h"
#include "svoCellSurface.h"
#include "svoLeafValues.h"
#include "svoMeshOctree.h"
#include "svoNode.h"
#include "svoOctreeCells.h"
#include "svoRepresentative.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <new>
#include <string>

vtkStandardNewMacro(vtkSVOToPolyData);

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
  svo::forEachVisibleCell(octree, level, this->InteriorFaces,
    [&](const svo::OctreeCell&, int faces)
    {
      count += static_cast<std::size_t>(svo::countBits(static_cast<unsigned>(faces)));
      return goOn(0.0, 0.3);
    });
  if (svo::isAborted(this))
  {
    return 1;
  }
  // With cell data, of which there is a copy while the mesh is written.
  const std::size_t needed = count * (svo::CellQuads::Bytes + 8 + 4 + 8 + 4);
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
    svo::CellQuads quads;
    quads.reserve(count);
    vtkNew<vtkIdTypeArray> cellIds; // stays empty of an octree of planes
    cellIds->SetName("CellId");
    cellIds->Allocate(octree.surface() ? static_cast<vtkIdType>(count) : 0);
    svo::LeafArrays leafArrays = svo::emptyCopiesOfLeafValues(input);
    for (auto& [values, copy] : leafArrays)
    {
      copy->Allocate(static_cast<vtkIdType>(count) * copy->GetNumberOfComponents());
    }
    visited = 0;
    svo::forEachVisibleCell(octree, level, this->InteriorFaces,
      [&](const svo::OctreeCell& cell, int faces)
      {
        const vtkIdType id = octree.surface()
          ? octree.surface()->cells[svo::nearestTriangle(octree, cell, level)]
          : -1;
        quads.add(cell.cell, faces);
        for (int f = svo::countBits(static_cast<unsigned>(faces)); f > 0; --f)
        {
          if (octree.surface())
          {
            cellIds->InsertNextValue(id);
          }
          for (auto& [values, copy] : leafArrays)
          {
            copy->InsertNextTuple(svo::firstLeaf(octree, cell), values);
          }
        }
        return goOn(0.3, 0.4);
      });
    if (svo::isAborted(this))
    {
      return 1;
    }
    quads.write(octree, level, input->GetPoints() ? input->GetPoints()->GetDataType() : VTK_FLOAT,
      output, [this] { this->UpdateProgress(0.8); });

    vtkNew<vtkIntArray> levels;
    levels->SetName("Level");
    levels->SetNumberOfValues(static_cast<vtkIdType>(count));
    levels->FillValue(level);
    output->GetCellData()->AddArray(levels);
    if (octree.surface())
    {
      output->GetCellData()->AddArray(cellIds);
    }
    for (auto& [values, copy] : leafArrays)
    {
      output->GetFieldData()->RemoveArray(copy->GetName());
      output->GetCellData()->AddArray(copy);
    }
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
