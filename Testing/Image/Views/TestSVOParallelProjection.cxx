// Parallel projection: parallel rays, the same shadows.
#include "svoShadowOracle.h"
#include "svoTestStage.h"

#include "vtkCamera.h"

int TestSVOParallelProjection(int argc, char* argv[])
{
  using namespace svotest;
  Checks checks;
  Stage stage(340, 260);
  stage.renderer->GetActiveCamera()->ParallelProjectionOn();
  stage.renderer->GetActiveCamera()->SetParallelScale(2.2);
  ShadowOracle oracle;
  oracle.add(stage.addGround());
  oracle.add(stage.add(ring(0.9, -0.6, 0.0, 1.2), 0.9, 0.5, 0.3));
  oracle.add(stage.add(spike(1.2, 1.1, -0.5, 0.6), 0.4, 0.8, 0.4));
  oracle.add(stage.addBulb(1.5, -1.5, 4.0));

  const Picture unshadowed = stage.unshadowed();
  const Picture shadowed = stage.shadowed();
  expectShadows(checks, oracle.judge(stage.renderer, shadowed, unshadowed), "parallel projection");

  stage.usePass(false);
  const Picture raster = capture(stage.window);
  const Difference look = difference(raster, unshadowed, awayFromEdges(raster, 2));
  checks.expect(look.mean <= 2.0 && look.p99 <= 8, "without shadows it is VTK's own picture");

  stage.usePass(true);
  checks.expect(matchesBaseline(stage.window, argc, argv), "the baseline");
  return checks.exitCode();
}
