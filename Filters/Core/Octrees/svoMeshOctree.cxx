#include "svoMeshOctree.h"

#include "svoKnownRange.h"
#include "svoMeshTriangles.h"
#include "svoOctreeLibrary.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <vtksys/SystemInformation.hxx>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <utility>

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vector_relational.hpp>

namespace svo
{
namespace
{
/// Bytes of an octree's own, aligned as Octree::open() wants them.
std::shared_ptr<const std::byte> ownBytes(const void* bytes, std::size_t size)
{
  std::shared_ptr<std::byte> own(
    static_cast<std::byte*>(::operator new(size)), [](std::byte* p) { ::operator delete(p); });
  std::memcpy(own.get(), bytes, size);
  return own;
}

glm::dvec3 lowOf(const std::array<double, 6>& bounds)
{
  return { bounds[0], bounds[2], bounds[4] };
}

glm::dvec3 highOf(const std::array<double, 6>& bounds)
{
  return { bounds[1], bounds[3], bounds[5] };
}

/// Bounds of the finite points, as they are stored in the header. A part of something counts as
/// large as the whole: lights' views are fitted to that, for parts as for the whole.
void finiteBounds(const TriangleMesh& mesh, const std::array<double, 6>& model, double bounds[6])
{
  std::copy(NoBounds.begin(), NoBounds.end(), bounds);
  const auto add = [&](const glm::dvec3& p)
  {
    for (int i = 0; i < 3; ++i)
    {
      if (std::isfinite(p[i]))
      {
        const bool first = bounds[2 * i] > bounds[2 * i + 1];
        bounds[2 * i] = first ? p[i] : std::min(bounds[2 * i], p[i]);
        bounds[2 * i + 1] = first ? p[i] : std::max(bounds[2 * i + 1], p[i]);
      }
    }
  };
  std::for_each(mesh.points, mesh.points + mesh.pointCount, add);
  if (model[0] <= model[1])
  {
    add(lowOf(model));
    add(highOf(model));
  }
}

BuildStatus buildUnguarded(
  vtkPolyData* mesh, const MeshOctreeOptions& options, Octree& octree, std::string& message)
{
  MeshTriangles triangles(mesh);
  if (!triangles.addressable())
  {
    message = "the mesh has more points, cells or triangles than an octree can number";
    return BuildStatus::BadInput;
  }
  const TriangleMesh view = triangles.view();
  const std::size_t memory = options.memoryLimit != 0 ? options.memoryLimit : availableMemory();
  BuildResult result = build(view,
    { options.level, options.leafGeometry, lowOf(options.modelBounds), highOf(options.modelBounds),
      glm::dmat4(1.0), memory, options.parallelFor, options.progress });
  if (result.status != BuildStatus::Built)
  {
    message = result.status == BuildStatus::Aborted ? std::string() : result.message;
    return result.status;
  }

  Header& header = *reinterpret_cast<Header*>(result.data.get());
  header.signature = options.signature != 0 ? options.signature : meshSignature(mesh);
  header.pointCount = view.pointCount;
  header.cellCount = static_cast<std::uint64_t>(mesh->GetNumberOfCells());
  const OctreeKey key{ header.signature, options.level, options.leafGeometry, options.modelBounds };
  finiteBounds(view, key.modelBounds, header.meshBounds);
  const auto surface = makeSurface(view, std::move(triangles.cells()), header, options.parallelFor);
  octree = Octree::open(std::move(result.data), result.size, surface, message);
  if (!octree)
  {
    return BuildStatus::BadInput;
  }
  if (result.droppedTriangles > 0)
  {
    message = std::to_string(result.droppedTriangles) + " of the mesh's " +
      std::to_string(view.triangleCount) +
      " triangles have points that are not finite; they are left out of the octree";
  }
  if (triangles.brokenCells() > 0)
  {
    message += (message.empty() ? "" : ", and ") + std::to_string(triangles.brokenCells()) +
      " cells name points that do not exist; they are left out of the octree";
  }
  OctreeLibrary::instance().built.add(key, octree, message);
  return BuildStatus::Built;
}
}

BuildStatus buildMeshOctree(
  vtkPolyData* mesh, const MeshOctreeOptions& options, Octree& octree, std::string& message)
{
  octree = {};
  message.clear();
  try
  {
    return buildUnguarded(mesh, options, octree, message);
  }
  catch (const std::bad_alloc&)
  {
    octree = {};
    message = "there is not enough memory for an octree of level " + std::to_string(options.level);
    return BuildStatus::TooLarge;
  }
}

bool fitsModel(const Octree& octree, const std::array<double, 6>& modelBounds)
{
  const glm::dvec3 low = lowOf(modelBounds), high = highOf(modelBounds);
  if (!glm::all(glm::lessThanEqual(low, high)))
  {
    return true;
  }
  const Header& header = octree.header();
  const double* own = header.meshBounds;
  const bool empty = !(own[0] <= own[1]);
  const Cube cube = empty ? boundingCube(low, high, octree.level())
                          : boundingCube(glm::min(low, glm::dvec3(own[0], own[2], own[4])),
                              glm::max(high, glm::dvec3(own[1], own[3], own[5])), octree.level());
  return cube.origin == glm::dvec3(header.origin[0], header.origin[1], header.origin[2]) &&
    std::ldexp(cube.edge, -octree.level()) == header.voxelSize;
}

void attachOctree(vtkPolyData* mesh, const Octree& octree)
{
  const std::size_t size = bufferSize(octree.header());
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName(OctreeArrayName);
  array->SetNumberOfValues(static_cast<vtkIdType>(size));
  std::memcpy(array->GetPointer(0), octree.key(), size);
  // It means nothing, and any byte may be there: ParaView's Information panel and writers ask.
  const double range[2] = { 0.0, 255.0 };
  tellRange(array, range, range);
  mesh->GetFieldData()->AddArray(array); // replaces an array of the same name
  OctreeLibrary::instance().ofArrays.add({ array, array->GetMTime() }, octree, {});
}

void attachStatistics(vtkPolyData* mesh, const Octree& octree, double buildTime)
{
  constexpr double Kibi = 1024.0;
  const std::pair<const char*, double> statistics[] = { { "SVO Level", octree.level() },
    { "SVO Voxels", static_cast<double>(octree.header().voxelCount) },
    { "SVO Memory", std::ceil(static_cast<double>(octree.bytes()) / Kibi) },
    { "SVO Build Time", buildTime } };
  for (const auto& [name, value] : statistics)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    mesh->GetFieldData()->AddArray(array);
  }
}

