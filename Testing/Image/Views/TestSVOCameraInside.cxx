// The camera and the light stand inside a traced room, among traced things.
#include "svoShadowOracle.h"
#include "svoTestStage.h"

#include "vtkCamera.h"

int TestSVOCameraInside(int argc, char* argv[])
{
  using namespace svotest;
  Checks checks;
  Stage stage;
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->SetPosition(1.2, -2.2, 0.6);
  camera->SetFocalPoint(-0.3, 0.5, -0.4);
  camera->SetViewAngle(60.0);
  camera->SetClippingRange(0.05, 20.0);
  ShadowOracle oracle;
  oracle.add(stage.add(ball(3.0, 0.0, 0.0, 0.0), 0.6, 0.7, 0.9));
  oracle.add(stage.add(ring(0.8, 0.0, 0.3, -0.6), 0.9, 0.5, 0.3));
  oracle.add(stage.add(box(0.6, -1.0, -0.4, -1.0), 0.5, 0.8, 0.4));
  oracle.add(stage.addBulb(0.5, -0.5, 1.5));

  const Picture unshadowed = stage.unshadowed();
  const Picture shadowed = stage.shadowed();
  expectShadows(checks, oracle.judge(stage.renderer, shadowed, unshadowed), "camera inside");
  bool closed = true;
  for (float depth : shadowed.depth)
  {
    closed = closed && depth < 1.0f;
  }
  checks.expect(closed, "nothing outside is seen from inside a closed room");

  stage.usePass(false);
  const Picture raster = capture(stage.window);
  const Difference look = difference(raster, unshadowed, awayFromEdges(raster, 2));
  checks.expect(look.mean <= 2.0 && look.p99 <= 8, "without shadows it is VTK's own picture");

  stage.usePass(true);
  checks.expect(matchesBaseline(stage.window, argc, argv), "the baseline");
  return checks.exitCode();
}
