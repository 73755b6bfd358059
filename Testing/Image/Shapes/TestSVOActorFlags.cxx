// Per prop and per light: cast, receive, trace at all.
#include "svoShadowOracle.h"
#include "svoTestStage.h"

int TestSVOActorFlags(int, char*[])
{
  using namespace svotest;
  Checks checks;
  Stage stage;
  vtkActor* ground = stage.addGround();
  vtkActor* first = stage.add(ball(0.6, -0.9, -0.2, 1.0), 0.9, 0.5, 0.3);
  vtkActor* second = stage.add(ball(0.6, 0.8, -0.2, 1.0), 0.3, 0.6, 0.9);
  vtkActor* third = stage.add(box(0.6, -1.7, 0.5, 0.3), 0.4, 0.8, 0.4);
  vtkLight* sun = stage.addSun(2.0, -1.5, 4.0);
  vtkLight* fill = stage.addSun(-2.0, -2.5, 4.0);
  fill->SetIntensity(0.4);
  const Picture unshadowed = stage.unshadowed();

  vtkSVORenderPass::SetCastShadow(false, second);
  vtkSVORenderPass::SetReceiveShadow(false, third);
  vtkSVORenderPass::SetCastShadow(false, fill);
  checks.expect(!vtkSVORenderPass::GetCastShadow(second), "the flag of a caster is kept");
  checks.expect(!vtkSVORenderPass::GetReceiveShadow(third), "the flag of a receiver is kept");
  checks.expect(!vtkSVORenderPass::GetCastShadow(fill), "the flag of a light is kept");
  ShadowOracle oracle;
  oracle.add(ground);
  oracle.add(first);
  oracle.add(second, false, true);
  oracle.add(third, true, false);
  oracle.add(sun);
  const Picture traced = stage.shadowed();
  expectShadows(checks, oracle.judge(stage.renderer, traced, unshadowed), "flags, traced");
  stage.expectTraced(checks, 4, "all four actors are traced");

  // The same flags hold when the rasteriser draws the actors.
  for (vtkActor* actor : { ground, first, second, third })
  {
    vtkSVORenderPass::SetUseSVO(false, actor);
  }
  const Picture rasterisedLit = stage.unshadowed();
  const Picture rasterised = stage.shadowed();
  stage.expectTraced(checks, 0, "no actor is traced");
  stage.expectRasterized(checks, 4, "all four are rasterised");
  expectShadows(
    checks, oracle.judge(stage.renderer, rasterised, rasterisedLit), "flags, rasterised");

  // Of a light kit's camera lights only the brightest casts, also before the next frame.
  vtkSVORenderPass::SetCastShadow(false, sun);
  vtkNew<vtkLight> key;
  vtkNew<vtkLight> other;
  for (vtkLight* light : { key.Get(), other.Get() })
  {
    light->SetLightTypeToCameraLight();
    stage.renderer->AddLight(light);
  }
  other->SetIntensity(0.5);
  stage.shadowed();
  checks.expect(vtkSVORenderPass::GetCastShadow(key), "the brightest camera light casts");
  checks.expect(!vtkSVORenderPass::GetCastShadow(other), "another one does not");
  other->SetIntensity(2.0);
  checks.expect(!vtkSVORenderPass::GetCastShadow(key), "until it is the brightest");
  checks.expect(vtkSVORenderPass::GetCastShadow(other), "then it does");
  return checks.exitCode();
}
