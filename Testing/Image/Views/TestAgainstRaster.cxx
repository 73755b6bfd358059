// The traced picture against VTK's own raster of the same scene, on four generated meshes.
#include "svoRasterComparison.h"
#include "svoTestStage.h"

#include "vtkPoints.h"
#include "vtkPolyDataNormals.h"
#include "vtkSphereSource.h"
#include "vtkSuperquadricSource.h"

#include <cmath>
#include <vector>

namespace
{
using namespace svotest;

/// A sphere with waves all over: concave, smooth normals.
vtkSmartPointer<vtkPolyData> bumpy()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(120);
  sphere->SetPhiResolution(90);
  sphere->Update();
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->DeepCopy(sphere->GetOutput());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    const double r =
      1.0 + 0.08 * std::sin(9.0 * x[0]) * std::sin(8.0 * x[1]) * std::sin(7.0 * x[2] + 1.0);
    mesh->GetPoints()->SetPoint(i, r * x[0], r * x[1], r * x[2]);
  }
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(mesh);
  normals->SplittingOff();
  normals->Update();
  mesh->DeepCopy(normals->GetOutput());
  return mesh;
}

vtkSmartPointer<vtkPolyData> outputOf(vtkAlgorithm* source)
{
  source->Update();
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->DeepCopy(source->GetOutputDataObject(0));
  return mesh;
}

std::vector<NamedMesh> meshes()
{
  vtkNew<vtkSuperquadricSource> pillow;
  pillow->SetThetaRoundness(0.4);
  pillow->SetPhiRoundness(0.3);
  pillow->SetThetaResolution(64);
  pillow->SetPhiResolution(64);
  pillow->SetSize(1.0);
  return { { "sphere", outputOf(ball(1.0, 0.0, 0.0, 0.0)) },
    { "torus", outputOf(ring(1.0, 0.0, 0.0, 0.0)) }, { "bumpy", bumpy() },
    { "superquadric", outputOf(pillow) } };
}
}

int TestAgainstRaster(int, char*[])
{
  Checks checks;
  for (const NamedMesh& mesh : meshes())
  {
    compareDepthWithRaster(mesh, true, checks);
    compareColorsWithRaster(mesh, checks);
  }
  return checks.exitCode();
}
