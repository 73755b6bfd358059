// The traced picture of a mesh against VTK's own raster of it.
#include "svoRasterComparison.h"

#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkElevationFilter.h"
#include "vtkMath.h"
#include "vtkPointDataToCellData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <vector>

namespace svotest
{
namespace
{
constexpr int Level = 10;

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

/// Linear depth in units of a pixel's width there; negative where nothing was drawn.
std::vector<double> depthInPixels(const Picture& picture, vtkCamera* camera)
{
  double range[2];
  camera->GetClippingRange(range);
  const double pixel =
    2.0 * std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle())) / picture.height;
  std::vector<double> depths(picture.size(), -1.0);
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    if (picture.depth[i] < 1.0f)
    {
      // Logarithmic, so that a step of one is a pixel's width at any depth.
      depths[i] = std::log(linear(picture.depth[i], range)) / pixel;
    }
  }
  return depths;
}

/// Pixels that were drawn and are at least `radius` pixels from any silhouette: no neighbour is
/// the background, nor 5 pixels' widths in front or behind (a surface at 79 degrees or another
/// one).
Mask awayFromSilhouettes(const Picture& picture, vtkCamera* camera, int radius)
{
  constexpr double Jump = 5.0;
  const std::vector<double> depth = depthInPixels(picture, camera);
  Mask mask(picture.size(), 0);
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y) * picture.width + x; };
  for (int y = radius; y < picture.height - radius; ++y)
  {
    for (int x = radius; x < picture.width - radius; ++x)
    {
      bool away = true;
      for (int j = y - radius; j <= y + radius && away; ++j)
      {
        for (int i = x - radius; i <= x + radius && away; ++i)
        {
          const double here = depth[at(i, j)];
          const double right = i < x + radius ? depth[at(i + 1, j)] : here;
          const double above = j < y + radius ? depth[at(i, j + 1)] : here;
          away = std::min({ here, right, above }) >= 0.0 && std::abs(right - here) <= Jump &&
            std::abs(above - here) <= Jump;
        }
      }
      mask[at(x, y)] = away;
    }
  }
  return mask;
}

/// How many pixels of a mask both cover, and how many of these have depths within `voxels` of each
/// other.
struct Agreement
{
  std::size_t both = 0;
  std::size_t within = 0;

  double share() const { return both ? static_cast<double>(within) / both : 0.0; }
};

Agreement agreement(
  const Picture& a, const Picture& b, vtkCamera* camera, double distance, const Mask& mask)
{
  double range[2];
  camera->GetClippingRange(range);
  Agreement result;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    if (mask[i] && a.depth[i] < 1.0f && b.depth[i] < 1.0f)
    {
      ++result.both;
      result.within += std::abs(linear(a.depth[i], range) - linear(b.depth[i], range)) <= distance;
    }
  }
  return result;
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
    // From 90 degrees on VTK takes it for a point light, whose exponent means nothing.
    { "cone of 90 degrees",
      [](Stage& stage, vtkActor*)
      {
        vtkLight* light = stage.addBulb(1.5, -2.0, 2.5);
        light->SetConeAngle(90.0);
        light->SetExponent(2.0);
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
}

void compareDepthWithRaster(const NamedMesh& mesh, bool silhouettesToo, Checks& checks)
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
  const Mask everywhere(raster.size(), 1);
  const Mask away = awayFromSilhouettes(raster, camera, 2);

  stage.pass->SetLeafGeometryToTriangle();
  const Picture triangles = capture(stage.window);
  stage.expectTraced(checks, 1, mesh.name + " is traced");
  const Agreement exact = agreement(raster, triangles, camera, 0.05 * voxelSize, everywhere);
  std::cout << mesh.name << ": triangle leaves within 0.05 voxel on " << 100.0 * exact.share()
            << " % of " << exact.both << " pixels\n";
  checks.expect(exact.both > 100000, mesh.name + " covers enough pixels");
  checks.expect(exact.share() >= 0.999, mesh.name + ": triangle leaves to 0.05 voxel on 99.9 %");

  stage.pass->SetLeafGeometryToPlane();
  const Picture planes = capture(stage.window);
  const Agreement near = agreement(raster, planes, camera, 2.0 * voxelSize, everywhere);
  const Agreement inside = agreement(raster, planes, camera, 2.0 * voxelSize, away);
  std::cout << mesh.name << ": plane leaves within 2 voxels on " << 100.0 * near.share() << " % of "
            << near.both << " pixels, " << 100.0 * inside.share() << " % of " << inside.both
            << " away from silhouettes\n";
  checks.expect((silhouettesToo ? near : inside).share() >= 0.99,
    mesh.name + ": plane leaves to 2 voxels on 99 %");
}

void compareColorsWithRaster(const NamedMesh& mesh, Checks& checks)
{
  for (const Variant& variant : variants(mesh.data))
  {
    Stage stage(500, 500);
    variant.set(stage, show(stage, mesh.data));
    stage.usePass(false);
    const Picture raster = capture(stage.window);
    stage.usePass(true);
    stage.pass->SetLeafGeometryToTriangle();
    const Picture traced = capture(stage.window);
    const std::string name = mesh.name + ", " + variant.name;
    stage.expectTraced(checks, 1, name + ": traced");
    const Mask mask = awayFromSilhouettes(raster, stage.renderer->GetActiveCamera(), 2);
    const Difference d = difference(raster, traced, mask);
    std::cout << name << ": mean " << d.mean << ", p99 " << d.p99 << ", largest " << d.largest
              << " of " << d.pixels << " pixels\n";
    checks.expect(d.pixels > 5000, name + ": enough pixels away from silhouettes");
    checks.expect(d.mean <= 2.0, name + ": 2 grey levels in the mean");
    checks.expect(d.p99 <= 8, name + ": 8 grey levels at p99");
  }
}
}
