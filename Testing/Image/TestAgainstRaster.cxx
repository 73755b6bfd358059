// The traced picture against VTK's own raster of the same scene, at level 10 on four meshes: depth
// of triangle and plane leaves in voxels, and colours of every kind of shading, scalars and light.
#include "svoTestPicture.h"
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkElevationFilter.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPointDataToCellData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkSuperquadricSource.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace svoTest;

constexpr int Level = 10;

struct Mesh
{
  std::string name;
  vtkSmartPointer<vtkPolyData> data;
};

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

std::vector<Mesh> meshes()
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

vtkActor* show(Stage& stage, vtkPolyData* mesh)
{
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(mesh);
  stage.pass->SetMaximumLevel(Level);
  stage.pass->SetPixelError(0.0);
  stage.pass->SetShadowTechniqueToNone();
  vtkActor* actor = stage.add(producer, 0.9, 0.7, 0.5);
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->SetPosition(1.5, -3.5, 2.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetClippingRange(2.0, 7.0);
  return actor;
}

/// Distance from the eye plane of a perspective camera's window depth.
double linear(double depth, const double range[2])
{
  return range[0] * range[1] / (range[1] - depth * (range[1] - range[0]));
}

/// Share of the pixels that both cover whose depths are within `voxels` of each other.
double agreeing(const Picture& a, const Picture& b, vtkCamera* camera, double voxelSize,
  double voxels, std::size_t& both)
{
  double range[2];
  camera->GetClippingRange(range);
  std::size_t within = 0;
  both = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    if (a.depth[i] < 1.0f && b.depth[i] < 1.0f)
    {
      ++both;
      within +=
        std::abs(linear(a.depth[i], range) - linear(b.depth[i], range)) <= voxels * voxelSize;
    }
  }
  return both ? static_cast<double>(within) / both : 0.0;
}

/// Depth is compared in a large window: a rasteriser moves vertices to the next 1/256 of a pixel,
/// which on steep faces is a depth.
void compareDepth(const Mesh& mesh, Checks& checks)
{
  Stage stage(1000, 1000);
  stage.addSun(2.0, -1.5, 4.0);
  show(stage, mesh.data);
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  stage.usePass(true);

  double bounds[6];
  mesh.data->GetBounds(bounds);
  const double edge =
    std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  const double voxelSize = edge / (1 << Level);
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  std::size_t both;

  stage.pass->SetLeafGeometryToTriangle();
  const Picture triangles = capture(stage.window);
  checks.expect(stage.pass->GetNumberOfTracedActors() == 1, mesh.name + " is traced");
  const double exact = agreeing(raster, triangles, camera, voxelSize, 0.05, both);
  std::cout << mesh.name << ": triangle leaves within 0.05 voxel on " << 100.0 * exact << " % of "
            << both << " pixels\n";
  checks.expect(both > 100000, mesh.name + " covers enough pixels");
  checks.expect(exact >= 0.999, mesh.name + ": triangle leaves to 0.05 voxel on 99.9 %");

  stage.pass->SetLeafGeometryToPlane();
  const Picture planes = capture(stage.window);
  const double near = agreeing(raster, planes, camera, voxelSize, 2.0, both);
  std::cout << mesh.name << ": plane leaves within 2 voxels on " << 100.0 * near << " % of " << both
            << " pixels\n";
  checks.expect(near >= 0.99, mesh.name + ": plane leaves to 2 voxels on 99 %");
}

struct Variant
{
  std::string name;
  std::function<void(Stage&, vtkActor*)> set;
};

void colorByHeight(vtkActor* actor, vtkPolyData* mesh, bool cells)
{
  vtkNew<vtkElevationFilter> height;
  height->SetInputData(mesh);
  height->SetLowPoint(0.0, 0.0, -1.0);
  height->SetHighPoint(0.3, 0.0, 1.0);
  vtkNew<vtkPointDataToCellData> average;
  average->SetInputConnection(height->GetOutputPort());
  average->PassPointDataOff();
  auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
  mapper->SetInputConnection(cells ? average->GetOutputPort() : height->GetOutputPort());
  mapper->ScalarVisibilityOn();
  mapper->SetScalarModeToDefault();
  mapper->SetScalarRange(0.0, 1.0);
}

