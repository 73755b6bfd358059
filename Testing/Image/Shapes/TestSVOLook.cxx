// Without shadows a traced surface looks as VTK's rasteriser draws it: interpolation, highlights,
// ambient light, unlit surfaces, and the depth it leaves behind. A headlight's highlight is another
// one beside other lights, also of such that are off.
#include "svoTestStage.h"

#include "vtkProperty.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

void expectHeadlight(Checks& checks)
{
  struct Other
  {
    const char* name;
    bool first, positional;
  };
  for (const Other& other : { Other{ "no other light", false, false },
         Other{ "a light that is off before it", true, false },
         Other{ "a light that is off behind it", false, false },
         Other{ "a lamp that is off before it", true, true },
         Other{ "a lamp that is off behind it", false, true } })
  {
    Stage stage;
    vtkProperty* shining = stage.add(ball(1.0, 0.8, 0.0, 0.5), 0.9, 0.5, 0.3)->GetProperty();
    shining->SetSpecular(0.9);
    shining->SetSpecularPower(20.0);
    const auto addHeadlight = [&]
    {
      vtkNew<vtkLight> light;
      light->SetLightTypeToHeadlight();
      stage.renderer->AddLight(light);
    };
    if (!other.first)
    {
      addHeadlight();
    }
    if (other.name != std::string("no other light"))
    {
      vtkLight* off = other.positional ? stage.addBulb(3.0, 3.0, 3.0) : stage.addSun(1.0, 2.0, 3.0);
      off->SwitchOff();
    }
    if (other.first)
    {
      addHeadlight();
    }
    const Picture traced = stage.unshadowed();
    stage.usePass(false);
    const Picture raster = capture(stage.window);
    const Difference d = difference(raster, traced, awayFromEdges(raster, 2));
    std::cout << "a headlight and " << other.name << ": mean " << d.mean << ", p99 " << d.p99
              << ", largest " << d.largest << '\n';
    checks.expect(d.mean <= 0.5 && d.largest <= 3, std::string("a headlight and ") + other.name);
  }
}
}

int TestSVOLook(int, char*[])
{
  Checks checks;
  expectHeadlight(checks);
  struct Look
  {
    const char* name;
    std::function<void(vtkProperty*)> set;
  };
  const Look looks[] = {
    { "flat", [](vtkProperty* p) { p->SetInterpolationToFlat(); } },
    { "Gouraud", [](vtkProperty* p) { p->SetInterpolationToGouraud(); } },
    { "Phong with a highlight",
      [](vtkProperty* p)
      {
        p->SetInterpolationToPhong();
        p->SetSpecular(0.6);
        p->SetSpecularPower(20.0);
        p->SetSpecularColor(1.0, 0.9, 0.7);
      } },
    { "ambient",
      [](vtkProperty* p)
      {
        p->SetAmbient(0.4);
        p->SetDiffuse(0.5);
        p->SetAmbientColor(0.2, 0.9, 0.6);
      } },
    { "unlit", [](vtkProperty* p) { p->LightingOff(); } },
  };
  Stage stage;
  vtkActor* actors[] = { stage.addGround(), stage.add(ball(0.6, -1.1, -0.5, 0.7), 0.9, 0.5, 0.3),
    stage.add(ring(0.8, 0.8, 0.9, 1.1), 0.3, 0.6, 0.9),
    stage.add(box(0.7, 0.9, -1.0, 0.35), 0.5, 0.8, 0.4),
    stage.add(spike(1.0, -0.6, 1.2, 0.5), 0.8, 0.8, 0.3) };
  stage.addSun(2.0, -1.5, 4.0)->SetIntensity(0.8);
  vtkLight* bulb = stage.addBulb(-1.0, -2.0, 2.0);
  bulb->SetColor(0.5, 0.4, 0.3);
  bulb->SetAttenuationValues(1.0, 0.05, 0.02);

  for (const Look& look : looks)
  {
    for (vtkActor* actor : actors)
    {
      vtkNew<vtkProperty> property;
      double color[3];
      actor->GetProperty()->GetDiffuseColor(color);
      property->SetColor(color);
      look.set(property);
      actor->SetProperty(property);
    }
    stage.usePass(true);
    const Picture traced = stage.unshadowed();
    stage.expectTraced(checks, 5, "all five actors are traced");
    stage.usePass(false);
    const Picture raster = capture(stage.window);
    const Mask inner = awayFromEdges(raster, 2);
    const Difference d = difference(raster, traced, inner);
    std::cout << look.name << ": mean " << d.mean << ", p99 " << d.p99 << ", largest " << d.largest
              << " of " << d.pixels << " pixels\n";
    checks.expect(d.pixels > 20000, "enough pixels away from edges");
    checks.expect(
      d.mean <= 2.0 && d.p99 <= 8, std::string(look.name) + ": mean 2 and p99 8 grey levels");

    std::size_t deep = 0;
    std::size_t apart = 0;
    for (std::size_t i = 0; i < inner.size(); ++i)
    {
      if (inner[i])
      {
        ++deep;
        apart += std::abs(raster.depth[i] - traced.depth[i]) > 1e-5f;
      }
    }
    checks.expect(apart <= deep / 1000, std::string(look.name) + ": depth as the rasteriser's");
  }
  return checks.exitCode();
}
