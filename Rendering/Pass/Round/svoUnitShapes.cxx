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
constexpr int MostFacets = 64, FewestOfMany = 16;

/// All shapes of a prop have no more, unless that leaves fewer than FewestOfMany facets around.
constexpr double MostTriangles = 4e6;

double trianglesOf(RoundShapes::Shape shape, int around)
{
  return shape == RoundShapes::Shape::Rod ? 4.0 * around : around * (around - 2.0);
}

/// A surface of revolution about z, of so many facets around: `profile` has radii and heights, from
/// below to above; it begins and ends on the axis.
vtkSmartPointer<vtkPolyData> turned(
  const std::vector<std::pair<double, double>>& profile, int around)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polygons;
  const auto rings = static_cast<vtkIdType>(profile.size()) - 2;
  points->InsertNextPoint(0.0, 0.0, profile.front().second);
  for (vtkIdType ring = 1; ring <= rings; ++ring)
  {
    for (int i = 0; i < around; ++i)
    {
      const double angle = 2.0 * vtkMath::Pi() * i / around;
      const double radius = profile[ring].first;
      points->InsertNextPoint(
        radius * std::cos(angle), radius * std::sin(angle), profile[ring].second);
    }
  }
  const vtkIdType top = points->InsertNextPoint(0.0, 0.0, profile.back().second);
  for (int i = 0; i < around; ++i)
  {
    const int next = (i + 1) % around;
    const vtkIdType last = 1 + (rings - 1) * around;
    polygons->InsertNextCell({ 0, 1 + next, 1 + i });
    for (vtkIdType ring = 0; ring + 1 < rings; ++ring)
    {
      const vtkIdType low = 1 + ring * around, high = low + around;
      polygons->InsertNextCell({ low + i, low + next, high + next, high + i });
    }
    polygons->InsertNextCell({ top, last + i, last + next });
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

int UnitShapes::facetsOf(const RoundShapes& shapes)
{
  constexpr double Inside = 0.1; // pixels
  int facets = shapes.width == RoundShapes::Width::Pixels && shapes.radii.empty() ? 8 : MostFacets;
  while (facets < MostFacets && shapes.radius * (1.0 - std::cos(vtkMath::Pi() / facets)) > Inside)
  {
    facets *= 2;
  }
  while (facets > FewestOfMany &&
    static_cast<double>(shapes.count()) * trianglesOf(shapes.shape, facets) > MostTriangles)
  {
    facets /= 2;
  }
  return facets;
}

vtkPolyData* UnitShapes::of(const RoundShapes& shapes)
{
  const int around = facetsOf(shapes);
  vtkSmartPointer<vtkPolyData>& mesh = this->Meshes[{ shapes.shape, around }];
  if (mesh)
  {
    return mesh;
  }
  std::vector<std::pair<double, double>> profile;
  if (shapes.shape == RoundShapes::Shape::Rod)
  {
    profile = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } };
  }
  else
  {
    const int rings = around / 2;
    for (int i = 0; i <= rings; ++i)
    {
      const double angle = vtkMath::Pi() * i / rings;
      profile.emplace_back(std::sin(angle), -std::cos(angle));
    }
  }
  mesh = turned(profile, around);
  attachOwnOctree(mesh);
  return mesh;
}
}
