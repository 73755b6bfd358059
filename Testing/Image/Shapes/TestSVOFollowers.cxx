// Followers are traced, look as VTK draws them, and cast from where they are, which for one with a
// camera depends on the view.
#include "svoShadowOracle.h"
#include "svoTestStage.h"

#include "vtkAssembly.h"
#include "vtkCamera.h"
#include "vtkFollower.h"
#include "vtkProperty.h"

#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace svotest;

template <class Actor>
vtkSmartPointer<Actor> make(Stage& stage, vtkAlgorithm* source, double red, double green)
{
  vtkActor* plain = stage.add(source, red, green, 0.4);
  auto actor = vtkSmartPointer<Actor>::New();
  actor->SetMapper(plain->GetMapper());
  actor->SetProperty(plain->GetProperty());
  stage.renderer->RemoveActor(plain);
  return actor;
}

void turn(Stage& stage)
{
  stage.renderer->GetActiveCamera()->Azimuth(25.0);
}

/// Compares with VTK's picture and with a pass that has seen nothing before.
void expectPicture(Checks& checks, Stage& stage, int traced, const std::string& when)
{
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  stage.usePass(true);
  const Picture unshadowed = stage.unshadowed();
  const Difference look = difference(raster, unshadowed, awayFromEdges(raster, 2));
  std::cout << when << ": mean " << look.mean << ", p99 " << look.p99 << "\n";
  checks.expect(look.mean <= 1.0 && look.p99 <= 4, when + ": VTK's own picture");
  stage.expectTraced(checks, traced, when + ": all are traced");

  const Picture kept = stage.shadowed();
  vtkNew<vtkSVORenderPass> fresh;
  fresh->SetMaximumLevel(9);
  chooseBackend(fresh);
  stage.renderer->SetPass(fresh);
  checks.expect(capture(stage.window).rgb == kept.rgb, when + ": as if drawn afresh");
  stage.usePass(true);
}

void expectTurned(Checks& checks)
{
  Stage stage;
  vtkActor* ground = stage.addGround();
  vtkLight* sun = stage.addSun(2.0, -1.5, 4.0);
  const auto still = make<vtkFollower>(stage, ball(0.5, 0.0, 0.0, 0.0), 0.9, 0.5);
  still->SetPosition(-1.2, -0.4, 0.9);
  still->SetScale(1.0, 1.0, 0.7);
  const auto turning = make<vtkFollower>(stage, box(0.8, 0.1, 0.0, 0.0), 0.3, 0.8);
  turning->SetPosition(0.9, -0.3, 1.0);
  turning->SetCamera(stage.renderer->GetActiveCamera());
  ShadowOracle before, after;
  before.add(sun);
  after.add(sun);
  before.add(ground);
  after.add(ground);
  for (vtkActor* actor : std::vector<vtkActor*>{ still, turning })
  {
    stage.renderer->AddActor(actor);
    before.add(actor);
    checks.expect(vtkSVORenderPass::GetCastShadow(actor), "they cast");
    checks.expect(vtkSVORenderPass::GetReason(actor).empty(), "for no reason do they not");
  }
  expectPicture(checks, stage, 3, "as placed");
  expectShadows(
    checks, before.judge(stage.renderer, stage.shadowed(), stage.unshadowed()), "placed");

  turn(stage);
  expectPicture(checks, stage, 3, "from another side");
  for (vtkActor* actor : std::vector<vtkActor*>{ still, turning })
  {
    after.add(actor);
  }
  expectShadows(
    checks, after.judge(stage.renderer, stage.shadowed(), stage.unshadowed()), "turned");

  vtkNew<vtkCamera> other;
  other->SetPosition(-5.0, 1.0, 1.0);
  turning->SetCamera(other);
  expectPicture(checks, stage, 3, "following another camera");
  other->SetPosition(1.0, 1.0, 7.0);
  expectPicture(checks, stage, 3, "which moves by itself");

  // Rasterised, they cast and receive like others.
  vtkSVORenderPass::SetUseSVO(false, still);
  vtkSVORenderPass::SetUseSVO(false, turning);
  turning->SetPosition(-1.5, -0.2, 0.1); // in the ball's shadow
  ShadowOracle rasterized;
  rasterized.add(sun);
  for (vtkActor* actor : std::vector<vtkActor*>{ ground, still, turning })
  {
    rasterized.add(actor);
  }
  const Picture lit = stage.unshadowed();
  expectShadows(checks, rasterized.judge(stage.renderer, stage.shadowed(), lit), "rasterised");
  stage.expectRasterized(checks, 2, "two are rasterised");
}

void expectAssembly(Checks& checks)
{
  Stage stage;
  stage.addGround();
  stage.addSun(2.0, -1.5, 4.0);
  const auto turning = make<vtkFollower>(stage, box(0.8, 0.1, 0.0, 0.0), 0.3, 0.8);
  turning->SetPosition(0.4, 0.0, 0.8);
  turning->SetCamera(stage.renderer->GetActiveCamera());
  const auto still = make<vtkFollower>(stage, ball(0.4, -1.0, 0.0, 0.8), 0.9, 0.5);
  vtkNew<vtkAssembly> pair;
  pair->AddPart(turning);
  pair->AddPart(still);
  pair->RotateZ(20.0);
  stage.renderer->AddActor(pair);
  expectPicture(checks, stage, 3, "an assembly");
  turn(stage);
  expectPicture(checks, stage, 3, "an assembly from another side");
}
}

int TestSVOFollowers(int, char*[])
{
  Checks checks;
  expectTurned(checks);
  expectAssembly(checks);
  return checks.exitCode();
}
