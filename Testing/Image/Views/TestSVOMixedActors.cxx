// Traced and rasterised actors stand in one frame, at the right depth, and shadow each other.
#include "svoShadowOracle.h"
#include "svoTestStage.h"

#include "vtkProperty.h"

int TestSVOMixedActors(int argc, char* argv[])
{
  using namespace svotest;
  Checks checks;
  Stage stage;
  ShadowOracle oracle;
  oracle.add(stage.addGround());
  oracle.add(stage.add(ball(0.7, -0.9, -0.3, 0.9), 0.9, 0.5, 0.3));
  oracle.add(stage.add(ring(0.8, 0.9, 0.8, 1.0), 0.3, 0.6, 0.9));
  // Visible edges are the rasteriser's business.
  vtkActor* edged = stage.add(box(0.8, 0.8, -1.2, 0.4), 0.5, 0.8, 0.4);
  edged->GetProperty()->EdgeVisibilityOn();
  oracle.add(edged);
  oracle.add(stage.addSun(2.0, -1.5, 4.0));

  const Picture unshadowed = stage.unshadowed();
  const Picture shadowed = stage.shadowed();
  stage.expectRasterized(checks, 1, "one actor is left to the rasteriser");
  expectShadows(checks, oracle.judge(stage.renderer, shadowed, unshadowed), "mixed actors");

  stage.usePass(false);
  const Picture raster = capture(stage.window);
  const Difference look = difference(raster, unshadowed, awayFromEdges(raster, 2));
  checks.expect(look.mean <= 2.0 && look.p99 <= 8, "without shadows it is VTK's own picture");

  stage.usePass(true);
  checks.expect(matchesBaseline(stage.window, argc, argv), "the baseline");
  return checks.exitCode();
}
