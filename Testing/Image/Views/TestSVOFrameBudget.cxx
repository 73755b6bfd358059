// The time for a frame, on a machine whose clock counts rays: quality follows what frames cost and
// what fewer rays can save, steadily; renderers of a window share the time; the pass says what
// error it accepted; a still frame does not know the clock.
#include "svoTestStage.h"

#include "vtkLight.h"
#include "vtkObjectFactory.h"

#include <cmath>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

constexpr double Still = 0.0001;   // Hz
constexpr double Interactive = 10; // Hz: 0.1 s a frame, half of it for what is traced
constexpr double Budget = 0.05;    // s

/// Tells the time that a frame would take if `rays` seconds went by with a ray for each pixel, and
/// `fixed` whatever the number of rays.
class ScriptedPass : public vtkSVORenderPass
{
public:
  static ScriptedPass* New();
  vtkTypeMacro(ScriptedPass, vtkSVORenderPass);

  double rays = 0.0;
  double fixed = 0.0;
  double shadows = 0.0;

  double seconds() const
  {
    return this->fixed + this->shadows + this->rays / std::pow(this->GetImageSampleDistance(), 2);
  }

protected:
  void MeasureFrame(double& seconds, double& fixedSeconds, double& shadowSeconds) const override
  {
    shadowSeconds = this->shadows;
    seconds = this->seconds();
    fixedSeconds = this->fixed;
  }
};
vtkStandardNewMacro(ScriptedPass);

void prepare(Stage& stage, ScriptedPass* pass)
{
  pass->SetFrameCoherence(false); // every frame is traced, and measured
  pass->SetBuildInBackground(false);
  stage.renderer->SetPass(pass);
  stage.addSun(2.0, -1.5, 4.0);
  stage.add(ring(0.9, 0.0, 0.0, 1.0), 0.9, 0.5, 0.3);
  stage.addGround();
}

void testOneRenderer(Checks& checks)
{
  Stage stage(160, 120);
  vtkNew<ScriptedPass> pass;
  prepare(stage, pass);
  const auto frame = [&](double rate, double rays, double fixed = 0.0)
  {
    pass->rays = rays;
    pass->fixed = fixed;
    stage.window->SetDesiredUpdateRate(rate);
    return capture(stage.window);
  };
  const auto distance = [&] { return pass->GetImageSampleDistance(); };

  const Picture still = frame(Still, 1000.0);
  checks.expect(distance() == 1.0, "a still frame has a ray for each pixel, whatever that takes");
  checks.expect(pass->GetAcceptedPixelError() == 1.0, "a still frame accepts what was asked for");
  frame(Still, 0.5 * Budget);
  const Picture quick = frame(Interactive, 0.5 * Budget);
  checks.expect(
    quick.rgb == still.rgb && quick.depth == still.depth, "with time enough nothing is lowered");

  // Nine times too slow: that takes a ninth of the rays.
  frame(Interactive, 9.0 * Budget);
  const Picture coarse = frame(Interactive, 9.0 * Budget);
  checks.expect(distance() == 3.0, "quality follows what frames cost");
  checks.expect(pass->seconds() <= Budget * 1.0001, "the frame keeps to its time");
  checks.expect(pass->GetAcceptedPixelError() == 3.0, "it says which error it accepted");
  checks.expect(coarse.rgb != still.rgb, "it is a coarser picture");
  pass->SetPixelError(2.0);
  checks.expect(pass->GetAcceptedPixelError() == 6.0, "of rays three pixels apart");
  pass->SetPixelError(1.0);

  // Somewhat quicker and slower, in turn.
  for (const double change : { 0.9, 1.0, 0.7, 0.95, 0.6 })
  {
    frame(Interactive, 9.0 * change * Budget);
    checks.expect(distance() == 3.0, "quality does not go back and forth");
  }
  frame(Interactive, 4.0 * Budget);
  frame(Interactive, 4.0 * Budget);
  checks.expect(distance() == 2.0, "with time to spare quality rises");
  frame(Interactive, 1000.0);
  frame(Interactive, 1000.0);
  checks.expect(distance() == pass->GetMaximumImageSampleDistance(), "there is a limit");
  const double rays = static_cast<double>(pass->GetNumberOfPrimaryRays());
  pass->SetImageReductionFactor(2);
  frame(Interactive, 1000.0);
  std::cout << rays << " rays at the limit, " << pass->GetNumberOfPrimaryRays()
            << " where pixels of the frame become larger\n";
  checks.expect(distance() == pass->GetMaximumImageSampleDistance() &&
      pass->GetNumberOfPrimaryRays() > 2.0 * rays,
    "a limit in the window, where pixels of the frame become larger");
  pass->SetImageReductionFactor(1);

  // What fewer rays would not save.
  frame(Interactive, 0.25 * Budget, 100.0 * Budget);
  frame(Interactive, 0.25 * Budget, 100.0 * Budget);
  checks.expect(distance() == 1.0, "quality is not lowered where that saves nothing");

  frame(Interactive, 1000.0);
  const Picture after = frame(Still, 1000.0);
  checks.expect(
    after.rgb == still.rgb && after.depth == still.depth, "a still frame has no history");
  checks.expect(pass->GetAcceptedPixelError() == 1.0, "and says so");
}

