#include "vtkPolyDataToSVO.h"

#include "svoAbort.h"
#include "svoMeshOctree.h"
#include "svoOctreeCache.h"
#include "svoOctreeJobs.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

vtkStandardNewMacro(vtkPolyDataToSVO);

namespace
{
constexpr std::size_t Kibi = 1024;

/// The octree that a mesh brings along; any, or only what would be built.
svo::Octree carriedOctree(vtkPolyData* mesh, const svo::MeshOctreeOptions& options, bool any)
{
  svo::Octree octree;
  std::string ignored; // what is damaged is replaced
  if (svo::openAttachedOctree(mesh, octree, ignored) != svo::Attached::Found)
  {
    return {};
  }
  const bool same = octree.level() == options.level &&
    octree.header().leafGeometry == static_cast<std::uint32_t>(options.leafGeometry) &&
    svo::fitsModel(octree, options.modelBounds);
  return same || any ? octree : svo::Octree();
}

/// The octree that a mesh goes out with until its own is there: another of its octrees, else any
/// that it brings along.
void attachMeanwhile(vtkPolyData* mesh, const svo::OctreeCache::Entry* other)
{
  if (other)
  {
    svo::attachOctree(mesh, other->octree);
  }
  else if (!carriedOctree(mesh, {}, true))
  {
    svo::detachOctree(mesh);
  }
}

/// What there is to be said of an octree, or of one that could not be built. The mesh is a valid
/// output in any case, and one message is enough.
void report(vtkPolyDataToSVO* filter, vtkPolyData* mesh, const svo::Octree& octree,
  const std::string& message)
{
  if (!octree)
  {
    vtkErrorWithObjectMacro(filter, "The octree is not built: " << message << ".");
  }
  else if (!message.empty())
  {
    vtkWarningWithObjectMacro(filter, "The octree is not complete: " << message << ".");
  }
  else if (mesh->GetNumberOfPolys() == 0 && mesh->GetNumberOfStrips() == 0 &&
    mesh->GetNumberOfCells() > 0)
  {
    vtkWarningWithObjectMacro(
      filter, "The mesh has vertices and lines, but no polygons; its octree is empty.");
  }
  else if (const double* b = octree.header().meshBounds;
           octree.header().voxelCount > 0 && b[0] == b[1] && b[2] == b[3] && b[4] == b[5])
  {
    vtkWarningWithObjectMacro(filter, "All points of the mesh are in one place.");
  }
}
}

class vtkPolyDataToSVO::vtkInternals
{
public:
  svo::OctreeCache Cache;
  svo::OctreeJobs Jobs;
};

//------------------------------------------------------------------------------
vtkPolyDataToSVO::vtkPolyDataToSVO()
  : Internals(new vtkInternals)
{
}

vtkPolyDataToSVO::~vtkPolyDataToSVO() = default;

//------------------------------------------------------------------------------
const char* vtkPolyDataToSVO::GetLeafGeometryAsString()
{
  static const char* const names[] = { "Voxel", "Plane", "Triangle", "Automatic" };
  return names[this->LeafGeometry];
}

//------------------------------------------------------------------------------
// Neither the cache nor its limit changes the output, so they do not make it outdated.
void vtkPolyDataToSVO::SetCacheTimeSteps(bool cache)
{
  this->CacheTimeSteps = cache;
  if (!cache)
  {
    this->ReleaseCache();
  }
}

//------------------------------------------------------------------------------
void vtkPolyDataToSVO::SetCacheMemoryLimit(unsigned long kibibytes)
{
  this->CacheMemoryLimit = kibibytes;
  this->Internals->Cache.shrink(kibibytes * Kibi);
}

//------------------------------------------------------------------------------
void vtkPolyDataToSVO::ReleaseCache()
{
  this->Internals->Cache.shrink(0);
}

//------------------------------------------------------------------------------
unsigned long vtkPolyDataToSVO::GetCacheMemorySize()
{
  return static_cast<unsigned long>((this->Internals->Cache.bytes() + Kibi - 1) / Kibi);
}

//------------------------------------------------------------------------------
int vtkPolyDataToSVO::GetNumberOfCachedOctrees()
{
  return static_cast<int>(this->Internals->Cache.size());
}

//------------------------------------------------------------------------------
void vtkPolyDataToSVO::Finish(vtkPolyData* output)
{
  svo::Octree octree;
  std::string ignored;
  if (svo::openAttachedOctree(output, octree, ignored) != svo::Attached::Found)
  {
    return;
  }
  this->NumberOfVoxels = static_cast<vtkIdType>(octree.header().voxelCount);
  if (!this->WriteStatistics)
  {
    return;
  }
  const std::pair<const char*, double> statistics[] = { { "SVO Level", octree.level() },
    { "SVO Voxels", static_cast<double>(octree.header().voxelCount) },
    { "SVO Memory", std::ceil(octree.bytes() / static_cast<double>(Kibi)) },
    { "SVO Build Time", this->BuildTime } };
  for (const auto& statistic : statistics)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(statistic.first);
    array->InsertNextValue(statistic.second);
    output->GetFieldData()->AddArray(array);
  }
}

