// Meshes, lights and outputs for the tests of vtkSVOShadowFilter.
#ifndef svoShadowMeshes_h
#define svoShadowMeshes_h

#include "svoTestMessages.h"
#include "vtkSVOShadowFilter.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkLight.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <initializer_list>
#include <vector>

#include <gtest/gtest.h>

namespace svotest
{
using MeshPointer = vtkSmartPointer<vtkPolyData>;
using Point = std::vector<double>;

/// Cells of any size, double points.
inline MeshPointer polygons(
  const std::vector<Point>& points, const std::vector<std::vector<vtkIdType>>& cells)
{
  auto mesh = MeshPointer::New();
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  for (const Point& p : points)
  {
    places->InsertNextPoint(p.data());
  }
  vtkNew<vtkCellArray> polys;
  for (const auto& cell : cells)
  {
    polys->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  mesh->SetPoints(places);
  mesh->SetPolys(polys);
  return mesh;
}

/// A rectangle in a plane of z, that faces up, cut into n x n quads.
inline MeshPointer level(double x0, double x1, double y0, double y1, double z, int n = 1)
{
  std::vector<Point> points;
  std::vector<std::vector<vtkIdType>> cells;
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i <= n; ++i)
    {
      points.push_back({ x0 + (x1 - x0) * i / n, y0 + (y1 - y0) * j / n, z });
    }
  }
  for (vtkIdType j = 0; j < n; ++j)
  {
    for (vtkIdType i = 0; i < n; ++i)
    {
      const vtkIdType a = j * (n + 1) + i;
      cells.push_back({ a, a + 1, a + n + 2, a + n + 1 });
    }
  }
  return polygons(points, cells);
}

/// Hills over [-1, 1]^2: 2 n^2 triangles that face up.
inline MeshPointer hills(int n)
{
  MeshPointer flat = level(-1, 1, -1, 1, 0, n);
  std::vector<Point> points;
  std::vector<std::vector<vtkIdType>> cells;
  for (vtkIdType i = 0; i < flat->GetNumberOfPoints(); ++i)
  {
    double p[3];
    flat->GetPoint(i, p);
    const double z = 0.15 * std::sin(7.0 * p[0] + 1.0) * std::cos(6.0 * p[1]) +
      0.04 * std::sin(31.0 * p[0] * p[1]);
    points.push_back({ p[0], p[1], z });
  }
  for (vtkIdType i = 0; i < flat->GetNumberOfCells(); ++i)
  {
    vtkNew<vtkIdList> ids;
    flat->GetCellPoints(i, ids);
    const vtkIdType* q = ids->GetPointer(0);
    cells.push_back({ q[0], q[1], q[2] });
    cells.push_back({ q[0], q[2], q[3] });
  }
  return polygons(points, cells);
}

inline vtkSmartPointer<vtkLight> sun(double x, double y, double z)
{
  auto light = vtkSmartPointer<vtkLight>::New();
  light->SetLightTypeToSceneLight();
  light->SetPosition(x, y, z);
  light->SetFocalPoint(0, 0, 0);
  return light;
}

/// At `at`; a spot where the cone is below 90 degrees, which looks along (0, 0, -1).
inline vtkSmartPointer<vtkLight> lamp(double x, double y, double z, double cone = 180.0)
{
  auto light = sun(x, y, z);
  light->SetFocalPoint(x, y, z - 1.0);
  light->SetPositional(true);
  light->SetConeAngle(cone);
  return light;
}

inline vtkSmartPointer<vtkMatrix4x4> matrix(std::initializer_list<double> rows)
{
  auto m = vtkSmartPointer<vtkMatrix4x4>::New();
  int i = 0;
  for (const double value : rows)
  {
    m->SetElement(i / 4, i % 4, value);
    ++i;
  }
  return m;
}

/// A filter, what it says, and its answers.
struct Shadows
{
  vtkNew<vtkSVOShadowFilter> filter;
  svo::TestMessages messages{ filter };

  explicit Shadows(vtkPolyData* mesh, bool byPoint = false)
  {
    this->filter->SetInputData(mesh);
    this->filter->SetAssociation(byPoint ? 0 : 1);
  }
  vtkDataArray* array(const char* name)
  {
    this->filter->Update();
    vtkPolyData* output = this->filter->GetOutput();
    return this->filter->GetAssociation() == 0 ? output->GetPointData()->GetArray(name)
                                               : output->GetCellData()->GetArray(name);
  }
  double value(const char* name, vtkIdType id, int component = 0)
  {
    vtkDataArray* values = this->array(name);
    EXPECT_NE(values, nullptr) << name;
    return values ? values->GetComponent(id, component) : std::nan("");
  }
  double shadow(vtkIdType id, int light = 0) { return this->value("Shadow", id, light); }
  double exposure(vtkIdType id) { return this->value("Exposure", id); }
  void expectQuiet() { EXPECT_EQ(this->messages.all(), ""); }
};
}

#endif
