// Two renderers of one window, each with a pass of its own, and an actor that stands in both.
#include "svoShadowOracle.h"
#include "svoTestStage.h"

#include "vtkCamera.h"

int TestSVOTwoRenderers(int argc, char* argv[])
{
  using namespace svoTest;
  Checks checks;
  Stage left(500, 250);
  left.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  Stage right(left, 0.5, 0.0, 1.0, 1.0);
  right.renderer->GetActiveCamera()->SetPosition(-4.0, -5.0, 5.0);

  ShadowOracle leftOracle;
  ShadowOracle rightOracle;
  vtkActor* shared = left.add(ring(0.9, 0.0, 0.0, 1.1), 0.9, 0.6, 0.2);
  right.renderer->AddActor(shared);
  leftOracle.add(shared);
  rightOracle.add(shared);
  leftOracle.add(left.addGround());
  rightOracle.add(right.addGround(2.0));
  rightOracle.add(right.add(spike(1.0, 1.0, -1.0, 0.5), 0.3, 0.8, 0.5));
  leftOracle.add(left.addSun(2.0, -1.5, 4.0));
  rightOracle.add(right.addBulb(-1.0, -2.5, 3.5));

  left.pass->SetShadowTechniqueToNone();
  const Picture unshadowed = right.unshadowed();
  left.pass->SetShadowTechniqueToShadowBuffer();
  const Picture shadowed = right.shadowed();
  expectShadows(checks, leftOracle.judge(left.renderer, shadowed, unshadowed), "left renderer");
  expectShadows(checks, rightOracle.judge(right.renderer, shadowed, unshadowed), "right renderer");
  checks.expect(matchesBaseline(left.window, argc, argv), "the baseline");
  return checks.exitCode();
}
