#include "vtkPolyDataToSVO.h"

#include "svoAbort.h"
#include "svoLeafTraits.h"
#include "svoMeshDetail.h"
#include "svoMeshOctree.h"
#include "svoOctreeLibrary.h"
#include "svoOwnedOctrees.h"

#include "vtkBoundingBox.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

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
  // What an octree of planes travels on is made of it.
  return same || any || octree.hasPlanes() ? octree : svo::Octree();
}

/// The octree that a mesh goes out with until its own is there: another of its octrees, else any
/// that it brings along.
void attachMeanwhile(vtkPolyData* mesh, const svo::OwnedOctree* other)
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
/// output in any case, and one message is enough. `saidIncomplete`: when that was said, by the
/// filter's own time.
void report(vtkPolyDataToSVO* filter, const svo::Octree& octree, const std::string& message,
  vtkMTimeType& saidIncomplete)
{
  if (!octree)
  {
    vtkErrorWithObjectMacro(filter, "The octree is not built: " << message << ".");
  }
  else if (!message.empty())
  {
    if (saidIncomplete != filter->GetMTime())
    {
      saidIncomplete = filter->GetMTime();
      vtkWarningWithObjectMacro(filter,
        "The octree is not complete: "
          << message << ". Of other time steps and blocks this is not said again.");
    }
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
  svo::OwnedOctrees Cache;
  std::map<std::uint64_t, double> Voxels; // by the signature of a mesh
  vtkMTimeType SaidIncomplete = 0;
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
  return svo::traitsOf(static_cast<svo::LeafGeometry>(this->LeafGeometry)).name;
}

//------------------------------------------------------------------------------
void vtkPolyDataToSVO::SetModelBounds(
  double xMin, double xMax, double yMin, double yMax, double zMin, double zMax)
{
  const double bounds[6] = { xMin, xMax, yMin, yMax, zMin, zMax };
  this->SetModelBounds(bounds);
}

//------------------------------------------------------------------------------
void vtkPolyDataToSVO::SetModelBounds(const double bounds[6])
{
  if (!std::all_of(bounds, bounds + 6, [](double b) { return std::isfinite(b); }))
  {
    vtkWarningMacro("ModelBounds stay as they are: those given are not finite.");
  }
  else if (!std::equal(bounds, bounds + 6, this->ModelBounds))
  {
    std::copy(bounds, bounds + 6, this->ModelBounds);
    this->Modified();
  }
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
  this->Internals->Cache.shrink(kibibytes * Kibi, false);
}

//------------------------------------------------------------------------------
void vtkPolyDataToSVO::ReleaseCache()
{
  this->Internals->Cache.clear();
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
  if (this->WriteStatistics)
  {
    svo::attachStatistics(output, octree, this->BuildTime);
  }
}

//------------------------------------------------------------------------------
void vtkPolyDataToSVO::SetBuildOctrees(bool build)
{
  this->BuildOctrees = build;
  if (build && !this->BuiltOctrees)
  {
    this->Modified(); // on all processes alike, see vtkPPolyDataToSVO
  }
}

//------------------------------------------------------------------------------
int vtkPolyDataToSVO::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->BuiltOctrees = this->BuildOctrees;
  this->ConvertInput(vtkDataObject::GetData(inputVector[0]), vtkDataObject::GetData(outputVector));
  return 1;
}

//------------------------------------------------------------------------------
void vtkPolyDataToSVO::ConvertInput(vtkDataObject* input, vtkDataObject* output)
{
  vtkPolyData* mesh = vtkPolyData::SafeDownCast(input);
  int level = this->MaximumLevel;
  if (const double voxel = this->AdaptedVoxel(mesh); voxel > 0.0)
  {
    double bounds[6];
    mesh->GetCellsBounds(bounds);
    vtkBoundingBox whole;
    whole.AddBounds(bounds);
    whole.AddBounds(this->ModelBounds); // nothing, where low is above high
    whole.GetBounds(bounds);
    level = svo::levelOfVoxel(bounds, voxel, level);
  }
  this->Convert(mesh, vtkPolyData::SafeDownCast(output), this->ModelBounds, level);
}

