// Any affine matrix: the same octree moved and turned, stretched, mirrored and sheared. (VTK lights
// a mirrored mesh by normals that point inwards: it is dark, with the pass as without.)
#include "svoShadowOracle.h"
#include "svoTestStage.h"

#include "vtkMatrix4x4.h"

int TestSVOMatrices(int argc, char* argv[])
{
  using namespace svoTest;
  Checks checks;
  Stage stage(360, 300);
  ShadowOracle oracle;
  vtkActor* ground = stage.addGround();
  const auto source = spike(1.2, 0.0, 0.0, 0.6);
  vtkActor* moved = stage.add(source, 0.9, 0.5, 0.3);
  moved->SetPosition(-1.5, -0.8, 0.3);
  moved->RotateWXYZ(55.0, 1.0, 0.5, 0.2);
  vtkActor* stretched = stage.add(source, 0.4, 0.8, 0.4);
  stretched->SetPosition(-0.6, 1.2, 0.0);
  stretched->SetScale(0.5, 1.5, 1.8);

  const auto other = ring(0.7, 0.0, 0.0, 0.0);
  vtkActor* mirrored = stage.add(other, 0.4, 0.6, 0.9);
  mirrored->SetPosition(1.3, 0.9, 1.1);
  mirrored->SetScale(-1.0, 1.0, 1.0);
  mirrored->RotateY(30.0);
  vtkActor* sheared = stage.add(other, 0.9, 0.8, 0.3);
  vtkNew<vtkMatrix4x4> shear;
  shear->SetElement(0, 2, 0.8);
  shear->SetElement(1, 0, 0.3);
  shear->SetElement(0, 3, 0.7);
  shear->SetElement(1, 3, -1.1);
  shear->SetElement(2, 3, 0.9);
  sheared->SetUserMatrix(shear);
  for (vtkActor* actor : { ground, moved, stretched, mirrored, sheared })
  {
    oracle.add(actor);
  }
  oracle.add(stage.addSun(2.0, -1.5, 4.0));

  const Picture unshadowed = stage.unshadowed();
  const Picture shadowed = stage.shadowed();
  expectShadows(checks, oracle.judge(stage.renderer, shadowed, unshadowed), "matrices");
  checks.expect(stage.pass->GetNumberOfRasterizedActors() == 0, "everything is traced");

  stage.usePass(false);
  const Picture raster = capture(stage.window);
  const Difference look = difference(raster, unshadowed, awayFromEdges(raster, 2));
  checks.expect(look.mean <= 2.0 && look.p99 <= 8, "without shadows it is VTK's own picture");

  stage.usePass(true);
  checks.expect(matchesBaseline(stage.window, argc, argv), "the baseline");
  return checks.exitCode();
}
