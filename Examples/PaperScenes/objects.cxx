// Builds the octrees of the scenes' objects, and times it.
#include "objects.h"

#include "vtkPolyDataToSVO.h"
#include "vtkSparseVoxelOctree.h"

#include <vtkNew.h>
#include <vtkPlaneSource.h>

#include <chrono>

namespace paper
{
namespace
{
constexpr double groundHalfSize = 14;

vtkSmartPointer<vtkPolyData> groundMesh()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-groundHalfSize, -groundHalfSize, 0);
  plane->SetPoint1(groundHalfSize, -groundHalfSize, 0);
  plane->SetPoint2(-groundHalfSize, groundHalfSize, 0);
  plane->Update();
  return plane->GetOutput();
}

vtkIdType triangles(vtkPolyData* mesh)
{
  vtkIdType count = 0;
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  vtkCellArray* polygons = mesh->GetPolys();
  for (polygons->InitTraversal(); polygons->GetNextCell(size, ids);)
  {
    count += size - 2;
  }
  return count;
}

bool addPose(vtkPolyData* mesh, int level, Object& object, std::string& error)
{
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputData(mesh);
  filter->SetMaximumLevel(level);
  const auto start = std::chrono::steady_clock::now();
  filter->Update();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;

  vtkNew<vtkSparseVoxelOctree> octree;
  if (!octree->Initialize(filter->GetOutput()))
  {
    error = "no octree could be built of a mesh of " + std::to_string(triangles(mesh)) +
      " triangles at level " + std::to_string(level) + ".";
    return false;
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(filter->GetOutput());
  mapper->ScalarVisibilityOff();
  object.poses.push_back(mapper);
  object.trianglesShown = triangles(mesh);
  object.trianglesInMemory += triangles(mesh);
  object.buildSeconds += elapsed.count();
  object.octreeMebibytes += octree->GetActualMemorySize() / 1024.0;
  object.voxels += octree->GetNumberOfVoxels();
  return true;
}
}

bool buildOctrees(const Meshes& meshes, int level, const std::function<void(double)>& progress,
  Objects& objects, std::string& error)
{
  objects = {};
  if (!addPose(meshes.a, level, objects.a, error) ||
    !addPose(groundMesh(), level, objects.ground, error))
  {
    return false;
  }
  for (const auto& pose : meshes.b)
  {
    if (!addPose(pose, level, objects.b, error))
    {
      return false;
    }
    progress(static_cast<double>(objects.b.poses.size()) / meshes.b.size());
  }
  return true;
}
}
