// ShadowIntensity is the share of a light that a shadow takes: all of it, half of it, nothing.
#include "svoTestStage.h"

#include "vtkProperty.h"

#include <cmath>
#include <iostream>

int TestSVOShadowIntensity(int, char*[])
{
  using namespace svotest;
  Checks checks;
  Stage stage;
  vtkActor* ground = stage.addGround();
  // The second row: the rasteriser draws the ground.
  for (const bool traced : { true, false })
  {
    vtkSVORenderPass::SetUseSVO(traced, ground);
    if (traced)
    {
      stage.add(ball(0.7, 0.2, 0.0, 1.0), 0.9, 0.5, 0.3);
      stage.addSun(2.0, -1.5, 4.0);
    }
    const std::string who = traced ? "traced ground: " : "rasterised ground: ";
    stage.pass->SetShadowIntensity(1.0);
    const Picture unshadowed = stage.unshadowed();
    const Picture full = stage.shadowed();
    stage.pass->SetShadowIntensity(0.5);
    const Picture half = stage.shadowed();
    stage.pass->SetShadowIntensity(0.0);
    const Picture none = stage.shadowed();
    // The sun passes the ball's centre and meets the ground at (-0.3, 0.375).
    stage.renderer->SetWorldPoint(-0.3, 0.375, 0.0, 1.0);
    stage.renderer->WorldToDisplay();
    const int x = static_cast<int>(stage.renderer->GetDisplayPoint()[0]);
    const int y = static_cast<int>(stage.renderer->GetDisplayPoint()[1]);
    std::cout << who << unshadowed.grey(x, y) << " " << none.grey(x, y) << " " << half.grey(x, y)
              << " " << full.grey(x, y) << "\n";
    checks.expect(unshadowed.grey(x, y) > 100.0, who + "bright without a shadow");
    checks.expect(full.grey(x, y) < 2.0, who + "black with one light and no ambient light");
    checks.expect(std::abs(half.grey(x, y) - 0.5 * unshadowed.grey(x, y)) < 2.0, who + "half");
    checks.expect(difference(none, unshadowed).largest <= 1, who + "nothing at 0");

    ground->GetProperty()->SetAmbient(0.2);
    stage.pass->SetShadowIntensity(1.0);
    const Picture ambient = stage.shadowed();
    ground->GetProperty()->SetAmbient(0.0);
    checks.expect(std::abs(ambient.grey(x, y) - 0.2 * 255.0 * (0.8 + 0.8 + 0.75) / 3.0) < 2.0,
      who + "ambient light stays");
  }
  return checks.exitCode();
}
