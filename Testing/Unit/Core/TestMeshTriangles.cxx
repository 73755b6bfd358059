// Polygons and strips are cut into triangles as VTK's mapper draws them, and keep their cell ids.
#include "svoMeshTriangles.h"

#include "vtkCellArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkStripper.h"
#include "vtkTriangle.h"
#include "vtkTriangleFilter.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace
{
double areaOf(const svo::TriangleMesh& mesh)
{
  double area = 0.0;
  for (std::size_t i = 0; i < mesh.triangleCount; ++i)
  {
    const glm::uvec3& t = mesh.triangles[i];
    area += 0.5 *
      glm::length(
        glm::cross(mesh.points[t.y] - mesh.points[t.x], mesh.points[t.z] - mesh.points[t.x]));
  }
  return area;
}

double areaOf(vtkPolyData* mesh)
{
  vtkNew<vtkTriangleFilter> filter;
  filter->SetInputData(mesh);
  filter->PassVertsOff();
  filter->PassLinesOff();
  filter->Update();
  double area = 0.0;
  for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfCells(); ++i)
  {
    area += vtkTriangle::SafeDownCast(filter->GetOutput()->GetCell(i))->ComputeArea();
  }
  return area;
}

/// Regular polygons of 3 to 9 corners beside each other.
vtkSmartPointer<vtkPolyData> polygons(int precision)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(precision);
  vtkNew<vtkCellArray> polys;
  for (int n = 3; n <= 9; ++n)
  {
    polys->InsertNextCell(n);
    for (int i = 0; i < n; ++i)
    {
      const double angle = 2.0 * vtkMath::Pi() * i / n;
      polys->InsertCellPoint(
        points->InsertNextPoint(3.0 * n + std::cos(angle), std::sin(angle), 0.25));
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(polys);
  return mesh;
}
}

TEST(MeshTriangles, PolygonsOfAnySizeKeepTheirAreaAndTheirCell)
{
  for (int precision : { VTK_FLOAT, VTK_DOUBLE })
  {
    const auto mesh = polygons(precision);
    const double area = areaOf(mesh); // VTK's filter squeezes the points: before they are read
    const svo::MeshTriangles triangles(mesh);
    const svo::TriangleMesh view = triangles.view();
    ASSERT_EQ(view.triangleCount, 1u + 2 + 3 + 4 + 5 + 6 + 7);
    EXPECT_NEAR(areaOf(view), area, 1e-6);
    for (std::size_t i = 0; i < view.triangleCount; ++i)
    {
      const double x = view.points[view.triangles[i].x].x;
      EXPECT_EQ(triangles.cells()[i], std::lround(x / 3.0) - 3u);
    }
  }
}

TEST(MeshTriangles, PolygonsAreFansAroundTheirFirstPoint)
{
  const svo::MeshTriangles triangles(polygons(VTK_FLOAT));
  const glm::uvec3* t = triangles.view().triangles;
  EXPECT_EQ(t[0], glm::uvec3(0, 1, 2));
  EXPECT_EQ(t[1], glm::uvec3(3, 4, 5)); // the quad
  EXPECT_EQ(t[2], glm::uvec3(3, 5, 6));
  EXPECT_EQ(t[5], glm::uvec3(7, 10, 11)); // the pentagon's last
}

TEST(MeshTriangles, AllTrianglesOfAStripHaveItsWinding)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> strips;
  strips->InsertNextCell(7);
  for (int i = 0; i < 7; ++i)
  {
    strips->InsertCellPoint(points->InsertNextPoint(0.5 * i, i % 2, 0.0));
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetStrips(strips);
  const svo::MeshTriangles triangles(mesh);
  const svo::TriangleMesh view = triangles.view();
  ASSERT_EQ(view.triangleCount, 5u);
  for (std::size_t i = 0; i < view.triangleCount; ++i)
  {
    const glm::uvec3& t = view.triangles[i];
    const glm::dvec3 normal =
      glm::cross(view.points[t.y] - view.points[t.x], view.points[t.z] - view.points[t.x]);
    EXPECT_LT(normal.z, 0.0) << i;
  }
}

TEST(MeshTriangles, StripsHaveTheAreaAndTheOrientationOfTheMeshTheyCameFrom)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkStripper> stripper;
  stripper->SetInputConnection(sphere->GetOutputPort());
  stripper->Update();
  vtkPolyData* strips = stripper->GetOutput();
  ASSERT_GT(strips->GetNumberOfStrips(), 0);
  const svo::MeshTriangles triangles(strips);
  const svo::TriangleMesh view = triangles.view();
  EXPECT_NEAR(areaOf(view), areaOf(sphere->GetOutput()), 1e-6);
  for (std::size_t i = 0; i < view.triangleCount; ++i)
  {
    const glm::uvec3& t = view.triangles[i];
    const glm::dvec3 a = view.points[t.x];
    EXPECT_GT(glm::dot(glm::cross(view.points[t.y] - a, view.points[t.z] - a), a), 0.0) << i;
  }
}

