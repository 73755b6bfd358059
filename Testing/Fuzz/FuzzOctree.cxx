// The octree arrives from files: whatever bytes a file has in the place of an octree, they are
// refused with a message or traced harmlessly, never out of bounds, never endlessly.
//
// One input is the content of the field-data array. The mesh is always svofuzz::mesh(); its
// signature is written into the header first, since a signature is no protection from somebody who
// wants to do harm, and without it every input would be refused at once.
#include "svoFuzzMesh.h"

#include "svoCPUTracer.h"
#include "svoIntersect.h"
#include "svoMeshOctree.h"
#include "svoTraverse.h"
#include "vtkSVOToHyperTreeGrid.h"
#include "vtkSVOToPolyData.h"
#include "vtkSparseVoxelOctree.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

#include <glm/gtc/matrix_transform.hpp>

namespace
{
using namespace svo;

[[noreturn]] void fail(const char* what)
{
  std::fprintf(stderr, "FuzzOctree: %s\n", what);
  std::abort(); // a finding, for libFuzzer and for the replay alike
}

/// A copy of the input that ends where the accessible memory ends: one byte further is a crash,
/// with sanitizers or without.
class GuardedCopy
{
public:
  GuardedCopy(const std::uint8_t* data, std::size_t size)
  {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    this->Mapped = (size + page - 1) / page * page + page;
    void* memory =
      mmap(nullptr, this->Mapped, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
    {
      fail("no memory for a guarded copy");
    }
    this->Base = static_cast<std::uint8_t*>(memory);
    std::uint8_t* guard = this->Base + this->Mapped - page;
    mprotect(guard, page, PROT_NONE);
    this->Data = guard - size;
    if (size > 0)
    {
      std::memcpy(this->Data, data, size);
    }
  }
  ~GuardedCopy() { munmap(this->Base, this->Mapped); }
  GuardedCopy(const GuardedCopy&) = delete;
  GuardedCopy& operator=(const GuardedCopy&) = delete;

  std::uint8_t* Data;

private:
  std::uint8_t* Base;
  std::size_t Mapped;
};

constexpr LeafGeometry Geometries[] = { LeafGeometry::Voxel, LeafGeometry::Plane,
  LeafGeometry::Triangle, LeafGeometry::Automatic };

RayBlock someRays(unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> anywhere(0.0f, 3.0f), inside(1.0f, 2.0f);
  RayBlock block;
  for (int i = 0; i < RayBlock::Size; ++i)
  {
    block.originX[i] = anywhere(random);
    block.originY[i] = anywhere(random);
    block.originZ[i] = anywhere(random);
    block.directionX[i] = i % 8 == 1 ? 0.0f : inside(random) - block.originX[i];
    block.directionY[i] = i % 8 == 2 ? -0.0f : inside(random) - block.originY[i];
    block.directionZ[i] = inside(random) - block.originZ[i];
    block.tMin[i] = 0.0f;
    block.tMax[i] = i % 2 ? 10.0f : std::numeric_limits<float>::max();
  }
  block.directionX[5] = std::numeric_limits<float>::quiet_NaN();
  block.originY[13] = std::numeric_limits<float>::infinity();
  return block;
}

void checkPrimitive(const Octree& octree, Primitive primitive)
{
  const Header& h = octree.header();
  const std::uint64_t count = primitive & NodePrimitive ? h.nodeCount
    : octree.hasPlanes()                                ? h.listWords
                                                        : h.triangleCount;
  if (primitive != NoPrimitive && (primitive & ~NodePrimitive) >= count)
  {
    fail("a hit names something that does not exist");
  }
}

/// Every kind of query, at every level. The block queries need not agree with each other on
/// nonsense, but what they name has to exist.
void trace(const Octree& octree)
{
  const RayBlock rays = someRays(1);
  HitBlock hits;
  for (int level = 0; level <= octree.level(); ++level)
  {
    for (const LeafGeometry geometry : Geometries)
    {
      const TraceOptions options{ geometry, level };
      intersect(octree, rays, options, hits);
      for (int i = 0; i < RayBlock::Size; ++i)
      {
        checkPrimitive(octree, hits.primitive[i]);
      }
      intersectBlockScalar(octree, rays, options, hits);
      for (int i = 0; i < RayBlock::Size; i += 8)
      {
        Ray ray;
        ray.origin = { rays.originX[i], rays.originY[i], rays.originZ[i] };
        ray.direction = { rays.directionX[i], rays.directionY[i], rays.directionZ[i] };
        checkPrimitive(octree, intersect(octree, ray, options).primitive);
      }
    }
    for (int i = 0; i < RayBlock::Size && !octree.empty(); i += 4)
    {
      ClippedRay<double> ray;
      const glm::dvec3 origin(rays.originX[i], rays.originY[i], rays.originZ[i]);
      const glm::dvec3 direction(rays.directionX[i], rays.directionY[i], rays.directionZ[i]);
      if (clip(octree, origin, direction, 0.0, 10.0, ray) &&
        walk(octree, ray, level,
          [](const StopCell<double>&, double&) { return Visit::Continue; }) == WalkEnd::Bound)
      {
        fail("a walk came to its loop's bound");
      }
    }
  }
}

/// A small frame with a shadow buffer.
void render(const Octree& octree)
{
  Scene scene;
  Instance instance;
  instance.body.own().octree = octree;
  instance.body.own().leafGeometry = static_cast<LeafGeometry>(octree.header().leafGeometry);
  scene.instances = { instance };
  scene.lights.resize(1);
  scene.lights[0].direction = glm::normalize(glm::dvec3(-1, 2, -3));
  View view;
  makeView(glm::lookAt(glm::dvec3(1, -4, 2), glm::dvec3(0), glm::dvec3(0, 0, 1)),
    glm::perspective(0.6, 1.0, 0.1, 20.0), 16, 16, view);
  FrameSettings settings;
  settings.shadowResolution = 16;
  settings.pixelError = 0.0;
  CPUTracer tracer;
  tracer.render(scene, view, settings, serialFor);
}

void useHandle(vtkSparseVoxelOctree* handle)
{
  handle->GetNumberOfVoxels();
  handle->GetActualMemorySize();
  for (int level = 0; level <= handle->GetNumberOfLevels(); ++level)
  {
    for (const double x : { -0.9, 0.0, 0.33, 1e300 })
    {
      const double at[3] = { x, 0.5 * x, -0.3 };
      handle->IsOccupied(at, level);
    }
  }
  double t, x[3];
  vtkIdType cell;
  for (int i = 0; i < 16; ++i)
  {
    const double from[3] = { 2.0, 0.3 * i - 2.0, 1.0 }, to[3] = { -2.0, 0.2, 0.1 * i - 1.0 };
    if (handle->IntersectWithLine(from, to, t, x, cell) &&
      (handle->GetOctree().hasPlanes() ? cell != -1
                                       : cell < 0 || cell >= svofuzz::mesh()->GetNumberOfCells()))
    {
      fail("a line hits a cell that does not exist");
    }
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  vtkObject::GlobalWarningDisplayOff();
  vtkPolyData* source = svofuzz::mesh();
  GuardedCopy bytes(data, size);
  if (size >= sizeof(Header))
  {
    const std::uint64_t signature = meshSignature(source);
    std::memcpy(bytes.Data + offsetof(Header, signature), &signature, sizeof(signature));
  }
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName(OctreeArrayName);
  array->SetArray(bytes.Data, static_cast<vtkIdType>(size), 1);
  vtkNew<vtkPolyData> mesh;
  mesh->ShallowCopy(source);
  mesh->GetFieldData()->AddArray(array);

  vtkNew<vtkSparseVoxelOctree> handle;
  if (!handle->Initialize(mesh))
  {
    Octree octree;
    std::string message;
    if (openAttachedOctree(mesh, octree, message) == Attached::Damaged && message.empty())
    {
      fail("an octree was refused without a message");
    }
    return 0;
  }
  ++svofuzz::traced;
  useHandle(handle);
  trace(handle->GetOctree());
  render(handle->GetOctree());
  vtkNew<vtkSVOToPolyData> surface;
  surface->SetInputData(mesh);
  for (const int level : { -1, 1, 2 })
  {
    surface->SetLevel(level);
    surface->Update();
  }
  vtkNew<vtkSVOToHyperTreeGrid> grid;
  grid->SetInputData(mesh);
  grid->SetLevel(6);
  grid->Update();
  return 0;
}
