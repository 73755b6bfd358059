// Lines that lie in a traced surface show as they do on a rasterised one.
#include "svoTestStage.h"

#include "vtkContourFilter.h"
#include "vtkElevationFilter.h"
#include "vtkMapper.h"
#include "vtkProperty.h"

#include <iostream>

namespace
{
// The lines are pure magenta and nothing else is.
std::size_t linePixels(const svotest::Picture& picture)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.size(); ++i)
  {
    const unsigned char* rgb = &picture.rgb[3 * i];
    count += rgb[0] > 250 && rgb[1] < 5 && rgb[2] > 250;
  }
  return count;
}
}

int TestSVOContourLines(int argc, char* argv[])
{
  using namespace svotest;
  Checks checks;
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  Stage stage;
  stage.addGround();
  const auto surface = ring(0.9, 0.0, 0.0, 1.0);
  stage.add(surface, 0.8, 0.8, 0.4);
  vtkNew<vtkElevationFilter> height;
  height->SetInputConnection(surface->GetOutputPort());
  height->SetLowPoint(0.0, 0.0, 0.0);
  height->SetHighPoint(0.0, 0.0, 2.0);
  vtkNew<vtkContourFilter> contours;
  contours->SetInputConnection(height->GetOutputPort());
  contours->GenerateValues(12, 0.1, 0.9);
  vtkActor* lines = stage.add(contours, 1.0, 0.0, 1.0);
  lines->GetProperty()->LightingOff();
  lines->GetProperty()->SetLineWidth(2.0);
  stage.addSun(2.0, -1.5, 4.0);

  const std::size_t traced = linePixels(stage.unshadowed());
  stage.usePass(false);
  const std::size_t rasterised = linePixels(capture(stage.window));
  std::cout << "pixels of lines: " << traced << " traced, " << rasterised << " rasterised\n";
  checks.expect(rasterised > 500, "there are lines to be seen");
  checks.expect(traced > 0.97 * rasterised && traced < 1.03 * rasterised,
    "as many pixels of lines on the traced surface as on the rasterised one");

  stage.usePass(true);
  stage.pass->SetShadowTechniqueToShadowBuffer();
  checks.expect(matchesBaseline(stage.window, argc, argv), "the baseline");
  vtkMapper::SetResolveCoincidentTopology(VTK_RESOLVE_OFF);
  return checks.exitCode();
}
