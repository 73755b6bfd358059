#include "vtkSVOVDBWriter.h"

#include "svoAbort.h"
#include "svoMeshOctree.h"
#include "svoVDBFile.h"
#include "svoVDBLeaves.h"
#include "svoVDBLevelSet.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <exception>
#include <new>
#include <string>

vtkStandardNewMacro(vtkSVOVDBWriter);

//------------------------------------------------------------------------------
vtkSVOVDBWriter::~vtkSVOVDBWriter()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
int vtkSVOVDBWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
void vtkSVOVDBWriter::WriteData()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  auto* mesh = vtkPolyData::SafeDownCast(this->GetInput());
  if (!this->FileName || !*this->FileName)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("Nothing is written: the file has no name.");
    return;
  }
  try
  {
    this->WriteOctree(mesh);
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
void vtkSVOVDBWriter::WriteOctree(vtkPolyData* mesh)
{
  svo::Octree octree;
  std::string message;
  const svo::Attached attached = svo::openAttachedOctree(mesh, octree, message);
  if (attached != svo::Attached::Found)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
    vtkErrorMacro("Nothing is written. " << svo::describe(attached, message));
    return;
  }
  constexpr double LeavesShare = 0.2, FileShare = 0.2; // of the progress, about
  openvdb::initialize();
  openvdb::GridCPtrVec grids;
  this->UpdateProgress(0.0);
  grids.push_back(svo::leavesOf(octree));
  if (this->WriteLevelSet)
  {
    const auto progress = [this](double share)
    {
      this->UpdateProgress(LeavesShare + (1.0 - LeavesShare - FileShare) * share);
      return !svo::isAborted(this);
    };
    const openvdb::FloatGrid::Ptr surface =
      svo::levelSetOf(octree, mesh, this->HalfWidth, progress, message);
    if (!message.empty())
    {
      vtkWarningMacro("About the level set in " << this->FileName << ": " << message << ".");
    }
    if (surface)
    {
      grids.push_back(surface);
    }
  }
  this->UpdateProgress(1.0 - FileShare);
  if (svo::isAborted(this))
  {
    return;
  }
  openvdb::MetaMap metadata;
  metadata.insertMeta("creator", openvdb::StringMetadata("vtkSVO " VTKSVO_VERSION));
  const std::string reason = svo::writeVDBFile(this->FileName, grids, metadata);
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
}
