// Meshes whose triangles are smaller than pixels: their outlines are no fatter than VTK's, their
// rims have no dots, their facets are the ones that VTK shows. With default settings, at every
// PixelError: down to bricks of some dozens of triangles these are tested one by one. Shadows, for
// which octrees are deeper, change no outline.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkPlaneSource.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkSuperquadricSource.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

vtkSmartPointer<vtkAlgorithm> denseBall()
{
  auto source = vtkSmartPointer<vtkSphereSource>::New();
  source->SetThetaResolution(1000);
  source->SetPhiResolution(1000);
  return source;
}

vtkSmartPointer<vtkAlgorithm> denseRing(int resolution)
{
  auto source = vtkSmartPointer<vtkSuperquadricSource>::New();
  source->ToroidalOn();
  source->SetThickness(0.35);
  source->SetThetaRoundness(1.0);
  source->SetPhiRoundness(1.0);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  return source;
}

/// Without normals: every facet is seen.
vtkSmartPointer<vtkAlgorithm> terrain()
{
  constexpr int Resolution = 800;
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(Resolution, Resolution);
  plane->Update();
  vtkNew<vtkPolyData> mesh;
  mesh->CopyStructure(plane->GetOutput());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    x[2] = 0.05 * std::sin(9.0 * x[0]) * std::cos(7.0 * x[1]) +
      0.02 * std::sin(40.0 * x[0] + 3.0 * x[1]) + 0.005 * std::sin(170.0 * x[1] + 30.0 * x[0]);
    mesh->GetPoints()->SetPoint(i, x);
  }
  auto producer = vtkSmartPointer<vtkTrivialProducer>::New();
  producer->SetOutput(mesh);
  return producer;
}

bool shows(const Picture& picture, std::size_t pixel)
{
  return picture.depth[pixel] < 1.0f;
}

void compare(
  const std::string& name, vtkAlgorithm* source, int size, double pixelError, Checks& checks)
{
  Stage stage(size, size);
  stage.add(source, 0.9, 0.7, 0.5);
  stage.addSun(2.0, -3.0, 4.0);
  stage.renderer->ResetCamera();
  stage.pass->SetShadowTechniqueToNone();
  stage.pass->SetMaximumLevel(10); // the default
  stage.pass->SetPixelError(pixelError);
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  stage.usePass(true);
  const Picture traced = capture(stage.window);
  stage.expectTraced(checks, 1, name + ": it is traced");
  int covered = 0, more = 0, wrong = 0, black = 0;
  for (std::size_t i = 0; i < raster.size(); ++i)
  {
    covered += shows(raster, i);
    more += shows(traced, i) - shows(raster, i);
    int largest = 0;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
    {
      largest = std::max(largest, std::abs(int(raster.rgb[c]) - int(traced.rgb[c])));
    }
    wrong += largest > 10;
    black += traced.grey(i) < 8.0 && raster.grey(i) > 40.0;
  }
  std::cout << name << ", pixel error " << pixelError << ": " << more << " of " << covered
            << " pixels more, " << wrong << " differ by more than 10, " << black << " are black\n";
  checks.expect(covered > 1000, name + ": it is seen");
  checks.expect(std::abs(more) < 10, name + ": no fatter than the raster's");
  checks.expect(wrong < covered / 200, name + ": the raster's colours");
  checks.expect(black <= 1, name + ": no black dots");
}

/// Pixels that are not covered by both pictures, but by one.
int outlineDifference(const Picture& a, const Picture& b)
{
  int different = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    different += shows(a, i) != shows(b, i);
  }
  return different;
}

/// Unlit, some dozens of pixels wide.
void compareOutlines(const std::string& name, vtkAlgorithm* source, double distance, Checks& checks)
{
  Stage stage(200, 200);
  vtkActor* actor = stage.add(source, 0.9, 0.7, 0.5);
  actor->GetProperty()->LightingOff();
  stage.addSun(2.0, -3.0, 4.0);
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->SetPosition(0.0, -0.6 * distance, 0.8 * distance);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetClippingRange(0.1 * distance, 10.0 * distance);
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  stage.usePass(true);
  const Picture without = stage.unshadowed();
  const Picture pictures[] = { without, stage.shadowedByBuffers(), stage.shadowedByRays() };
  stage.expectTraced(checks, 1, name + ": it is traced");
  int covered = 0;
  for (std::size_t i = 0; i < raster.size(); ++i)
  {
    covered += shows(raster, i);
  }
  std::cout << name << " from " << distance << ": " << covered << " pixels";
  for (const Picture& picture : pictures)
  {
    const int fromRaster = outlineDifference(picture, raster);
    const int fromUnshadowed = outlineDifference(picture, without);
    std::cout << "; " << fromRaster << " differ from the raster's, " << fromUnshadowed
              << " from those without shadows";
    checks.expect(fromRaster <= 2 + covered / 100, name + ": the raster's outline");
    checks.expect(fromUnshadowed <= 2, name + ": shadows change no outline");
  }
  std::cout << '\n';
  checks.expect(covered > 100, name + ": it is seen");
}
}

int TestSVODenseMeshes(int, char*[])
{
  Checks checks;
  const auto ofBall = denseBall(), ofRing = denseRing(200), ofTerrain = terrain();
  for (const double pixelError : { 1.0, 0.0 })
  {
    compare("ball of a thousand squared", ofBall, 400, pixelError, checks);
    compare("small ring", ofRing, 100, pixelError, checks);
    compare("terrain", ofTerrain, 300, pixelError, checks);
  }
  for (const int resolution : { 64, 100 })
  {
    for (const double distance : { 6.0, 8.0, 12.0, 20.0 })
    {
      compareOutlines("ring of " + std::to_string(resolution) + " squared", denseRing(resolution),
        distance, checks);
    }
  }
  return checks.exitCode();
}
