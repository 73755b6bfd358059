// Translucent actors blend over traced ones, behind and in front, as over rasterised ones.
#include "svoShadowOracle.h"
#include "svoTestStage.h"

#include "vtkProperty.h"

int TestSVOTranslucent(int argc, char* argv[])
{
  using namespace svotest;
  Checks checks;
  Stage stage;
  stage.pass->TranslucentShadowsOff(); // TestSVOTranslucentShadows has them
  ShadowOracle oracle;
  oracle.add(stage.addGround());
  oracle.add(stage.add(ball(0.7, 0.3, 0.4, 0.9), 0.9, 0.5, 0.3));
  vtkActor* glass = stage.add(ball(0.8, -0.5, -1.0, 0.9), 0.3, 0.5, 1.0);
  glass->GetProperty()->SetOpacity(0.4);
  oracle.add(stage.addSun(2.0, -1.5, 4.0));

  const Picture unshadowed = stage.unshadowed();
  const Picture shadowed = stage.shadowed();
  stage.expectRasterized(checks, 1, "the glass is left to the rasteriser");
  expectShadows(checks, oracle.judge(stage.renderer, shadowed, unshadowed, 4), "translucent");

  stage.usePass(false);
  const Picture raster = capture(stage.window);
  const Difference look = difference(raster, unshadowed, awayFromEdges(raster, 3));
  checks.expect(look.mean <= 2.0 && look.p99 <= 8, "without shadows it is VTK's own picture");

  stage.usePass(true);
  checks.expect(matchesBaseline(stage.window, argc, argv), "the baseline");
  return checks.exitCode();
}
