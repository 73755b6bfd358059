// A convex body of few facets with smooth normals casts no shadow on itself, however it is drawn:
// ParaView's first pictures, a sphere of 8 x 8 facets and a tube of 6 sides.
#include "svoTestStage.h"

#include "vtkLineSource.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTubeFilter.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iostream>

namespace
{
using namespace svotest;

vtkSmartPointer<vtkAlgorithm> coarseSphere()
{
  auto source = vtkSmartPointer<vtkSphereSource>::New();
  source->SetRadius(1.0);
  source->SetCenter(0.0, 0.0, 0.6);
  return source;
}

vtkSmartPointer<vtkAlgorithm> coarseTube()
{
  vtkNew<vtkLineSource> line;
  line->SetPoint1(-1.2, 0.2, 0.2);
  line->SetPoint2(1.2, -0.2, 1.0);
  auto tube = vtkSmartPointer<vtkTubeFilter>::New();
  tube->SetInputConnection(line->GetOutputPort());
  tube->SetNumberOfSides(6);
  tube->CappingOn();
  tube->SetRadius(0.5);
  return tube;
}

/// Pixels that a shadow changes, by more than the last digit.
std::size_t changed(const Picture& a, const Picture& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3)
  {
    int most = 0;
    for (std::size_t c = i; c < i + 3; ++c)
    {
      most = std::max(most, std::abs(a.rgb[c] - b.rgb[c]));
    }
    count += most > 1;
  }
  return count;
}

struct Variant
{
  const char* name;
  std::function<void(Stage&, vtkActor*)> prepare;
  bool traced;
};

const Variant Ways[] = {
  { "traced", [](Stage&, vtkActor*) {}, true },
  { "traced, few texels",
    [](Stage& stage, vtkActor*) { stage.pass->SetShadowBufferResolution(256); }, true },
  { "traced, anti-aliased", [](Stage& stage, vtkActor*) { stage.pass->SetAntiAliasing(true); },
    true },
  { "rasterised", [](Stage&, vtkActor* body) { vtkSVORenderPass::SetUseSVO(false, body); }, false },
  { "rasterised, filtered",
    [](Stage& stage, vtkActor* body)
    {
      vtkSVORenderPass::SetUseSVO(false, body);
      stage.pass->SetAntiAliasing(true);
    },
    false },
  { "on OpenGL", [](Stage& stage, vtkActor*) { stage.pass->SetBackendToOpenGL(); }, false },
  { "rasterised, with edges",
    [](Stage&, vtkActor* body)
    {
      body->GetProperty()->EdgeVisibilityOn();
      body->GetProperty()->SetEdgeColor(0.1, 0.1, 0.1);
    },
    false },
};
}

int TestSVOTerminator(int, char*[])
{
  Checks checks;
  for (const bool sphere : { true, false })
  {
    for (const bool bulb : { false, true })
    {
      for (const Variant& way : Ways)
      {
        Stage stage(400, 400);
        vtkActor* body = stage.add(sphere ? coarseSphere() : coarseTube(), 0.9, 0.8, 0.7);
        way.prepare(stage, body);
        if (bulb)
        {
          stage.addBulb(3.0, 0.5, 1.5);
        }
        else
        {
          stage.addSun(3.0, 0.5, 1.5);
        }
        const std::string name =
          std::string(sphere ? "sphere" : "tube") + (bulb ? ", bulb, " : ", sun, ") + way.name;
        const Picture light = stage.unshadowed();
        const std::size_t byMap = changed(light, stage.shadowedByBuffers());
        stage.expectTraced(checks, way.traced ? 1 : 0, name + ": drawn so");
        checks.expect(
          std::string(stage.pass->GetCastingLights()).find("casts shadows") != std::string::npos,
          name + ": the light casts");
        const std::size_t byRays = changed(light, stage.shadowedByRays());
        std::cout << name << ": " << byMap << " pixels changed by a map, " << byRays
                  << " by rays\n";
        checks.expect(byMap == 0, name + ": no shadow of its own by a map");
        checks.expect(byRays == 0, name + ": no shadow of its own by rays");
      }
    }
  }
  return checks.exitCode();
}
