// Two renderers of one window, each with a pass of its own, and an actor that stands in both; then
// the same with one pass for both.
#include "svoShadowOracle.h"
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <iostream>

namespace
{
using namespace svotest;

/// Frame after frame another mesh in each renderer, and no memory to keep octrees in: those of one
/// frame lie where those of the last one lay.
void expectOnePassIsEnough(Checks& checks)
{
  constexpr int Frames = 20;
  Stage left(240, 120);
  left.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  Stage right(left, 0.5, 0.0, 1.0, 1.0);
  Stage* stages[] = { &left, &right };
  vtkNew<vtkSphereSource> balls[2];
  for (int i = 0; i < 2; ++i)
  {
    balls[i]->SetThetaResolution(24);
    balls[i]->SetPhiResolution(16);
    balls[i]->SetRadius(0.9);
    stages[i]->add(balls[i], 0.9, 0.5, 0.2);
    stages[i]->addGround();
    stages[i]->addSun(2.0, -1.5, 4.0);
    stages[i]->pass->SetFrameCoherence(false);
  }
  vtkNew<vtkSVORenderPass> shared;
  shared->SetMaximumLevel(9);
  chooseBackend(shared);
  shared->SetOctreeMemoryLimit(0);
  int wrong = 0;
  std::size_t most = 0;
  for (int frame = 0; frame < Frames; ++frame)
  {
    for (int i = 0; i < 2; ++i)
    {
      const int pose = (frame / (i + 1)) % 3;
      balls[i]->SetCenter(0.5 * pose - 0.5, 0.0, 1.2); // octrees of one size
      stages[i]->renderer->SetPass(shared);
    }
    const Picture one = capture(left.window);
    left.usePass(true);
    right.usePass(true);
    const Picture two = capture(left.window);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
    {
      differ += !std::equal(&one.rgb[3 * i], &one.rgb[3 * i] + 3, &two.rgb[3 * i]);
    }
    wrong += differ > 0;
    most = std::max(most, differ);
  }
  std::cout << "one pass for both: " << wrong << " of " << Frames << " frames differ, by " << most
            << " pixels at most\n";
  checks.expect(wrong == 0, "one pass draws both renderers as two do");
}
}

int TestSVOTwoRenderers(int argc, char* argv[])
{
  using namespace svotest;
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
  left.shadowed();
  const Picture shadowed = right.shadowed();
  expectShadows(checks, leftOracle.judge(left.renderer, shadowed, unshadowed), "left renderer");
  expectShadows(checks, rightOracle.judge(right.renderer, shadowed, unshadowed), "right renderer");
  checks.expect(matchesBaseline(left.window, argc, argv), "the baseline");

  // Frames of the two alternate in one pass, whose shaders and statistics are those of the last.
  right.renderer->SetPass(left.pass);
  for (int frame = 0; frame < 2; ++frame)
  {
    const Picture again = left.shadowed();
    checks.expect(difference(again, shadowed).largest == 0, "one pass for both");
  }
  expectOnePassIsEnough(checks);
  return checks.exitCode();
}
