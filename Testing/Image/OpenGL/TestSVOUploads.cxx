// Rows of pixels that are no multiple of four bytes: VTK's own uploads beside and after a traced
// surface show the same as without the pass.
#include "svoTestStage.h"

#include "vtkActor2D.h"
#include "vtkImageData.h"
#include "vtkImageMapper.h"
#include "vtkPlaneSource.h"
#include "vtkTexture.h"

#include <algorithm>
#include <iostream>
#include <string>

using namespace svotest;

namespace
{
/// Noise in colours; a sheared row is seen anywhere.
vtkSmartPointer<vtkImageData> noise(int width, int height)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
  unsigned state = 7;
  for (int i = 0; i < 3 * width * height; ++i)
  {
    state = state * 1664525u + 1013904223u;
    bytes[i] = static_cast<unsigned char>(state >> 24);
  }
  return image;
}

/// A ball, a plane with a texture `width` pixels wide, and an image in the corner.
void furnish(Stage& stage, int width)
{
  stage.add(ball(0.4, -0.9, 0.0, 1.4), 0.9, 0.4, 0.3);
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1.0, -1.0, 0.0);
  plane->SetPoint1(2.0, -1.0, 0.0);
  plane->SetPoint2(-1.0, 2.0, 0.0);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(noise(width, 45));
  texture->SetColorModeToDirectScalars();
  stage.add(plane, 1.0, 1.0, 1.0)->SetTexture(texture);
  vtkNew<vtkImageMapper> mapper;
  mapper->SetInputData(noise(width, 30));
  mapper->SetColorWindow(255.0);
  mapper->SetColorLevel(127.5);
  vtkNew<vtkActor2D> corner;
  corner->SetMapper(mapper);
  stage.renderer->AddViewProp(corner);
}

std::size_t different(const Picture& a, const Picture& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3)
  {
    int most = 0;
    for (std::size_t c = i; c < i + 3; ++c)
    {
      most = std::max(most, std::abs(int(a.rgb[c]) - int(b.rgb[c])));
    }
    count += most > 10;
  }
  return count;
}
}

int TestSVOUploads(int, char*[])
{
  Checks checks;
  for (const int width : { 60, 61, 62, 63 })
  {
    const std::string name = "rows of " + std::to_string(3 * width) + " bytes";
    Stage plain(300, 240);
    plain.addSun(3.0, 0.5, 4.0);
    furnish(plain, width);
    plain.usePass(false);
    const Picture expected = capture(plain.window);
    Stage stage(300, 240);
    stage.addSun(3.0, 0.5, 4.0);
    furnish(stage, width);
    stage.pass->SetShadowTechnique(vtkSVORenderPass::SHADOW_NONE);
    const std::size_t beside = different(expected, capture(stage.window));
    stage.expectTraced(checks, 1, name + ": the ball is traced");
    // Those that come when the pass has gone.
    stage.usePass(false);
    Stage late(stage, 0.0, 0.0, 1.0, 1.0);
    stage.window->RemoveRenderer(stage.renderer);
    late.addSun(3.0, 0.5, 4.0);
    furnish(late, width);
    late.usePass(false);
    const std::size_t after = different(expected, capture(stage.window));
    std::cout << name << ": " << beside << " pixels differ beside the pass, " << after
              << " after it\n";
    // The ball's outline may differ by a pixel here and there.
    checks.expect(beside < 10, name + ": as without the pass");
    checks.expect(after == 0, name + ": as if there had been no pass");
  }
  return checks.exitCode();
}
