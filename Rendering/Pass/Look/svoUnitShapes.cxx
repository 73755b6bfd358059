#include "svoUnitShapes.h"

#include "svoMeshDetail.h"
#include "svoMeshOctree.h"

#include "vtkCellArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace svo
{
namespace
{
constexpr int Around = 64; // facets

/// A surface of revolution about z: `profile` has radii and heights, from below to above; it begins
/// and ends on the axis.
vtkSmartPointer<vtkPolyData> turned(const std::vector<std::pair<double, double>>& profile)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polygons;
  const auto rings = static_cast<vtkIdType>(profile.size()) - 2;
  points->InsertNextPoint(0.0, 0.0, profile.front().second);
  for (vtkIdType ring = 1; ring <= rings; ++ring)
  {
    for (int i = 0; i < Around; ++i)
    {
      const double angle = 2.0 * vtkMath::Pi() * i / Around;
      const double radius = profile[ring].first;
      points->InsertNextPoint(
        radius * std::cos(angle), radius * std::sin(angle), profile[ring].second);
    }
  }
  const vtkIdType top = points->InsertNextPoint(0.0, 0.0, profile.back().second);
  for (int i = 0; i < Around; ++i)
  {
    const int next = (i + 1) % Around;
    const vtkIdType last = 1 + (rings - 1) * Around;
    const vtkIdType below[3] = { 0, 1 + next, 1 + i };
    const vtkIdType above[3] = { top, last + i, last + next };
    polygons->InsertNextCell(3, below);
    for (vtkIdType ring = 0; ring + 1 < rings; ++ring)
    {
      const vtkIdType low = 1 + ring * Around, high = low + Around;
      const vtkIdType quad[4] = { low + i, low + next, high + next, high + i };
      polygons->InsertNextCell(4, quad);
    }
    polygons->InsertNextCell(3, above);
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(polygons);
  return mesh;
}

void attachOwnOctree(vtkPolyData* mesh)
{
  MeshOctreeOptions options;
  options.level = std::clamp(detailLevel(mesh), 1, 6);
  Octree octree;
  std::string message;
  if (buildMeshOctree(mesh, options, octree, message) == BuildStatus::Built)
  {
    attachOctree(mesh, octree);
  }
}
}

UnitShapes::UnitShapes() = default;
UnitShapes::~UnitShapes() = default;

std::shared_ptr<UnitShapes> UnitShapes::ofAll()
{
  static std::weak_ptr<UnitShapes> known;
  std::shared_ptr<UnitShapes> shapes = known.lock();
  if (!shapes)
  {
    known = shapes = std::make_shared<UnitShapes>();
  }
  return shapes;
}

vtkPolyData* UnitShapes::of(Bodies::Shape shape)
{
  const bool rod = shape == Bodies::Shape::Rod;
  vtkSmartPointer<vtkPolyData>& mesh = rod ? this->Rod : this->Ball;
  if (mesh)
  {
    return mesh;
  }
  std::vector<std::pair<double, double>> profile;
  if (rod)
  {
    profile = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } };
  }
  else
  {
    constexpr int Rings = Around / 2;
    for (int i = 0; i <= Rings; ++i)
    {
      const double angle = vtkMath::Pi() * i / Rings;
      profile.emplace_back(std::sin(angle), -std::cos(angle));
    }
  }
  mesh = turned(profile);
  attachOwnOctree(mesh);
  return mesh;
}
}
