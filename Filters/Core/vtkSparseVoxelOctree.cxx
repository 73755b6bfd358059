#include "vtkSparseVoxelOctree.h"

#include "svoBox.h"
#include "svoIntersect.h"
#include "svoMeshOctree.h"
#include "svoRepresentative.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

vtkStandardNewMacro(vtkSparseVoxelOctree);

class vtkSparseVoxelOctree::vtkInternals
{
public:
  svo::Octree Octree;
  glm::dmat4 FromLocal{ 1.0 }; // to the octree's own coordinates
  double Bounds[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };

  glm::dvec3 toOwn(const double x[3]) const
  {
    const glm::dvec4 p(x[0], x[1], x[2], 1.0);
    return glm::dvec3(this->Octree.hasTransform() ? this->FromLocal * p : p);
  }
};

//------------------------------------------------------------------------------
vtkSparseVoxelOctree::vtkSparseVoxelOctree()
  : Internals(new vtkInternals)
{
}

vtkSparseVoxelOctree::~vtkSparseVoxelOctree() = default;

//------------------------------------------------------------------------------
bool vtkSparseVoxelOctree::Initialize(vtkPolyData* mesh)
{
  this->Internals->Octree = {};
  this->Modified();
  if (!mesh)
  {
    vtkErrorMacro("There is no mesh to take an octree from.");
    return false;
  }
  std::string message;
  const svo::Attached attached = svo::openAttachedOctree(mesh, this->Internals->Octree, message);
  if (attached == svo::Attached::Found)
  {
    this->Internals->FromLocal = glm::inverse(this->Internals->Octree.transform());
    return true;
  }
  vtkErrorMacro(<< svo::describe(attached, message));
  return false;
}

//------------------------------------------------------------------------------
int vtkSparseVoxelOctree::GetNumberOfLevels()
{
  const svo::Octree& octree = this->Internals->Octree;
  return octree ? octree.level() : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkSparseVoxelOctree::GetNumberOfVoxels()
{
  const svo::Octree& octree = this->Internals->Octree;
  return octree ? static_cast<vtkIdType>(octree.header().voxelCount) : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkSparseVoxelOctree::GetNumberOfNodes()
{
  const svo::Octree& octree = this->Internals->Octree;
  return octree ? static_cast<vtkIdType>(octree.header().nodeCount) : 0;
}

//------------------------------------------------------------------------------
unsigned long vtkSparseVoxelOctree::GetActualMemorySize()
{
  const svo::Octree& octree = this->Internals->Octree;
  return octree ? static_cast<unsigned long>((octree.bytes() + 1023) / 1024) : 0;
}

//------------------------------------------------------------------------------
void vtkSparseVoxelOctree::GetBounds(double bounds[6])
{
  const svo::Octree& octree = this->Internals->Octree;
  for (int i = 0; i < 3; ++i)
  {
    bounds[2 * i] = octree ? octree.header().origin[i] : 1.0;
    bounds[2 * i + 1] =
      octree ? bounds[2 * i] + std::ldexp(octree.header().voxelSize, octree.level()) : -1.0;
  }
  if (octree && octree.hasTransform())
  {
    const svo::Box box = svo::boxAround(bounds, octree.transform());
    for (int i = 0; i < 3; ++i)
    {
      bounds[2 * i] = box.low[i];
      bounds[2 * i + 1] = box.high[i];
    }
  }
}

//------------------------------------------------------------------------------
double* vtkSparseVoxelOctree::GetBounds()
{
  this->GetBounds(this->Internals->Bounds);
  return this->Internals->Bounds;
}

//------------------------------------------------------------------------------
double vtkSparseVoxelOctree::GetVoxelSize()
{
  const svo::Octree& octree = this->Internals->Octree;
  if (!octree)
  {
    return 0.0;
  }
  const double volume = std::abs(glm::determinant(glm::dmat3(octree.transform())));
  return octree.header().voxelSize * (octree.hasTransform() ? std::cbrt(volume) : 1.0);
}

//------------------------------------------------------------------------------
bool vtkSparseVoxelOctree::IsOccupied(const double x[3], int level)
{
  const svo::Octree& octree = this->Internals->Octree;
  if (!octree)
  {
    return false;
  }
  const int l = std::min(std::max(level, 0), octree.level());
  const double edge = std::ldexp(octree.header().voxelSize, octree.level() - l);
  const glm::dvec3 at = this->Internals->toOwn(x);
  glm::ivec3 cell;
  for (int i = 0; i < 3; ++i)
  {
    const double c = std::floor((at[i] - octree.header().origin[i]) / edge);
    if (!(c >= 0.0 && c < static_cast<double>(1 << l))) // NaN is outside, too
    {
      return false;
    }
    cell[i] = static_cast<int>(c);
  }
  return octree.occupied(cell, l);
}

//------------------------------------------------------------------------------
int vtkSparseVoxelOctree::IntersectWithLine(
  const double p1[3], const double p2[3], double& t, double x[3], vtkIdType& cellId)
{
  const svo::Octree& octree = this->Internals->Octree;
  if (!octree || octree.empty())
  {
    return 0;
  }
  // Differences first: the mesh may lie far from its origin.
  const svo::Header& h = octree.header();
  const glm::dvec3 origin(h.origin[0], h.origin[1], h.origin[2]);
  const double scale = 1.0 / octree.rootEdge();
  const glm::dvec3 from = this->Internals->toOwn(p1);
  const glm::dvec3 along = this->Internals->toOwn(p2) - from;
  svo::Ray ray;
  ray.origin = 1.0 + (from - origin) * scale;
  ray.direction = along * scale;
  ray.tMin = 0.0;
  ray.tMax = 1.0;
  if (ray.direction == glm::dvec3(0.0))
  {
    return 0;
  }
  svo::TraceOptions options;
  options.leafGeometry = static_cast<svo::LeafGeometry>(octree.header().leafGeometry);
  const svo::Hit hit = svo::intersect(octree, ray, options);
  if (!hit)
  {
    return 0;
  }
  t = hit.t;
  for (int i = 0; i < 3; ++i)
  {
    x[i] = p1[i] + hit.t * (p2[i] - p1[i]);
  }
  if (octree.hasPlanes())
  {
    cellId = -1;
    return 1;
  }
  const std::uint32_t triangle = hit.primitive & svo::NodePrimitive
    ? svo::firstTriangle(octree, hit.primitive & ~svo::NodePrimitive)
    : hit.primitive;
  cellId = octree.surface()->cells[triangle];
  return 1;
}

//------------------------------------------------------------------------------
const svo::Octree& vtkSparseVoxelOctree::GetOctree() const
{
  return this->Internals->Octree;
}

//------------------------------------------------------------------------------
void vtkSparseVoxelOctree::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLevels: " << this->GetNumberOfLevels() << "\n";
  os << indent << "NumberOfVoxels: " << this->GetNumberOfVoxels() << "\n";
  os << indent << "NumberOfNodes: " << this->GetNumberOfNodes() << "\n";
  os << indent << "ActualMemorySize: " << this->GetActualMemorySize() << " KiB\n";
  os << indent << "VoxelSize: " << this->GetVoxelSize() << "\n";
  double b[6];
  this->GetBounds(b);
  os << indent << "Bounds: (" << b[0] << ", " << b[1] << ", " << b[2] << ", " << b[3] << ", "
     << b[4] << ", " << b[5] << ")\n";
}