TEST(MeshTriangles, CellIdsCountVerticesAndLinesBeforePolygonsAndStrips)
{
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 4; ++i)
  {
    points->InsertNextPoint(i, i % 2, 0.0);
  }
  const auto cells = [](std::initializer_list<std::initializer_list<vtkIdType>> list)
  {
    auto array = vtkSmartPointer<vtkCellArray>::New();
    for (const auto& cell : list)
    {
      array->InsertNextCell(cell);
    }
    return array;
  };
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetVerts(cells({ { 0 }, { 1 } }));
  mesh->SetLines(cells({ { 0, 1 }, { 1, 2 }, { 2, 3 } }));
  mesh->SetPolys(cells({ { 0, 1, 2 } }));
  mesh->SetStrips(cells({ { 0, 1, 2, 3 } }));
  const svo::MeshTriangles triangles(mesh);
  EXPECT_EQ(triangles.cells(), (std::vector<std::uint32_t>{ 5, 6, 6 }));
  EXPECT_EQ(mesh->GetCellType(5), VTK_TRIANGLE);
  EXPECT_EQ(mesh->GetCellType(6), VTK_TRIANGLE_STRIP);
}

TEST(MeshTriangles, DegenerateAndBrokenCellsAreLeftOut)
{
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 4; ++i)
  {
    points->InsertNextPoint(i, i % 2, 0.0);
  }
  vtkNew<vtkCellArray> polys;
  polys->InsertNextCell({ 0, 1 });       // no area
  polys->InsertNextCell({ 0, 1, 1 });    // two ids alike
  polys->InsertNextCell({ 0, 1, 4 });    // no such point
  polys->InsertNextCell({ 0, -1, 2 });   // nor this
  polys->InsertNextCell({ 0, 1, 2, 3 }); // a quad
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(polys);
  const svo::MeshTriangles triangles(mesh);
  EXPECT_EQ(triangles.brokenCells(), 2u);
  EXPECT_EQ(triangles.cells(), (std::vector<std::uint32_t>{ 4, 4 }));
}

TEST(MeshTriangles, AMeshWithoutPointsHasNone)
{
  vtkNew<vtkPolyData> mesh;
  const svo::MeshTriangles triangles(mesh);
  EXPECT_EQ(triangles.view().triangleCount, 0u);
  EXPECT_EQ(triangles.view().pointCount, 0u);
}

namespace
{
/// A polygon of many points at the radius that `radiusOf` gives for the angle, at the height that
/// `heightOf` gives.
template <typename Radius, typename Height>
vtkSmartPointer<vtkPolyData> largePolygon(int count, const Radius& radiusOf, const Height& heightOf)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polys;
  polys->InsertNextCell(count);
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2.0 * vtkMath::Pi() * i / count;
    const double r = radiusOf(angle);
    polys->InsertCellPoint(
      points->InsertNextPoint(r * std::cos(angle), r * std::sin(angle), heightOf(angle)));
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(polys);
  return mesh;
}

double one(double)
{
  return 1.0;
}

bool isFan(const svo::MeshTriangles& triangles)
{
  const svo::TriangleMesh mesh = triangles.view();
  for (std::size_t i = 0; i < mesh.triangleCount; ++i)
  {
    if (mesh.triangles[i].x != 0)
    {
      return false;
    }
  }
  return true;
}
}

// A fan of a million points took a minute to build: each triangle reaches across all of the disc.
TEST(MeshTriangles, LargeConvexPolygonsAreCutIntoShortTriangles)
{
  constexpr int Count = 200000;
  const auto disc = largePolygon(Count, one, one);
  const svo::MeshTriangles triangles(disc);
  const svo::TriangleMesh mesh = triangles.view();
  EXPECT_EQ(mesh.triangleCount, std::size_t(Count - 2));
  EXPECT_NEAR(areaOf(mesh), vtkMath::Pi(), 1e-5);
  double widths = 0.0;
  for (std::size_t i = 0; i < mesh.triangleCount; ++i)
  {
    const glm::uvec3& t = mesh.triangles[i];
    const glm::dvec3 a = mesh.points[t.x];
    EXPECT_GE(glm::cross(mesh.points[t.y] - a, mesh.points[t.z] - a).z, -1e-6);
    widths += glm::length(mesh.points[t.y] - a);
    EXPECT_EQ(triangles.cells()[i], 0u);
  }
  EXPECT_LT(widths, 20.0 * 2.0 * vtkMath::Pi()); // a fan's are 250000 together
  // Ordinary polygons, and those that halves do not fit, are fans as ever.
  EXPECT_TRUE(isFan(svo::MeshTriangles(largePolygon(5000, one, one))));
  EXPECT_TRUE(isFan(svo::MeshTriangles(largePolygon(
    20000, [](double a) { return 1.0 + 0.3 * std::cos(5.0 * a); }, one))));
  EXPECT_TRUE(isFan(svo::MeshTriangles(
    largePolygon(20000, one, [](double a) { return 0.01 * std::cos(2.0 * a); }))));
  EXPECT_FALSE(isFan(svo::MeshTriangles(
    largePolygon(20000, one, [](double a) { return 0.5 * std::cos(a); })))); // slanted, but flat
  const auto broken = largePolygon(20000, one, one);
  broken->GetPoints()->SetPoint(777, std::nan(""), 0.0, 0.0);
  EXPECT_TRUE(isFan(svo::MeshTriangles(broken)));
  const auto far = largePolygon(
    20000, [](double) { return 1e200; }, one);
  EXPECT_EQ(svo::MeshTriangles(far).view().triangleCount, 19998u);
}