//------------------------------------------------------------------------------
// The output that there is stays what it is, but who wants to wait may have something to wait for.
void vtkPolyDataToSVO::SetBuildInBackground(bool background)
{
  this->BuildInBackground = background;
  if (!background && this->Preliminary)
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkPolyDataToSVO::GetNumberOfOctreesInProgress()
{
  return this->Internals->Jobs.count();
}

//------------------------------------------------------------------------------
int vtkPolyDataToSVO::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Preliminary = false;
  this->ConvertInput(vtkDataObject::GetData(inputVector[0]), vtkDataObject::GetData(outputVector));
  this->Internals->Jobs.endExecution();
  return 1;
}

//------------------------------------------------------------------------------
void vtkPolyDataToSVO::ConvertInput(vtkDataObject* input, vtkDataObject* output)
{
  this->Convert(
    vtkPolyData::SafeDownCast(input), vtkPolyData::SafeDownCast(output), this->ModelBounds);
}

//------------------------------------------------------------------------------
void vtkPolyDataToSVO::Convert(vtkPolyData* input, vtkPolyData* output, const double modelBounds[6])
{
  this->BuildTime = 0.0;
  this->NumberOfVoxels = 0;
  output->ShallowCopy(input);

  svo::MeshOctreeOptions options;
  options.level = this->MaximumLevel;
  options.leafGeometry = static_cast<svo::LeafGeometry>(this->LeafGeometry);
  std::copy(modelBounds, modelBounds + 6, options.modelBounds.begin());
  options.memoryLimit = this->MemoryLimit * Kibi;
  if (carriedOctree(input, options, this->KeepOctrees))
  {
    this->Finish(output);
    return;
  }

  vtkInternals& internals = *this->Internals;
  const svo::OctreeCache::Key key{ svo::meshSignature(input), options.level, options.leafGeometry,
    options.modelBounds };
  if (const auto* kept = this->CacheTimeSteps ? internals.Cache.find(key) : nullptr)
  {
    svo::attachOctree(output, kept->octree);
    this->Finish(output);
    return;
  }

  svo::BackgroundBuild::Result result;
  if (!internals.Jobs.ask(key, input, options, this->BuildInBackground, result))
  {
    if (this->BuildInBackground)
    {
      this->Preliminary = true;
      attachMeanwhile(output, internals.Cache.latest(key.signature, key.modelBounds));
      this->Finish(output);
      return;
    }
    options.progress = [this](double progress)
    {
      this->UpdateProgress(progress);
      return !svo::isAborted(this);
    };
    const double start = vtkTimerLog::GetUniversalTime();
    internals.Jobs.wait(key, input, options, result);
    this->BuildTime = vtkTimerLog::GetUniversalTime() - start;
  }

  svo::detachOctree(output);
  if (result.status == svo::BuildStatus::Built)
  {
    ++this->NumberOfBuilds;
    svo::attachOctree(output, result.octree);
    this->Finish(output);
    if (this->CacheTimeSteps)
    {
      internals.Cache.insert({ key, result.octree }, this->CacheMemoryLimit * Kibi);
    }
  }
  if (result.status != svo::BuildStatus::Aborted)
  {
    report(this, input, result.octree, result.message);
  }
}

//------------------------------------------------------------------------------
void vtkPolyDataToSVO::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumLevel: " << this->MaximumLevel << "\n";
  os << indent << "LeafGeometry: " << this->GetLeafGeometryAsString() << "\n";
  os << indent << "ModelBounds: (" << this->ModelBounds[0] << ", " << this->ModelBounds[1] << ", "
     << this->ModelBounds[2] << ", " << this->ModelBounds[3] << ", " << this->ModelBounds[4] << ", "
     << this->ModelBounds[5] << ")\n";
  os << indent << "CacheTimeSteps: " << (this->CacheTimeSteps ? "On\n" : "Off\n");
  os << indent << "CacheMemoryLimit: " << this->CacheMemoryLimit << " KiB\n";
  os << indent << "CacheMemorySize: " << this->GetCacheMemorySize() << " KiB\n";
  os << indent << "NumberOfCachedOctrees: " << this->GetNumberOfCachedOctrees() << "\n";
  os << indent << "KeepOctrees: " << (this->KeepOctrees ? "On\n" : "Off\n");
  os << indent << "BuildInBackground: " << (this->BuildInBackground ? "On\n" : "Off\n");
  os << indent << "NumberOfOctreesInProgress: " << this->GetNumberOfOctreesInProgress() << "\n";
  os << indent << "WriteStatistics: " << (this->WriteStatistics ? "On\n" : "Off\n");
  os << indent << "MemoryLimit: " << this->MemoryLimit << " KiB\n";
  os << indent << "NumberOfBuilds: " << this->NumberOfBuilds << "\n";
  os << indent << "BuildTime: " << this->BuildTime << " s\n";
  os << indent << "NumberOfVoxels: " << this->NumberOfVoxels << "\n";
}
