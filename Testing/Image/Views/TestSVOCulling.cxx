// Culling of objects: what is left out and counted by the view, by what hides it and for being
// small; that switches change no pixel, and that still pictures leave out nothing that is seen.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"

#include <iostream>

namespace
{
using namespace svotest;
using Pass = vtkSVORenderPass;

constexpr double Still = 0.0001; // Hz
constexpr double Interactive = 10;

/// Balls in rows on the ground, from far on the left to far on the right.
void addBalls(Stage& stage, int across, int deep)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(48);
  source->SetPhiResolution(24);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  for (int i = 0; i < across * deep; ++i)
  {
    vtkNew<vtkActor> ball;
    ball->SetMapper(mapper);
    ball->SetScale(0.2);
    ball->SetPosition(0.4 * (i % across - 0.5 * across), 0.4 * (i / across), 0.11);
    ball->GetProperty()->SetColor(0.9, 0.4 + 0.01 * (i % 40), 0.3);
    stage.renderer->AddActor(ball);
  }
}

bool same(const Picture& a, const Picture& b)
{
  return a.rgb == b.rgb && a.depth == b.depth;
}

void look(Stage& stage)
{
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->SetPosition(0.0, -5.0, 0.8);
  camera->SetFocalPoint(0.0, 1.0, 0.2);
  camera->SetViewUp(0.0, 0.0, 1.0);
  stage.renderer->ResetCameraClippingRange();
}

void testSteps(Checks& checks)
{
  Stage stage(240, 180);
  stage.pass->SetBuildInBackground(false);
  stage.pass->SetFrameCoherence(false);
  stage.addSun(2.0, -1.5, 4.0);
  stage.addGround();
  addBalls(stage, 40, 8);
  look(stage);
  stage.window->SetDesiredUpdateRate(Still);
  const auto culled = [&](int step) { return stage.pass->GetNumberOfCulledInstances(step); };

  const Picture open = capture(stage.window);
  const vtkIdType outside = culled(Pass::CULLED_BY_VIEW);
  const vtkIdType hiddenBefore = culled(Pass::CULLED_BY_OCCLUSION);
  std::cout << outside << " of 320 balls lie outside of the view\n";
  checks.expect(outside > 40 && outside < 280, "the view leaves out what lies beside it");
  checks.expect(culled(Pass::CULLED_BY_DETAIL) == 0, "a still picture has all that is small");
  checks.expect(culled(Pass::CULLED_CASTERS) > 0, "casters whose shadows are not seen are counted");
  checks.expect(stage.pass->GetNumberOfCulledInstances() == outside + hiddenBefore,
    "without a step it is the sum of the eye's");

  stage.pass->SetViewCulling(false);
  const Picture flat = capture(stage.window);
  checks.expect(same(open, flat), "a tree of the scene changes no pixel");
  checks.expect(culled(Pass::CULLED_BY_VIEW) == outside, "nor what lies outside");
  stage.pass->SetViewCulling(true);

  // A wall before them.
  vtkActor* wall = stage.add(box(1.0, 0.0, 0.0, 0.0), 0.6, 0.6, 0.7);
  wall->SetScale(6.0, 0.1, 6.0);
  wall->SetPosition(0.0, -1.0, 0.0);
  const Picture behind = capture(stage.window);
  const vtkIdType hidden = culled(Pass::CULLED_BY_OCCLUSION);
  std::cout << hidden << " of the others are behind the wall\n";
  checks.expect(hidden > 20 && hidden > hiddenBefore, "what a wall hides is left out");
  stage.pass->SetOcclusionCulling(false);
  checks.expect(same(behind, capture(stage.window)), "that changes no pixel");
  checks.expect(culled(Pass::CULLED_BY_OCCLUSION) == 0, "and is a switch");
}

void testDetail(Checks& checks)
{
  Stage stage(240, 180);
  stage.pass->SetBuildInBackground(false);
  stage.pass->SetAutoAdjustSampleDistances(false);
  stage.addSun(2.0, -1.5, 4.0);
  stage.addGround();
  addBalls(stage, 20, 8);
  look(stage);
  stage.window->SetDesiredUpdateRate(Still);
  const Picture still = capture(stage.window);
  stage.window->SetDesiredUpdateRate(Interactive);
  checks.expect(same(still, capture(stage.window)), "by default interaction shows all");
  stage.pass->SetDetailCullingThreshold(80.0);
  const Picture fewer = capture(stage.window);
  const vtkIdType small = stage.pass->GetNumberOfCulledInstances(Pass::CULLED_BY_DETAIL);
  const double error = stage.pass->GetAcceptedPixelError();
  std::cout << small << " of 160 balls are small; an error of " << error << " pixels\n";
  checks.expect(small > 0 && small < 160, "while somebody interacts what is small is left out");
  checks.expect(!same(still, fewer), "which is seen");
  checks.expect(error >= 5.0 && error <= 80.0, "and counted as an error");
  stage.window->SetDesiredUpdateRate(Still);
  checks.expect(same(still, capture(stage.window)), "a still picture has all of them again");
  checks.expect(stage.pass->GetAcceptedPixelError() == 1.0, "and says so");
}
}

int TestSVOCulling(int, char*[])
{
  Checks checks;
  testSteps(checks);
  testDetail(checks);
  return checks.exitCode();
}
