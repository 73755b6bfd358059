// Surfaces that stay with the rasteriser receive the shadows of traced ones: textured, physically
// based, and with visible edges.
#include "svoShadowOracle.h"
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkProperty.h"
#include "vtkTexture.h"

#include <array>
#include <memory>

namespace
{
vtkSmartPointer<vtkTexture> checkerboard()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(64, 64, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < 64; ++y)
  {
    for (int x = 0; x < 64; ++x)
    {
      auto* rgb = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      const bool light = (x / 16 + y / 16) % 2 == 0;
      rgb[0] = light ? 240 : 110;
      rgb[1] = light ? 220 : 130;
      rgb[2] = light ? 190 : 160;
    }
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  return texture;
}

/// For surfaces that no light changes no shadow map is traced whole, copied and sent. Applications
/// keep such in their views: ParaView an outline and a selection for all that it shows.
void testUnlit(svotest::Checks& checks)
{
  svotest::Stage stage(200, 200);
  stage.addGround();
  stage.add(svotest::ball(0.7, 0.2, 0.0, 1.0), 0.9, 0.5, 0.3);
  stage.addSun(2.0, -1.5, 4.0);
  stage.pass->SetFrameCoherence(false);
  const auto rays = [&]
  {
    svotest::capture(stage.window);
    return stage.pass->GetNumberOfShadowRays();
  };
  const vtkIdType alone = rays();
  vtkActor* frame = stage.add(svotest::box(0.5, -0.8, 0.0, 0.5), 1.0, 1.0, 0.0);
  vtkSVORenderPass::SetCastShadow(false, frame);
  vtkProperty* property = frame->GetProperty();
  property->SetRepresentationToWireframe();
  property->SetAmbient(1.0);
  property->SetDiffuse(0.0);
  checks.expect(rays() == alone, "what only shines by itself receives nothing");
  stage.expectRasterized(checks, 1, "the rasteriser draws it");
  property->SetSpecular(0.5);
  checks.expect(rays() > alone, "gloss receives");
  property->SetSpecular(0.0);
  property->SetDiffuse(0.5);
  checks.expect(rays() > alone, "diffuse light receives");
  property->LightingOff();
  checks.expect(rays() == alone, "without lighting there is nothing to receive");
  property->LightingOn();
  property->SetDiffuse(0.0);
  property->SetInterpolationToPBR();
  checks.expect(rays() > alone, "physically based surfaces have no such coefficients");
  property->SetInterpolationToGouraud();
  vtkNew<vtkProperty> back;
  back->SetDiffuse(0.5);
  frame->SetBackfaceProperty(back);
  checks.expect(rays() > alone, "back faces receive");
}
}

int TestSVORasterizedReceivers(int argc, char* argv[])
{
  using namespace svotest;
  Checks checks;
  if (!drawnByOpenGL()) // where the ground is rasterised, too, and receives
  {
    testUnlit(checks);
  }
  std::array<std::unique_ptr<Stage>, 3> stages;
  std::array<ShadowOracle, 3> oracles;
  const char* const names[3] = { "textured floor", "physically based floor", "floor with edges" };
  for (int i = 0; i < 3; ++i)
  {
    stages[i] = i == 0 ? std::make_unique<Stage>(600, 200)
                       : std::make_unique<Stage>(*stages[0], i / 3.0, 0.0, (i + 1) / 3.0, 1.0);
    Stage& stage = *stages[i];
    vtkActor* ground = stage.addGround();
    oracles[i].add(ground);
    oracles[i].add(stage.add(ball(0.7, 0.2, 0.0, 1.0), 0.9, 0.5, 0.3));
    oracles[i].add(stage.addSun(2.0, -1.5, 4.0));
    switch (i)
    {
      case 0:
        stage.renderer->SetViewport(0.0, 0.0, 1.0 / 3.0, 1.0);
        ground->SetTexture(checkerboard());
        break;
      case 1:
        ground->GetProperty()->SetInterpolationToPBR();
        ground->GetProperty()->SetRoughness(0.6);
        ground->GetProperty()->SetMetallic(0.1);
        break;
      default:
        ground->GetProperty()->EdgeVisibilityOn();
    }
  }
  for (auto& stage : stages)
  {
    stage->pass->SetShadowTechniqueToNone();
  }
  const Picture unshadowed = capture(stages[0]->window);
  for (auto& stage : stages)
  {
    stage->pass->SetShadowTechniqueToShadowBuffer();
  }
  const Picture shadowed = capture(stages[0]->window);
  for (auto& stage : stages)
  {
    stage->pass->SetShadowTechniqueToShadowRays();
  }
  const Picture byRays = capture(stages[0]->window);
  for (int i = 0; i < 3; ++i)
  {
    stages[i]->expectRasterized(checks, 1, std::string(names[i]) + " is left to the rasteriser");
    // The lines of edges have their own colour: they are 1 % of that floor.
    expectShadows(checks, oracles[i].judge(stages[i]->renderer, shadowed, unshadowed), names[i],
      i == 2 ? 0.01 : 0.002);
    // Rays are for what is traced: the floors keep their shadow buffers.
    expectShadows(checks, oracles[i].judge(stages[i]->renderer, byRays, unshadowed),
      (std::string(names[i]) + ", by rays").c_str(), i == 2 ? 0.01 : 0.002);
  }
  for (auto& stage : stages)
  {
    stage->pass->SetShadowTechniqueToShadowBuffer();
  }
  checks.expect(matchesBaseline(stages[0]->window, argc, argv), "the baseline");
  return checks.exitCode();
}