std::vector<Variant> variants(vtkPolyData* mesh)
{
  const auto sun = [](Stage& stage) { stage.addSun(2.0, -1.5, 4.0); };
  return {
    { "flat",
      [=](Stage& stage, vtkActor* actor)
      {
        sun(stage);
        actor->GetProperty()->SetInterpolationToFlat();
      } },
    { "Gouraud",
      [=](Stage& stage, vtkActor* actor)
      {
        sun(stage);
        actor->GetProperty()->SetInterpolationToGouraud();
      } },
    { "Phong, specular, ambient",
      [=](Stage& stage, vtkActor* actor)
      {
        sun(stage);
        vtkProperty* property = actor->GetProperty();
        property->SetInterpolationToPhong();
        property->SetAmbient(0.2);
        property->SetAmbientColor(0.2, 0.4, 0.9);
        property->SetDiffuse(0.7);
        property->SetSpecular(0.5);
        property->SetSpecularPower(20.0);
        property->SetSpecularColor(1.0, 0.9, 0.6);
      } },
    { "point scalars",
      [=](Stage& stage, vtkActor* actor)
      {
        sun(stage);
        colorByHeight(actor, mesh, false);
      } },
    { "point scalars interpolated before mapping",
      [=](Stage& stage, vtkActor* actor)
      {
        sun(stage);
        colorByHeight(actor, mesh, false);
        actor->GetMapper()->InterpolateScalarsBeforeMappingOn();
      } },
    { "cell scalars",
      [=](Stage& stage, vtkActor* actor)
      {
        sun(stage);
        colorByHeight(actor, mesh, true);
      } },
    { "headlight",
      [](Stage& stage, vtkActor*)
      {
        vtkNew<vtkLight> light;
        light->SetLightTypeToHeadlight();
        stage.renderer->AddLight(light);
      } },
    { "camera lights",
      [](Stage& stage, vtkActor*)
      {
        vtkNew<vtkLight> key;
        key->SetLightTypeToCameraLight();
        key->SetPosition(0.4, 0.8, 1.0);
        key->SetIntensity(0.7);
        stage.renderer->AddLight(key);
        vtkNew<vtkLight> fill;
        fill->SetLightTypeToCameraLight();
        fill->SetPosition(-0.9, -0.1, 0.6);
        fill->SetColor(0.3, 0.2, 0.5);
        stage.renderer->AddLight(fill);
      } },
    { "point light with attenuation",
      [](Stage& stage, vtkActor*)
      { stage.addBulb(1.5, -2.0, 2.5)->SetAttenuationValues(0.5, 0.1, 0.05); } },
    { "spot light",
      [](Stage& stage, vtkActor* actor)
      {
        vtkLight* light = stage.addSun(1.5, -3.0, 2.5);
        light->PositionalOn();
        light->SetConeAngle(15.0);
        light->SetExponent(2.0);
        actor->GetProperty()->SetSpecular(0.3);
        actor->GetProperty()->SetSpecularPower(10.0);
      } },
    { "all kinds at once",
      [=](Stage& stage, vtkActor* actor)
      {
        sun(stage);
        vtkNew<vtkLight> headlight;
        headlight->SetLightTypeToHeadlight();
        headlight->SetIntensity(0.2);
        stage.renderer->AddLight(headlight);
        stage.addBulb(-2.0, -2.0, 1.0)->SetIntensity(0.3);
        actor->GetProperty()->SetSpecular(0.3);
        actor->GetProperty()->SetSpecularPower(30.0);
      } },
  };
}

void compareColors(const Mesh& mesh, Checks& checks)
{
  for (const Variant& variant : variants(mesh.data))
  {
    Stage stage(300, 300);
    variant.set(stage, show(stage, mesh.data));
    stage.usePass(false);
    const Picture raster = capture(stage.window);
    stage.usePass(true);
    stage.pass->SetLeafGeometryToTriangle();
    const Picture traced = capture(stage.window);
    const std::string name = mesh.name + ", " + variant.name;
    checks.expect(stage.pass->GetNumberOfTracedActors() == 1, name + ": traced");
    Mask mask = awayFromEdges(raster, 2);
    for (std::size_t i = 0; i < mask.size(); ++i)
    {
      mask[i] = mask[i] && raster.depth[i] < 1.0f;
    }
    const Difference d = difference(raster, traced, mask);
    std::cout << name << ": mean " << d.mean << ", p99 " << d.p99 << ", largest " << d.largest
              << " of " << d.pixels << " pixels\n";
    checks.expect(d.pixels > 5000, name + ": enough pixels away from edges");
    checks.expect(d.mean <= 2.0, name + ": 2 grey levels in the mean");
    checks.expect(d.p99 <= 8, name + ": 8 grey levels at p99");
  }
}
}

int TestAgainstRaster(int, char*[])
{
  Checks checks;
  for (const Mesh& mesh : meshes())
  {
    compareDepth(mesh, checks);
    compareColors(mesh, checks);
  }
  return checks.exitCode();
}