void detachOctree(vtkPolyData* mesh)
{
  mesh->GetFieldData()->RemoveArray(OctreeArrayName);
}

Attached openAttachedOctree(vtkPolyData* mesh, Octree& octree, std::string& message)
{
  octree = {};
  message.clear();
  vtkFieldData* field = mesh->GetFieldData();
  vtkAbstractArray* any = field ? field->GetAbstractArray(OctreeArrayName) : nullptr;
  if (!any)
  {
    return Attached::None;
  }
  auto* array = vtkUnsignedCharArray::FastDownCast(any);
  if (!array || static_cast<std::size_t>(array->GetNumberOfValues()) < sizeof(Header))
  {
    message = "the field-data array that should hold the octree is too short, or not of bytes";
    return Attached::Damaged;
  }
  try
  {
    const auto size = static_cast<std::size_t>(array->GetNumberOfValues());
    const unsigned char* theirs = array->GetPointer(0);
    octree = OctreeLibrary::instance().ofArrays.find({ array, array->GetMTime() }, message);
    Header header;
    std::memcpy(&header, octree ? octree.key() : theirs, sizeof(Header));
    if (std::memcmp(header.magic, LayoutMagic, sizeof(LayoutMagic)) == 0 &&
      header.version == LayoutVersion && header.signature != meshSignature(mesh))
    {
      octree = {};
      return Attached::Foreign;
    }
    if (octree)
    {
      return Attached::Found;
    }
    // A surface made from a damaged header is of no use, but harmless: open() refuses both.
    std::shared_ptr<const Surface> surface;
    if (header.leafWords == 0)
    {
      MeshTriangles triangles(mesh);
      surface =
        makeSurface(triangles.view(), std::move(triangles.cells()), header, smpParallelFor());
    }
    octree = Octree::open(ownBytes(theirs, size), size, surface, message);
    if (octree)
    {
      OctreeLibrary::instance().ofArrays.add({ array, array->GetMTime() }, octree, {});
    }
    return octree ? Attached::Found : Attached::Damaged;
  }
  catch (const std::bad_alloc&)
  {
    octree = {};
    message = "there is not enough memory to open the octree";
    return Attached::Damaged;
  }
}

bool carriesPlanes(vtkPolyData* mesh)
{
  Octree octree;
  std::string message;
  return mesh->GetFieldData()->HasArray(OctreeArrayName) &&
    openAttachedOctree(mesh, octree, message) == Attached::Found && octree.hasPlanes();
}

std::string describe(Attached state, const std::string& message)
{
  switch (state)
  {
    case Attached::None:
      return "The mesh carries no octree; vtkPolyDataToSVO makes one.";
    case Attached::Foreign:
      return "The octree that the mesh carries was built from another mesh, or from this one "
             "before "
             "it changed; vtkPolyDataToSVO makes one that fits.";
    case Attached::Damaged:
      return "The octree that the mesh carries cannot be used: " + message + ".";
    case Attached::Found:
      break;
  }
  return {};
}

std::size_t availableMemory()
{
  vtksys::SystemInformation system;
  const long long total = system.GetProcMemoryAvailable(); // KiB; honours resource limits
  const long long used = system.GetHostMemoryUsed();
  const long long hostTotal = system.GetHostMemoryTotal();
  if (total <= 0 || used <= 0 || hostTotal <= 0)
  {
    return 0;
  }
  long long available = std::min(hostTotal - used, total - system.GetProcMemoryUsed());
  // A container or a batch job may have less than the machine it runs on.
  std::ifstream limitFile("/sys/fs/cgroup/memory.max");
  std::ifstream currentFile("/sys/fs/cgroup/memory.current");
  long long limit = 0;
  long long current = 0;
  if (limitFile >> limit && currentFile >> current)
  {
    available = std::min(available, (limit - current) / 1024);
  }
  return available > 1 ? static_cast<std::size_t>(available) * 1024 : 1;
}
}
