// Every kind of light casts, and so do two at once: six small stages side by side.
#include "svoShadowOracle.h"
#include "svoTestStage.h"

#include "vtkLightCollection.h"

#include <array>
#include <memory>

namespace
{
const char* const Names[6] = { "directional", "point", "spot", "headlight", "camera light",
  "two lights" };

void addLights(svotest::Stage& stage, int kind)
{
  switch (kind)
  {
    case 0:
      stage.addSun(2.0, -1.5, 4.0);
      break;
    case 1:
      stage.addBulb(0.9, -0.8, 2.8);
      break;
    case 2:
    {
      vtkLight* spot = stage.addBulb(2.0, -1.5, 4.0);
      spot->SetConeAngle(22.0);
      spot->SetExponent(1.0);
      break;
    }
    case 3:
      stage.addSun(0.0, 0.0, 1.0)->SetLightTypeToHeadlight();
      break;
    case 4:
    {
      // In the camera's coordinates: x to the right, y up, z towards the viewer.
      vtkLight* lamp = stage.addSun(1.0, 1.0, 1.0);
      lamp->SetLightTypeToCameraLight();
      break;
    }
    default:
      stage.addSun(2.0, -1.5, 4.0)->SetIntensity(0.5);
      stage.addBulb(-2.0, -1.0, 3.0)->SetIntensity(0.5);
  }
}
}

int TestSVOLights(int argc, char* argv[])
{
  using namespace svotest;
  Checks checks;
  std::array<std::unique_ptr<Stage>, 6> stages;
  std::array<ShadowOracle, 6> oracles;
  for (int i = 0; i < 6; ++i)
  {
    const double x = (i % 3) / 3.0;
    const double y = (i / 3) / 2.0;
    stages[i] = i == 0 ? std::make_unique<Stage>(600, 400)
                       : std::make_unique<Stage>(*stages[0], x, y, x + 1.0 / 3.0, y + 0.5);
    Stage& stage = *stages[i];
    stage.pass->SetPixelError(0.0); // lights are judged here, not levels of detail
    if (i == 0)
    {
      stage.renderer->SetViewport(0.0, 0.0, 1.0 / 3.0, 0.5);
    }
    oracles[i].add(stage.addGround());
    oracles[i].add(stage.add(ball(0.5, -0.2, 0.1, 1.3), 0.9, 0.5, 0.3));
    oracles[i].add(stage.add(box(0.7, 0.9, 0.5, 0.35), 0.4, 0.7, 0.9));
    addLights(stage, i);
    vtkLightCollection* lights = stage.renderer->GetLights();
    lights->InitTraversal();
    while (vtkLight* light = lights->GetNextItem())
    {
      vtkSVORenderPass::SetCastShadow(true, light);
    }
  }

  auto technique = [&](void (vtkSVORenderPass::*set)())
  {
    for (auto& stage : stages)
    {
      (stage->pass.Get()->*set)();
    }
    return capture(stages[0]->window);
  };
  const Picture unshadowed = technique(&vtkSVORenderPass::SetShadowTechniqueToNone);
  const Picture byRays = technique(&vtkSVORenderPass::SetShadowTechniqueToShadowRays);
  const Picture shadowed = technique(&vtkSVORenderPass::SetShadowTechniqueToShadowBuffer);
  for (int i = 0; i < 6; ++i)
  {
    Stage& stage = *stages[i];
    vtkLightCollection* lights = stage.renderer->GetLights();
    lights->InitTraversal();
    while (vtkLight* light = lights->GetNextItem())
    {
      oracles[i].add(light);
    }
    if (i == 3)
    {
      // It shines along the view axis: its shadows hide behind their casters, but for slivers.
      const double wrong = oracles[i].judge(stage.renderer, shadowed, unshadowed).wrongShare();
      checks.expect(wrong <= 0.002, "a headlight casts along the view axis");
      continue;
    }
    expectShadows(checks, oracles[i].judge(stage.renderer, shadowed, unshadowed), Names[i]);
    expectShadows(checks, oracles[i].judge(stage.renderer, byRays, unshadowed), Names[i]);
  }
  checks.expect(matchesBaseline(stages[0]->window, argc, argv), "the baseline");
  return checks.exitCode();
}
