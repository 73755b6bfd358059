#include "vtkSVOVDBWriter.h"

#include "svoAbort.h"
#include "svoControllerProcesses.h"
#include "svoMeshOctree.h"
#include "svoProcesses.h"
#include "svoVDBFile.h"
#include "svoVDBLeaves.h"
#include "svoVDBLevelSet.h"
#include "svoVDBParts.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <exception>
#include <new>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSVOVDBWriter);
vtkCxxSetObjectMacro(vtkSVOVDBWriter, Controller, vtkMultiProcessController);

class vtkSVOVDBWriter::vtkInternals
{
public:
  vtkPolyData* Mesh;
  svo::Octree Octree;
  std::string Message; // why the octree could not be opened
  svo::Attached Attached;
  openvdb::GridCPtrVec Grids{};

  explicit vtkInternals(vtkPolyData* mesh)
    : Mesh(mesh)
    , Attached(svo::openAttachedOctree(mesh, this->Octree, this->Message))
  {
  }
  svo::Part Part() const
  {
    if (this->Attached == svo::Attached::Found)
    {
      return { svo::PartState::Octree, this->Octree.header().voxelCount };
    }
    const bool nothing =
      this->Attached == svo::Attached::None && this->Mesh->GetNumberOfCells() == 0;
    return { nothing ? svo::PartState::Nothing : svo::PartState::Wrong, 0 };
  }
};

//------------------------------------------------------------------------------
vtkSVOVDBWriter::vtkSVOVDBWriter()
{
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkSVOVDBWriter::~vtkSVOVDBWriter()
{
  this->SetController(nullptr);
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
int vtkSVOVDBWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
bool vtkSVOVDBWriter::IsParallel()
{
  return this->Controller && this->Controller->GetNumberOfProcesses() > 1;
}

//------------------------------------------------------------------------------
/// Each process asks for its part.
int vtkSVOVDBWriter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  if (request->Has(Pipeline::REQUEST_UPDATE_EXTENT()) && this->IsParallel())
  {
    vtkInformation* input = inputVector[0]->GetInformationObject(0);
    input->Set(Pipeline::UPDATE_PIECE_NUMBER(), this->Controller->GetLocalProcessId());
    input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), this->Controller->GetNumberOfProcesses());
    input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    return 1;
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
void vtkSVOVDBWriter::WriteData()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->FileName || !*this->FileName)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("Nothing is written: the file has no name.");
    return;
  }
  openvdb::initialize();
  vtkInternals own(vtkPolyData::SafeDownCast(this->GetInput()));
  this->UpdateProgress(0.0);
  try
  {
    this->IsParallel() ? this->WriteParts(own) : this->WriteAlone(own);
  }
  catch (const std::bad_alloc&)
  {
    this->SetErrorCode(vtkErrorCode::OutOfDiskSpaceError);
    vtkErrorMacro("Nothing is written: there is not enough memory for the grids.");
  }
  catch (const std::exception& failure)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    vtkErrorMacro("Nothing is written: " << failure.what() << ".");
  }
}

//------------------------------------------------------------------------------
void vtkSVOVDBWriter::WriteAlone(vtkInternals& own)
{
  if (own.Attached != svo::Attached::Found)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
    vtkErrorMacro("Nothing is written. " << svo::describe(own.Attached, own.Message));
    return;
  }
  this->MakeGrids(own, this->WriteLevelSet);
  if (!svo::isAborted(this))
  {
    this->WriteGrids(own);
  }
}

//------------------------------------------------------------------------------
/// All processes take the same way through this, whatever happens on one of them.
void vtkSVOVDBWriter::WriteParts(vtkInternals& own)
{
  svo::ControllerProcesses processes(this->Controller);
  const bool first = processes.self() == 0;
  int wrong = 0, octrees = 0, withVoxels = 0;
  std::vector<svo::Part> parts;
  svo::gatherRecords(processes, { own.Part() }, parts);
  for (const svo::Part& part : parts)
  {
    wrong += part.state == svo::PartState::Wrong;
    octrees += part.state == svo::PartState::Octree;
    withVoxels += part.voxels > 0;
  }
  if (wrong > 0 || octrees == 0)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
    if (first && wrong > 0)
    {
      vtkErrorMacro("Nothing is written: on "
        << wrong << " processes the surface has no octree of its own; vtkPolyDataToSVO makes one.");
    }
    else if (first)
    {
      vtkErrorMacro("Nothing is written. " << svo::describe(own.Attached, own.Message));
    }
    return;
  }
  const bool levelSet = this->WriteLevelSet && withVoxels <= 1;
  if (first && this->WriteLevelSet && !levelSet)
  {
    vtkWarningMacro("About the level set in " << this->FileName << ": it is left out, since "
                                              << withVoxels
                                              << " processes have parts of the surface.");
  }
  std::string message;
  try
  {
    if (own.Part().voxels > 0 || (withVoxels == 0 && own.Part().state == svo::PartState::Octree))
    {
      this->MakeGrids(own, levelSet);
    }
  }
  catch (const std::exception& failure)
  {
    own.Grids.clear();
    vtkErrorMacro("A part is not written: " << failure.what() << ".");
  }
  svo::joinGrids(processes, own.Grids, message);
  if (!message.empty())
  {
    this->SetErrorCode(vtkErrorCode::UserError);
    vtkErrorMacro("Nothing is written: " << message << ".");
  }
  else if (first && !own.Grids.empty())
  {
    this->WriteGrids(own);
  }
}

//------------------------------------------------------------------------------
void vtkSVOVDBWriter::MakeGrids(vtkInternals& own, bool levelSet)
{
  constexpr double LeavesShare = 0.2, FileShare = 0.2; // of the progress, about
  own.Grids.push_back(svo::leavesOf(own.Octree));
  if (levelSet)
  {
    const auto progress = [this](double share)
    { return svo::goesOn(this, LeavesShare + (1.0 - LeavesShare - FileShare) * share); };
    std::string message;
    const openvdb::FloatGrid::Ptr surface =
      svo::levelSetOf(own.Octree, own.Mesh, this->HalfWidth, progress, message);
    if (!message.empty())
    {
      vtkWarningMacro("About the level set in " << this->FileName << ": " << message << ".");
    }
    if (surface)
    {
      own.Grids.push_back(surface);
    }
  }
  this->UpdateProgress(1.0 - FileShare);
}

//------------------------------------------------------------------------------
void vtkSVOVDBWriter::WriteGrids(vtkInternals& own)
{
  openvdb::MetaMap metadata;
  metadata.insertMeta("creator", openvdb::StringMetadata("vtkSVO " VTKSVO_VERSION));
  const std::string reason = svo::writeVDBFile(this->FileName, own.Grids, metadata);
  if (!reason.empty())
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    vtkErrorMacro("The file " << this->FileName << " is not written: " << reason << ".");
    return;
  }
  this->UpdateProgress(1.0);
}

//------------------------------------------------------------------------------
void vtkSVOVDBWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "WriteLevelSet: " << (this->WriteLevelSet ? "On\n" : "Off\n");
  os << indent << "HalfWidth: " << this->HalfWidth << " voxels\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