/// Shadow maps of lights that move with the camera are the first to become coarser.
void testShadowMaps(Checks& checks)
{
  Stage stage(160, 120);
  vtkNew<ScriptedPass> pass;
  prepare(stage, pass);
  vtkNew<vtkLight> light;
  pass->SetShadowBufferResolution(128); // else coarse texels are no larger than pixels
  light->SetLightTypeToCameraLight();
  light->SetPosition(1.0, 1.0, 1.0);
  stage.renderer->AddLight(light);
  const auto frame = [&](double rate, double rays, double shadows)
  {
    pass->rays = rays;
    pass->shadows = shadows;
    stage.window->SetDesiredUpdateRate(rate);
    return capture(stage.window);
  };
  const Picture still = frame(Still, 0.1 * Budget, 30.0 * Budget);
  checks.expect(pass->GetAcceptedPixelError() == 1.0, "still maps have all their texels");
  const Picture coarse = frame(Interactive, 0.1 * Budget, 30.0 / 36.0 * Budget);
  std::cout << "accepted: " << pass->GetAcceptedPixelError() << " pixels, of maps\n";
  checks.expect(pass->GetImageSampleDistance() == 1.0, "rays stay where they are");
  checks.expect(pass->GetAcceptedPixelError() > 1.0, "but it says how wide texels look");
  checks.expect(coarse.rgb != still.rgb && coarse.depth == still.depth, "shadows are coarser");
  frame(Interactive, 4.0 * Budget, 0.9 * Budget);
  frame(Interactive, 4.0 * Budget, 0.5 * Budget);
  checks.expect(pass->GetImageSampleDistance() > 1.0, "rays are the last");
  const Picture after = frame(Still, 4.0 * Budget, 30.0 * Budget);
  checks.expect(after.rgb == still.rgb, "a still frame has all texels again");
}

/// `shared`: one pass for both renderers.
void testTwoRenderers(Checks& checks, bool shared)
{
  const std::string name = shared ? "one pass: " : "two passes: ";
  Stage left(240, 120);
  left.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  Stage right(left, 0.5, 0.0, 1.0, 1.0);
  vtkNew<ScriptedPass> first, second;
  ScriptedPass* other = shared ? first.Get() : second.Get();
  prepare(left, first);
  prepare(right, other);
  first->rays = other->rays = 2.0 * Budget;
  left.window->SetDesiredUpdateRate(Interactive);
  for (int frame = 0; frame < 4; ++frame)
  {
    capture(left.window);
  }
  const double together = first->seconds() + other->seconds();
  std::cout << name << first->GetImageSampleDistance() << " and " << other->GetImageSampleDistance()
            << " pixels apart, " << together << " s\n";
  checks.expect(first->GetImageSampleDistance() == 2.0, name + "they share the time");
  checks.expect(
    other->GetImageSampleDistance() == first->GetImageSampleDistance(), name + "evenly");
  checks.expect(together <= Budget * 1.0001, name + "both together keep to it");

  right.renderer->DrawOff();
  for (int frame = 0; frame < 4; ++frame)
  {
    capture(left.window);
  }
  checks.expect(
    first->GetImageSampleDistance() == 1.5, name + "one that is not drawn takes no time");
  right.renderer->DrawOn();
  for (int frame = 0; frame < 4; ++frame)
  {
    capture(left.window);
  }
  checks.expect(first->GetImageSampleDistance() == 2.0, name + "drawn again, it does");
  right.renderer->SetPass(nullptr);
  for (int frame = 0; frame < 4; ++frame)
  {
    capture(left.window);
  }
  checks.expect(first->GetImageSampleDistance() == 1.5, name + "without its pass it does not");
}

/// A dear picture beside a cheap one.
void testUnequalRenderers(Checks& checks)
{
  Stage left(240, 120);
  left.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  Stage right(left, 0.5, 0.0, 1.0, 1.0);
  vtkNew<ScriptedPass> dear, cheap;
  prepare(left, dear);
  prepare(right, cheap);
  dear->rays = 3.9 * Budget;
  cheap->rays = 0.1 * Budget;
  left.window->SetDesiredUpdateRate(Interactive);
  for (int frame = 0; frame < 4; ++frame)
  {
    capture(left.window);
  }
  checks.expect(dear->GetImageSampleDistance() == 2.0, "a dear picture has most of the time");
  checks.expect(cheap->GetImageSampleDistance() == 2.0, "rays are equally far apart");
}
}

int TestSVOFrameBudget(int, char*[])
{
  Checks checks;
  testOneRenderer(checks);
  testShadowMaps(checks);
  testTwoRenderers(checks, false);
  testTwoRenderers(checks, true);
  testUnequalRenderers(checks);
  return checks.exitCode();
}
