#include "vtkSVOVDBReader.h"

#include "svoAbort.h"
#include "svoLeafValues.h"
#include "svoSMPParallel.h"
#include "svoVDBColors.h"
#include "svoVDBFile.h"
#include "svoVDBOctree.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <system_error>
#include <vector>

vtkStandardNewMacro(vtkSVOVDBReader);

namespace
{
constexpr char MetadataArray[] = "VDBMetadata";

/// VTK's code for why a file that OpenVDB did not read could not be.
unsigned long errorOf(const char* file, bool isOpenVDB, bool noSuchGrid, const std::string& reason)
{
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
  {
    return vtkErrorCode::FileNotFoundError;
  }
  if (!std::ifstream(file, std::ios::binary))
  {
    return vtkErrorCode::CannotOpenFileError;
  }
  if (!isOpenVDB)
  {
    return vtkErrorCode::UnrecognizedFileTypeError;
  }
  if (noSuchGrid)
  {
    return vtkErrorCode::UserError;
  }
  return reason == svo::EndsTooEarly ? vtkErrorCode::PrematureEndOfFileError
                                     : vtkErrorCode::FileFormatError;
}
}

class vtkSVOVDBReader::vtkInternals
{
public:
  std::vector<std::string> Files;
  svo::VDBContents Contents; // of the first file; empty without one
  vtkNew<vtkStringArray> GridNames;
  std::string Known; // the file whose contents these are, and when it was written
  std::filesystem::file_time_type KnownTime;
};

//------------------------------------------------------------------------------
vtkSVOVDBReader::vtkSVOVDBReader()
  : Internals(new vtkInternals)
{
  this->SetNumberOfInputPorts(0);
}

vtkSVOVDBReader::~vtkSVOVDBReader() = default;

