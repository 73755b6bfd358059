// Triangles a thousand times as long as wide, as of pipes, cables and strips of road: colours and
// normals are interpolated as VTK does, and thin tubes do not shadow themselves.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkElevationFilter.h"
#include "vtkLineSource.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkTubeFilter.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

vtkSmartPointer<vtkAlgorithm> tube(double length, double radius, double y, double z)
{
  vtkNew<vtkLineSource> line;
  line->SetPoint1(-0.5 * length, y, z);
  line->SetPoint2(0.5 * length, y, z);
  auto source = vtkSmartPointer<vtkTubeFilter>::New();
  source->SetInputConnection(line->GetOutputPort());
  source->SetRadius(radius);
  source->SetNumberOfSides(8);
  source->CappingOn();
  return source;
}

/// Coloured across by its points.
vtkSmartPointer<vtkAlgorithm> strip(double length, double width)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.5 * length, -0.5 * width, 0.0);
  plane->SetPoint1(0.5 * length, -0.5 * width, 0.0);
  plane->SetPoint2(-0.5 * length, 0.5 * width, 0.0);
  auto source = vtkSmartPointer<vtkElevationFilter>::New();
  source->SetInputConnection(plane->GetOutputPort());
  source->SetLowPoint(0.0, -0.5 * width, 0.0);
  source->SetHighPoint(0.0, 0.5 * width, 0.0);
  return source;
}

int largestDifference(const Picture& a, const Picture& b, std::size_t pixel)
{
  int largest = 0;
  for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c)
  {
    largest = std::max(largest, std::abs(int(a.rgb[c]) - int(b.rgb[c])));
  }
  return largest;
}

std::size_t unlike(const Picture& a, const Picture& b, int most)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    count += largestDifference(a, b, i) > most;
  }
  return count;
}

struct Eye
{
  double position[3], focalPoint[3];
};

void check(
  const std::string& name, vtkAlgorithm* source, const Eye& eye, bool scalars, Checks& checks)
{
  Stage stage(500, 400);
  vtkActor* actor = stage.add(source, 0.9, 0.4, 0.1);
  actor->GetMapper()->SetScalarVisibility(scalars);
  stage.addSun(3.0, -4.0, 5.0);
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->SetPosition(eye.position);
  camera->SetFocalPoint(eye.focalPoint);
  stage.renderer->ResetCameraClippingRange();
  stage.pass->SetMaximumLevel(10); // the default
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  stage.usePass(true);
  const Picture traced = stage.unshadowed();
  std::size_t seen = 0;
  for (std::size_t i = 0; i < traced.size(); ++i)
  {
    seen += traced.depth[i] < 1.0f;
  }
  const std::size_t wrong = unlike(raster, traced, 8);
  const std::size_t buffer = unlike(traced, stage.shadowedByBuffers(), 24);
  const std::size_t rays = unlike(traced, stage.shadowedByRays(), 24);
  std::cout << name << ": of " << seen << " pixels " << wrong << " unlike VTK's by more than 8, "
            << buffer << " in their own shadow by buffers, " << rays << " by rays\n";
  checks.expect(seen > 1000, name + ": is seen");
  checks.expect(100 * wrong < 3 * seen, name + ": VTK's own picture");
  checks.expect(100 * buffer < seen, name + ": no shadow of its own by buffers");
  checks.expect(100 * rays < seen, name + ": no shadow of its own by rays");
}
}

int TestSVOSlenderTriangles(int, char*[])
{
  using svotest::Checks;
  Checks checks;
  const Eye near{ { 0.0, -1.0, 1.6 }, { 0.0, 0.0, 1.0 } };
  check("tube 100 long, 0.06 wide", tube(100.0, 0.03, 0.0, 1.0), near, false, checks);
  check("tube 200 long, 0.06 wide", tube(200.0, 0.03, 0.0, 1.0), near, false, checks);
  const Eye far{ { -12.0, -12.0, 6.0 }, { 0.0, 0.0, 1.0 } };
  check("tube 100 long from its end", tube(100.0, 0.03, 0.0, 2.4), far, false, checks);
  check("tube 100 long in grazing view", tube(100.0, 0.03, -4.0, 0.82), far, false, checks);
  const Eye above{ { 0.3, -1.2, 0.8 }, { 0.0, 0.0, 0.0 } };
  check("strip 1000 long, 0.5 wide", strip(1000.0, 0.5), above, true, checks);
  return checks.exitCode();
}