//------------------------------------------------------------------------------
double vtkPolyDataToSVO::AdaptedVoxel(vtkPolyData* mesh)
{
  constexpr std::size_t Most = 4096; // meshes to remember
  if (!this->AdaptLevel ||
    !svo::traitsOf(static_cast<svo::LeafGeometry>(this->LeafGeometry)).exact())
  {
    return 0.0;
  }
  auto& voxels = this->Internals->Voxels;
  const std::uint64_t signature = svo::meshSignature(mesh);
  const auto known = voxels.find(signature);
  if (known != voxels.end())
  {
    return known->second;
  }
  if (voxels.size() == Most)
  {
    voxels.clear();
  }
  return voxels[signature] = svo::detailVoxel(mesh);
}

//------------------------------------------------------------------------------
void vtkPolyDataToSVO::Convert(
  vtkPolyData* input, vtkPolyData* output, const double modelBounds[6], int level)
{
  this->BuildTime = 0.0;
  this->NumberOfVoxels = 0;
  output->ShallowCopy(input);

  svo::copySignature(input, output);

  svo::MeshOctreeOptions options;
  options.level = level;
  options.leafGeometry = static_cast<svo::LeafGeometry>(this->LeafGeometry);
  std::copy(modelBounds, modelBounds + 6, options.modelBounds.begin());
  options.memoryLimit = this->MemoryLimit * Kibi;
  if (carriedOctree(input, options, this->KeepOctrees))
  {
    this->Finish(output);
    return;
  }

  svo::OwnedOctrees& cache = this->Internals->Cache;
  options.signature = svo::meshSignature(input);
  const svo::OctreeKey key(options);
  cache.nextUse();
  cache.asked(key, false);
  const svo::OwnedOctree* kept = cache.find(key);
  if (!kept && !this->BuildOctrees)
  {
    attachMeanwhile(output, cache.latest(key));
    this->Finish(output);
    return;
  }

  std::string message;
  // That of another filter, or of a render pass, does as well.
  svo::Octree octree =
    kept ? kept->octree : svo::OctreeLibrary::instance().built.find(key, message);
  if (!octree)
  {
    svo::detachOctree(output);
    options.progress = [this](double progress) { return svo::goesOn(this, progress); };
    const double start = vtkTimerLog::GetUniversalTime();
    const svo::BuildStatus status = svo::buildMeshOctree(input, options, octree, message);
    this->BuildTime = vtkTimerLog::GetUniversalTime() - start;
    if (status == svo::BuildStatus::Aborted)
    {
      return;
    }
    this->NumberOfBuilds += octree ? 1 : 0;
  }
  if (octree)
  {
    svo::attachOctree(output, octree);
    this->Finish(output);
  }
  if (!kept)
  {
    report(this, octree, message, this->Internals->SaidIncomplete);
    cache.keepWithin(key, octree, this->CacheTimeSteps ? this->CacheMemoryLimit * Kibi : 0);
  }
}

//------------------------------------------------------------------------------
void vtkPolyDataToSVO::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumLevel: " << this->MaximumLevel << "\n";
  os << indent << "AdaptLevel: " << (this->AdaptLevel ? "On\n" : "Off\n");
  os << indent << "LeafGeometry: " << this->GetLeafGeometryAsString() << "\n";
  os << indent << "ModelBounds: (" << this->ModelBounds[0] << ", " << this->ModelBounds[1] << ", "
     << this->ModelBounds[2] << ", " << this->ModelBounds[3] << ", " << this->ModelBounds[4] << ", "
     << this->ModelBounds[5] << ")\n";
  os << indent << "CacheTimeSteps: " << (this->CacheTimeSteps ? "On\n" : "Off\n");
  os << indent << "CacheMemoryLimit: " << this->CacheMemoryLimit << " KiB\n";
  os << indent << "CacheMemorySize: " << this->GetCacheMemorySize() << " KiB\n";
  os << indent << "NumberOfCachedOctrees: " << this->GetNumberOfCachedOctrees() << "\n";
  os << indent << "KeepOctrees: " << (this->KeepOctrees ? "On\n" : "Off\n");
  os << indent << "BuildOctrees: " << (this->BuildOctrees ? "On\n" : "Off\n");
  os << indent << "WriteStatistics: " << (this->WriteStatistics ? "On\n" : "Off\n");
  os << indent << "MemoryLimit: " << this->MemoryLimit << " KiB\n";
  os << indent << "NumberOfBuilds: " << this->NumberOfBuilds << "\n";
  os << indent << "BuildTime: " << this->BuildTime << " s\n";
  os << indent << "NumberOfVoxels: " << this->NumberOfVoxels << "\n";
}
