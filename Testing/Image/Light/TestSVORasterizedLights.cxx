// Every kind of light casts on a rasterised floor what it casts on a traced one, a point light in
// the midst of its casters with its six maps included.
#include "svoTestStage.h"

#include "vtkMath.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <string>

namespace
{
/// So many suns close together, as bright as one.
void addCluster(svotest::Stage& stage, int count)
{
  stage.pass->SetShadowBufferResolution(256);
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2.0 * vtkMath::Pi() * i / count;
    stage.addSun(2.0 + 0.2 * std::cos(angle), -1.5 + 0.2 * std::sin(angle), 4.0)
      ->SetIntensity(1.0 / count);
  }
}
}

int TestSVORasterizedLights(int, char*[])
{
  using namespace svotest;
  Checks checks;
  struct Case
  {
    std::string name;
    std::function<void(Stage&)> light;
  };
  const Case cases[] = {
    { "sun", [](Stage& stage) { stage.addSun(2.0, -1.5, 4.0); } },
    { "bulb above", [](Stage& stage) { stage.addBulb(1.0, -1.5, 4.0); } },
    { "bulb in the midst", [](Stage& stage) { stage.addBulb(0.0, 0.0, 1.2); } },
    { "spot",
      [](Stage& stage)
      {
        vtkLight* light = stage.addBulb(1.5, -2.0, 4.0);
        light->SetConeAngle(25.0);
      } },
    { "two suns and a headlight",
      [](Stage& stage)
      {
        vtkNew<vtkLight> headlight;
        headlight->SetLightTypeToHeadlight();
        headlight->SetIntensity(0.2);
        stage.renderer->AddLight(headlight);
        stage.addSun(2.0, -1.5, 4.0)->SetIntensity(0.5);
        stage.addSun(-2.0, -0.5, 3.0)->SetIntensity(0.3);
      } },
    // As many maps as OpenGL has texture units, and more.
    { "32 suns", [](Stage& stage) { addCluster(stage, 32); } },
    { "40 suns", [](Stage& stage) { addCluster(stage, 40); } },
  };
  for (const Case& c : cases)
  {
    Stage stage;
    stage.pass->SetShadowBufferResolution(1024);
    vtkActor* ground = stage.addGround();
    stage.add(ball(0.4, -1.1, -0.5, 0.6), 0.9, 0.5, 0.3);
    stage.add(box(0.5, 1.0, -0.8, 0.6), 0.5, 0.8, 0.4);
    stage.add(spike(0.9, 0.2, 1.2, 0.5), 0.8, 0.8, 0.3);
    c.light(stage);
    const Picture traced = stage.shadowed();
    stage.expectRasterized(checks, 0, c.name + ": all are traced");
    vtkSVORenderPass::SetUseSVO(false, ground);
    const Picture unshadowed = stage.unshadowed();
    const Picture mixed = stage.shadowed();
    stage.expectRasterized(checks, 1, c.name + ": a rasterised floor");

    std::size_t dark = 0;
    std::size_t apart = 0;
    for (std::size_t i = 0; i < mixed.size(); ++i)
    {
      dark += unshadowed.grey(i) - traced.grey(i) > 8.0;
      apart += std::abs(mixed.grey(i) - traced.grey(i)) > 8.0;
    }
    std::cout << c.name << ": " << dark << " shadowed pixels, " << apart << " differ\n";
    checks.expect(dark > 1000, c.name + ": there are shadows");
    // What is left are pixels that an edge of a shadow crosses.
    checks.expect(apart < dark / 20, c.name + ": the same shadows on either floor");
  }
  return checks.exitCode();
}
