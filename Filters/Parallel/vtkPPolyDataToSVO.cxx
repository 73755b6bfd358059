#include "vtkPPolyDataToSVO.h"

#include "svoControllerProcesses.h"

#include "svoAbort.h"
#include "svoMeshDetail.h"

#include "vtkDataObjectTree.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
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

using Bounds = std::array<double, 6>;
constexpr Bounds Nothing = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };

bool isNothing(const Bounds& b)
{
  return !(b[0] <= b[1]);
}

Bounds boundsOf(vtkPolyData* mesh)
{
  Bounds bounds = Nothing;
  if (mesh->GetNumberOfPolys() > 0 || mesh->GetNumberOfStrips() > 0)
  {
    mesh->GetCellsBounds(bounds.data());
  }
  const bool finite =
    std::all_of(bounds.begin(), bounds.end(), [](double b) { return std::abs(b) < 1e290; });
  return finite ? bounds : Nothing;
}

/// A piece, where it goes, and what it is a piece of.
struct Piece
{
  vtkPolyData* input;
  vtkPolyData* output;
  Place place;
};

class Pieces
{
public:
  /// Fills `output`, of the input's structure, with copies to be, of the leaves.
  void add(vtkDataObject* input, vtkDataObject* output, Place place);

  const std::vector<Piece>& all() const { return this->All; }

private:
  vtkSmartPointer<vtkDataObject> copyOf(vtkDataObject* leaf, Place place);

  std::vector<Piece> All;
};

vtkSmartPointer<vtkDataObject> Pieces::copyOf(vtkDataObject* leaf, Place place)
{
  if (!leaf)
  {
    return nullptr;
  }
  auto copy = vtkSmartPointer<vtkDataObject>::Take(leaf->NewInstance());
  if (vtkPolyData* mesh = vtkPolyData::SafeDownCast(leaf))
  {
    this->All.push_back({ mesh, vtkPolyData::SafeDownCast(copy), place });
  }
  else
  {
    copy->ShallowCopy(leaf);
  }
  return copy;
}

void Pieces::add(vtkDataObject* input, vtkDataObject* output, Place place)
{
  if (auto* from = vtkPartitionedDataSet::SafeDownCast(input)) // vtkMultiPieceDataSet is one, too
  {
    auto* to = vtkPartitionedDataSet::SafeDownCast(output);
    for (unsigned int i = 0; i < from->GetNumberOfPartitions(); ++i)
    {
      to->SetPartition(i, this->copyOf(from->GetPartitionAsDataObject(i), place));
    }
  }
  else if (auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(input))
  {
    auto* to = vtkPartitionedDataSetCollection::SafeDownCast(output);
    for (unsigned int i = 0; i < collection->GetNumberOfPartitionedDataSets(); ++i)
    {
      this->add(
        collection->GetPartitionedDataSet(i), to->GetPartitionedDataSet(i), blockOf(place, i));
    }
  }
  else if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(input))
  {
    auto* to = vtkMultiBlockDataSet::SafeDownCast(output);
    for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      if (vtkDataObjectTree::SafeDownCast(blocks->GetBlock(i)))
      {
        this->add(blocks->GetBlock(i), to->GetBlock(i), blockOf(place, i));
      }
      else
      {
        to->SetBlock(i, this->copyOf(blocks->GetBlock(i), blockOf(place, i)));
      }
    }
  }
}

/// Bounds of a piece and the voxels that it needs, as processes tell each other.
struct Record
{
  Place place;
  Bounds bounds;
  double voxel; // 0: as small as there are
};

/// What the pieces in a place are pieces of.
struct Whole
{
  Bounds bounds = Nothing;
  int pieces = 0;
  double voxel = 0.0;

  void add(const Record& piece)
  {
    Bounds& b = this->bounds;
    const bool first = this->pieces == 0;
    for (int i = 0; i < 6; i += 2)
    {
      b[i] = first ? piece.bounds[i] : std::min(b[i], piece.bounds[i]);
      b[i + 1] = first ? piece.bounds[i + 1] : std::max(b[i + 1], piece.bounds[i + 1]);
    }
    this->voxel = first ? piece.voxel : std::min(this->voxel, piece.voxel);
    ++this->pieces;
  }
};
}

vtkStandardNewMacro(vtkPPolyDataToSVO);

//------------------------------------------------------------------------------
vtkPPolyDataToSVO::vtkPPolyDataToSVO()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
}

vtkPPolyDataToSVO::~vtkPPolyDataToSVO() = default;

//------------------------------------------------------------------------------
void vtkPPolyDataToSVO::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

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
  Pieces pieces;
  std::vector<Piece> all;
  if (auto* tree = vtkDataObjectTree::SafeDownCast(input))
  {
    vtkDataObjectTree::SafeDownCast(output)->CopyStructure(tree);
    output->GetFieldData()->ShallowCopy(input->GetFieldData());
    pieces.add(input, output, Top);
    all = pieces.all();
  }
  else
  {
    all = { { vtkPolyData::SafeDownCast(input), vtkPolyData::SafeDownCast(output), Top } };
  }

  std::vector<Record> records;
  for (const Piece& piece : all)
  {
    const Bounds bounds = boundsOf(piece.input);
    if (!isNothing(bounds))
    {
      records.push_back({ piece.place, bounds, this->AdaptedVoxel(piece.input) });
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
    const auto found = wholes.find(piece.place);
    const Whole whole = found != wholes.end() ? found->second : Whole();
    Bounds model;
    std::copy(this->GetModelBounds(), this->GetModelBounds() + 6, model.begin());
    Bounds reach = isNothing(model) ? whole.bounds : model;
    for (int k = 0; k < 6 && whole.pieces > 0; k += 2)
    {
      reach[k] = std::min(reach[k], whole.bounds[k]);
      reach[k + 1] = std::max(reach[k + 1], whole.bounds[k + 1]);
    }
    if (whole.pieces > 1)
    {
      model = reach;
    }
    this->SetProgressShiftScale(static_cast<double>(i) / static_cast<double>(all.size()),
      1.0 / static_cast<double>(all.size()));
    this->Convert(piece.input, piece.output, model.data(),
      svo::levelOfVoxel(reach.data(), whole.voxel, this->GetMaximumLevel()));
  }
  this->SetProgressShiftScale(0.0, 1.0);
}

//------------------------------------------------------------------------------
void vtkPPolyDataToSVO::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller.Get() << "\n";
}