//------------------------------------------------------------------------------
template <class T>
void vtkSVOVDBReader::Set(T& own, const T& value)
{
  if (value != own)
  {
    own = value;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkSVOVDBReader::SetFileName(const char* fileName)
{
  std::vector<std::string> files;
  if (fileName && *fileName)
  {
    files.emplace_back(fileName);
  }
  this->Set(this->Internals->Files, files);
}

//------------------------------------------------------------------------------
const char* vtkSVOVDBReader::GetFileName()
{
  return this->GetFileName(0);
}

//------------------------------------------------------------------------------
void vtkSVOVDBReader::AddFileName(const char* fileName)
{
  if (fileName && *fileName)
  {
    this->Internals->Files.emplace_back(fileName);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkSVOVDBReader::RemoveAllFileNames()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
int vtkSVOVDBReader::GetNumberOfFileNames()
{
  return static_cast<int>(this->Internals->Files.size());
}

//------------------------------------------------------------------------------
const char* vtkSVOVDBReader::GetFileName(int i)
{
  return i >= 0 && i < this->GetNumberOfFileNames()
    ? this->Internals->Files[static_cast<std::size_t>(i)].c_str()
    : nullptr;
}

//------------------------------------------------------------------------------
int vtkSVOVDBReader::CanReadFile(const char* fileName)
{
  // OPENVDB_MAGIC, as 64 bits
  constexpr char Magic[8] = { 0x20, 0x42, 0x44, 0x56, 0, 0, 0, 0 };
  char first[sizeof(Magic)] = {};
  std::ifstream in(fileName ? fileName : "", std::ios::binary);
  return in.read(first, sizeof(first)) && std::memcmp(first, Magic, sizeof(Magic)) == 0 ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkSVOVDBReader::SetGridName(const char* name)
{
  this->Set(this->GridName, std::string(name ? name : ""));
}

//------------------------------------------------------------------------------
void vtkSVOVDBReader::SetColorGridName(const char* name)
{
  this->Set(this->ColorGridName, std::string(name ? name : ""));
}

//------------------------------------------------------------------------------
void vtkSVOVDBReader::SetThreshold(double threshold)
{
  if (std::isnan(threshold))
  {
    vtkErrorMacro("The threshold has to be a number; it stays " << this->Threshold << ".");
  }
  else
  {
    this->Set(this->Threshold, threshold);
  }
}

//------------------------------------------------------------------------------
/// Why they could not be read, if that was tried now.
std::string vtkSVOVDBReader::ReadContents()
{
  vtkInternals& own = *this->Internals;
  const std::string file = own.Files.empty() ? std::string() : own.Files.front();
  std::error_code ignored; // what cannot be opened says so below
  const auto written = std::filesystem::last_write_time(file, ignored);
  if (own.Known == file && own.KnownTime == written)
  {
    return {};
  }
  own.Known = file;
  own.KnownTime = written;
  own.Contents = {};
  std::string reason = file.empty() ? std::string() : svo::readVDBContents(file, own.Contents);
  own.GridNames->Initialize();
  for (const std::string& name : own.Contents.grids)
  {
    own.GridNames->InsertNextValue(name);
  }
  return reason;
}

//------------------------------------------------------------------------------
int vtkSVOVDBReader::GetNumberOfGrids()
{
  const std::string reason = this->ReadContents();
  if (!reason.empty())
  {
    vtkErrorMacro("The file " << this->GetFileName() << " cannot be read: " << reason << ".");
  }
  return static_cast<int>(this->GetGridNames()->GetNumberOfValues());
}

//------------------------------------------------------------------------------
const char* vtkSVOVDBReader::GetGridName(int i)
{
  return i >= 0 && i < this->GetNumberOfGrids()
    ? this->Internals->Contents.grids[static_cast<std::size_t>(i)].c_str()
    : nullptr;
}

//------------------------------------------------------------------------------
vtkStringArray* vtkSVOVDBReader::GetGridNames()
{
  this->ReadContents();
  return this->Internals->GridNames;
}

//------------------------------------------------------------------------------
int vtkSVOVDBReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* information = outputVector->GetInformationObject(0);
  information->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  information->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  const int count = this->GetNumberOfFileNames();
  if (count > 1)
  {
    std::vector<double> times(static_cast<std::size_t>(count));
    std::iota(times.begin(), times.end(), 0.0);
    const double range[2] = { times.front(), times.back() };
    information->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), count);
    information->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
  }
  return 1;
}

//------------------------------------------------------------------------------
/// The file of the time that is asked for: that of the last step which is not later.
const char* vtkSVOVDBReader::FileOfStep(vtkInformationVector* outputVector)
{
  vtkInformation* information = outputVector->GetInformationObject(0);
  const int count = this->GetNumberOfFileNames();
  int step = 0;
  if (count > 1)
  {
    const double time = information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    const double last = count - 1;
    step = time >= 0.0 ? static_cast<int>(std::floor(std::min(time, last))) : 0;
    information->Get(vtkDataObject::DATA_OBJECT())
      ->GetInformation()
      ->Set(vtkDataObject::DATA_TIME_STEP(), step);
  }
  return this->GetFileName(step);
}

//------------------------------------------------------------------------------
/// False if it was aborted.
bool vtkSVOVDBReader::ColorBy(const char* file, const svo::SourceOctree& built,
  const svo::VDBOptions& options, vtkPolyData* output)
{
  const std::string& name = this->ColorGridName;
  if (name.empty() || name == "None" || built.voxels == 0)
  {
    return true;
  }
  openvdb::GridBase::ConstPtr grid;
  svo::VDBContents contents;
  std::string reason = svo::readVDBGrid(file, name, grid, contents);
  bool aborted = false;
  if (reason.empty())
  {
    const auto progress = [&](double done)
    {
      aborted = aborted || !options.progress(done);
      return !aborted;
    };
    const auto values = svo::valuesAtLeaves(*grid, built, options.parallelFor, progress);
    if (values)
    {
      values->SetName(name.c_str());
      svo::attachLeafValues(output, built, values);
    }
    else
    {
      reason = "grids of " + grid->valueType() + " have no numbers for colours";
    }
  }
  if (!reason.empty() && !aborted)
  {
    vtkWarningMacro("The octree of " << file << " has no colours: " << reason << ".");
  }
  return !aborted;
}

//------------------------------------------------------------------------------
int vtkSVOVDBReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->ReadTime = 0.0;
  this->MetaData.clear();
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* output = this->Begin(outputVector);
  const char* file = this->FileOfStep(outputVector);
  if (!file)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("There is no file to read: its name is not set.");
    return 1;
  }
  this->UpdateProgress(0.0);
  const double start = vtkTimerLog::GetUniversalTime();
  openvdb::GridBase::ConstPtr grid;
  svo::VDBContents contents;
  const std::string reason = svo::readVDBGrid(file, this->GridName, grid, contents);
  if (!reason.empty())
  {
    const bool noSuchGrid =
      !contents.grids.empty() && svo::uniqueName(contents, this->GridName).empty();
    this->SetErrorCode(errorOf(file, this->CanReadFile(file) != 0, noSuchGrid, reason));
    vtkErrorMacro("The file " << file << " cannot be read: " << reason << ".");
    return 1;
  }
  const double read = vtkTimerLog::GetUniversalTime();
  constexpr double ReadShare = 0.3, BuildShare = 0.6; // of the progress, about
  constexpr std::size_t Kibi = 1024;
  svo::VDBOptions options;
  options.conversion = static_cast<svo::VDBConversion>(this->Conversion);
  options.threshold = this->Threshold;
  options.memoryLimit = this->MemoryLimit * Kibi;
  options.carrier.cells = static_cast<std::size_t>(this->MaximumNumberOfQuads);
  options.parallelFor = svo::smpParallelFor();
  double begun = ReadShare, share = BuildShare;
  options.progress = [&](double progress) { return svo::goesOn(this, begun + share * progress); };
  const svo::SourceOctree built = svo::octreeOfGrid(*grid, options, output);
  this->ReadTime = read - start;
  this->NoteBuilt(built, read, output);
  if (!built.message.empty())
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    vtkErrorMacro("The grid \"" << grid->getName() << "\" of " << file
                                << " has no octree: " << built.message << ".");
    return 1;
  }
  if (built.status != svo::BuildStatus::Built)
  {
    return 1; // aborted
  }
  begun = ReadShare + BuildShare;
  share = 1.0 - begun;
  if (!this->ColorBy(file, built, options, output))
  {
    output->Initialize();
    this->NumberOfVoxels = 0;
    return 1;
  }
  if (built.voxels == 0)
  {
    const bool surface = svo::isSurface(*grid, options.conversion);
    vtkWarningMacro("The grid \"" << grid->getName() << "\" of " << file << " is empty: it has no "
                                  << (surface ? "voxel that its surface passes."
                                              : "active voxel above the threshold."));
  }
  std::vector<std::string> lines = svo::metadataOf(*grid);
  lines.insert(lines.begin(), "grid: " + grid->getName());
  lines.insert(lines.end(), contents.metadata.begin(), contents.metadata.end());
  vtkNew<vtkStringArray> array;
  array->SetName(MetadataArray);
  for (const std::string& line : lines)
  {
    array->InsertNextValue(line);
    this->MetaData += line + "\n";
  }
  output->GetFieldData()->AddArray(array);
  return 1;
}

//------------------------------------------------------------------------------
void vtkSVOVDBReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileNames:";
  for (const std::string& name : this->Internals->Files)
  {
    os << " " << name;
  }
  os << "\n";
  constexpr const char* Names[] = { "Automatic", "Surface", "Voxels" };
  os << indent << "GridName: " << this->GridName << "\n";
  os << indent << "ColorGridName: " << this->ColorGridName << "\n";
  os << indent << "Conversion: " << Names[this->Conversion] << "\n";
  os << indent << "Threshold: " << this->Threshold << "\n";
  os << indent << "ReadTime: " << this->ReadTime << " s\n";
  os << indent << "MetaData: " << this->MetaData << "\n";
}
