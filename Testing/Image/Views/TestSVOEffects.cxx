// VTK's own effects go on working around traced surfaces: ambient occlusion, depth peeling, FXAA.
// The renderer's switches act as they do without a pass.
#include "svoTestStage.h"

#include "vtkProperty.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <string>

int TestSVOEffects(int, char*[])
{
  using namespace svotest;
  Checks checks;
  struct Effect
  {
    const char* name;
    std::function<void(Stage&)> on;
  };
  const Effect effects[] = {
    { "none", [](Stage&) {} },
    { "ambient occlusion",
      [](Stage& stage)
      {
        stage.renderer->UseSSAOOn();
        stage.renderer->SetSSAORadius(0.5);
        stage.renderer->SetSSAOKernelSize(64);
        stage.renderer->SSAOBlurOn();
      } },
    { "depth peeling",
      [](Stage& stage)
      {
        stage.renderer->UseDepthPeelingOn();
        stage.renderer->SetMaximumNumberOfPeels(8);
        stage.window->SetAlphaBitPlanes(1);
      } },
    { "FXAA", [](Stage& stage) { stage.renderer->UseFXAAOn(); } },
  };
  for (const Effect& effect : effects)
  {
    Stage stage;
    stage.addGround();
    stage.add(ball(0.7, -0.6, 0.3, 0.8), 0.9, 0.5, 0.3);
    stage.add(box(0.8, 0.5, 0.6, 0.4), 0.4, 0.7, 0.9);
    for (int i = 0; i < 2; ++i)
    {
      vtkActor* glass = stage.add(ball(0.5, 0.3 * i, -1.0 + 0.4 * i, 0.8), 0.2, 0.8, 0.3 + 0.5 * i);
      glass->GetProperty()->SetOpacity(0.5);
    }
    stage.addSun(2.0, -1.5, 4.0);
    effect.on(stage);

    const Picture traced = stage.unshadowed();
    const Picture shadowed = stage.shadowed();
    stage.usePass(false);
    const Picture raster = capture(stage.window);
    if (effect.name == std::string("FXAA"))
    {
      stage.renderer->UseFXAAOff();
      const double smoothed = difference(raster, capture(stage.window)).mean;
      stage.usePass(true);
      const double tracedSmoothed = difference(traced, stage.unshadowed()).mean;
      stage.renderer->UseFXAAOn();
      std::cout << "FXAA changes " << smoothed << ", traced " << tracedSmoothed << '\n';
      checks.expect(std::abs(smoothed - tracedSmoothed) < 0.05 * smoothed,
        "the renderer's FXAA acts as without the pass");
    }
    const Difference look = difference(raster, traced, awayFromEdges(raster, 3));
    std::cout << effect.name << ": mean " << look.mean << ", p99 " << look.p99 << " of "
              << look.pixels << " pixels\n";
    checks.expect(look.mean <= 2.0 && look.p99 <= 8,
      std::string(effect.name) + ": without shadows it is VTK's own picture");
    checks.expect(
      difference(traced, shadowed).mean > 1.0, std::string(effect.name) + ": shadows are there");
  }
  return checks.exitCode();
}
