#include "vtkPPolyDataToSVO.h"

#include "svoControllerProcesses.h"

#include "svoAbort.h"
#include "svoMeshDetail.h"

#include "vtkBoundingBox.h"
#include "vtkDataObjectTree.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <vector>

namespace
{
/// A surface's place in the data: the numbers of the blocks that lead to it, as one number. Pieces
/// of one surface have the same.
using Place = std::uint64_t;
constexpr Place Top = 0xcbf29ce484222325ull;

Place blockOf(Place parent, unsigned int block)
{
  return (parent ^ (block + 1)) * 0x100000001b3ull; // FNV-1a
}

/// False if there is nothing to be bounded, or nothing finite.
bool findBounds(vtkPolyData* mesh, double bounds[6])
{
  if (mesh->GetNumberOfPolys() == 0 && mesh->GetNumberOfStrips() == 0)
  {
    return false;
  }
  mesh->GetCellsBounds(bounds);
  return bounds[0] <= bounds[1] &&
    std::all_of(bounds, bounds + 6, [](double b) { return std::abs(b) < 1e290; });
}

/// A piece, where it goes, and what it is a piece of.
struct Piece
{
  vtkPolyData* input;
  vtkPolyData* output;
  Place place;
};

vtkSmartPointer<vtkDataObject> copyOf(vtkDataObject* leaf, Place place, std::vector<Piece>& pieces)
{
  if (!leaf)
  {
    return nullptr;
  }
  auto copy = vtkSmartPointer<vtkDataObject>::Take(leaf->NewInstance());
  if (vtkPolyData* mesh = vtkPolyData::SafeDownCast(leaf))
  {
    pieces.push_back({ mesh, vtkPolyData::SafeDownCast(copy), place });
  }
  else
  {
    copy->ShallowCopy(leaf);
  }
  return copy;
}

/// Fills `output`, of the input's structure, with copies to be, of the leaves.
void addPieces(vtkDataObject* input, vtkDataObject* output, Place place, std::vector<Piece>& pieces)
{
  if (auto* from = vtkPartitionedDataSet::SafeDownCast(input)) // vtkMultiPieceDataSet is one, too
  {
    auto* to = vtkPartitionedDataSet::SafeDownCast(output);
    for (unsigned int i = 0; i < from->GetNumberOfPartitions(); ++i)
    {
      to->SetPartition(i, copyOf(from->GetPartitionAsDataObject(i), place, pieces));
    }
  }
  else if (auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(input))
  {
    auto* to = vtkPartitionedDataSetCollection::SafeDownCast(output);
    for (unsigned int i = 0; i < collection->GetNumberOfPartitionedDataSets(); ++i)
    {
      addPieces(collection->GetPartitionedDataSet(i), to->GetPartitionedDataSet(i),
        blockOf(place, i), pieces);
    }
  }
  else if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(input))
  {
    auto* to = vtkMultiBlockDataSet::SafeDownCast(output);
    for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      if (vtkDataObjectTree::SafeDownCast(blocks->GetBlock(i)))
      {
        addPieces(blocks->GetBlock(i), to->GetBlock(i), blockOf(place, i), pieces);
      }
      else
      {
        to->SetBlock(i, copyOf(blocks->GetBlock(i), blockOf(place, i), pieces));
      }
    }
  }
}

/// Bounds of a piece and the voxels that it needs, as processes tell each other.
struct Record
{
  Place place;
  double bounds[6];
  double voxel; // 0: as small as there are
};

/// What the pieces in a place are pieces of.
struct Whole
{
  vtkBoundingBox bounds;
  int pieces = 0;
  double voxel = 0.0;

  void add(const Record& piece)
  {
    this->bounds.AddBounds(piece.bounds);
    this->voxel = this->pieces == 0 ? piece.voxel : std::min(this->voxel, piece.voxel);
    ++this->pieces;
  }
};
}

vtkStandardNewMacro(vtkPPolyDataToSVO);
vtkCxxSetSmartPointerMacro(vtkPPolyDataToSVO, Controller, vtkMultiProcessController);

//------------------------------------------------------------------------------
vtkPPolyDataToSVO::vtkPPolyDataToSVO()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
}

vtkPPolyDataToSVO::~vtkPPolyDataToSVO() = default;

//------------------------------------------------------------------------------
vtkMultiProcessController* vtkPPolyDataToSVO::GetController() const
{
  return this->Controller;
}

//------------------------------------------------------------------------------
int vtkPPolyDataToSVO::FillInputPortInformation(int port, vtkInformation* info)
{
  this->Superclass::FillInputPortInformation(port, info);
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObjectTree");
  return 1;
}

int vtkPPolyDataToSVO::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

vtkTypeBool vtkPPolyDataToSVO::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->RequestDataObject(request, inputVector, outputVector);
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

int vtkPPolyDataToSVO::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  if (!input)
  {
    return 0;
  }
  if (!output || std::strcmp(output->GetClassName(), input->GetClassName()) != 0)
  {
    const auto made = vtkSmartPointer<vtkDataObject>::Take(input->NewInstance());
    outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkPPolyDataToSVO::ConvertInput(vtkDataObject* input, vtkDataObject* output)
{
  std::vector<Piece> all;
  if (auto* tree = vtkDataObjectTree::SafeDownCast(input))
  {
    vtkDataObjectTree::SafeDownCast(output)->CopyStructure(tree);
    output->GetFieldData()->ShallowCopy(input->GetFieldData());
    addPieces(input, output, Top, all);
  }
  else
  {
    all = { { vtkPolyData::SafeDownCast(input), vtkPolyData::SafeDownCast(output), Top } };
  }

  std::vector<Record> records;
  for (const Piece& piece : all)
  {
    Record record{ piece.place, {}, 0.0 };
    if (findBounds(piece.input, record.bounds))
    {
      record.voxel = this->AdaptedVoxel(piece.input);
      records.push_back(record);
    }
  }
  if (this->Controller && this->Controller->GetNumberOfProcesses() > 1)
  {
    svo::ControllerProcesses processes(this->Controller);
    const std::vector<Record> own = records;
    svo::gatherRecords(processes, own, records);
  }
  std::map<Place, Whole> wholes;
  for (const Record& record : records)
  {
    wholes[record.place].add(record);
  }

  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const Piece& piece = all[i];
    if (svo::isAborted(this))
    {
      piece.output->ShallowCopy(piece.input);
      continue;
    }
    const Whole& whole = wholes[piece.place]; // without pieces where no process has any
    vtkBoundingBox reach;
    reach.AddBounds(this->GetModelBounds());
    reach.AddBox(whole.bounds);
    double bounds[6];
    reach.GetBounds(bounds);
    this->SetProgressShiftScale(static_cast<double>(i) / static_cast<double>(all.size()),
      1.0 / static_cast<double>(all.size()));
    this->Convert(piece.input, piece.output, whole.pieces > 1 ? bounds : this->GetModelBounds(),
      svo::levelOfVoxel(bounds, whole.voxel, this->GetMaximumLevel()));
  }
  this->SetProgressShiftScale(0.0, 1.0);
}

//------------------------------------------------------------------------------
void vtkPPolyDataToSVO::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller.Get() << "\n";
}
