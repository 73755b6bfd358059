// A still picture that waits for octrees can be aborted: what has none yet is left to the
// rasteriser in that frame. And octrees can be freed.
#include "svoTestStage.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"

#include <string>

namespace
{
using namespace svotest;

/// Sets the window's AbortRender when it asks, while told to.
struct Impatient
{
  explicit Impatient(vtkRenderWindow* window)
  {
    this->command->SetClientData(this);
    this->command->SetCallback(
      [](vtkObject* caller, unsigned long, void* self, void*)
      {
        auto* own = static_cast<Impatient*>(self);
        ++own->asked;
        static_cast<vtkRenderWindow*>(caller)->SetAbortRender(own->impatient ? 1 : 0);
      });
    window->AddObserver(vtkCommand::AbortCheckEvent, this->command);
  }
  vtkNew<vtkCallbackCommand> command;
  bool impatient = true;
  int asked = 0;
};

void fill(Stage& stage)
{
  stage.addGround();
  stage.add(ring(0.9, 0.0, 0.0, 1.0), 0.9, 0.5, 0.3);
  stage.addSun(2.0, -1.5, 4.0);
}

void testAbort(Checks& checks)
{
  Picture wanted;
  {
    Stage other;
    fill(other);
    wanted = other.shadowed();
  }
  Stage stage;
  fill(stage);
  Impatient user(stage.window);
  stage.shadowed(); // VTK's own mappers draw nothing when they see the abort
  checks.expect(user.asked > 0, "whoever looks at the window is asked");
  checks.expect(stage.pass->GetNumberOfOctreesBuilt() == 0, "nothing is built");
  stage.expectTraced(checks, 0, "nothing is traced");
  stage.expectRasterized(checks, 2, "all is left to the rasteriser");
  user.impatient = false;
  const Picture waited = stage.shadowed();
  checks.expect(difference(waited, wanted).largest == 0, "the next picture is complete");
  stage.expectTraced(checks, 2, "and traced");

  // What is there is no reason to wait. VTK's own mappers, if the frame takes them long, do abort.
  user.impatient = true;
  checks.expect(
    drawnByOpenGL() || difference(stage.shadowed(), wanted).largest == 0, "nothing to abort");
}

void testRelease(Checks& checks)
{
  Stage stage;
  fill(stage);
  const Picture before = stage.shadowed();
  const int built = stage.pass->GetNumberOfOctreesBuilt();
  checks.expect(stage.pass->GetOctreeMemorySize() > 0, "there are octrees");
  stage.pass->ReleaseOctrees();
  checks.expect(stage.pass->GetOctreeMemorySize() == 0, "they are freed");
  checks.expect(difference(stage.shadowed(), before).largest == 0, "the picture is the same");
  checks.expect(stage.pass->GetNumberOfOctreesBuilt() == 2 * built, "of octrees built anew");

  // In the midst of a frame, which needs them: afterwards.
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(stage.pass);
  command->SetCallback([](vtkObject*, unsigned long, void* pass, void*)
    { static_cast<vtkSVORenderPass*>(pass)->ReleaseOctrees(); });
  stage.pass->ReleaseOctrees();
  stage.pass->AddObserver(vtkCommand::ProgressEvent, command);
  checks.expect(difference(stage.shadowed(), before).largest == 0, "an observer may ask for it");
  checks.expect(stage.pass->GetOctreeMemorySize() == 0, "and has it after the frame");
}

void testLimit(Checks& checks)
{
  Stage stage;
  fill(stage);
  stage.pass->SetOctreeMemoryLimit(1);
  int warnings = 0;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&warnings);
  command->SetCallback(
    [](vtkObject*, unsigned long, void* count, void* text)
    {
      const std::string message(static_cast<const char*>(text));
      *static_cast<int*>(count) += message.find("OctreeMemoryLimit") != std::string::npos;
    });
  stage.pass->AddObserver(vtkCommand::WarningEvent, command);
  stage.shadowed();
  stage.shadowed();
  checks.expect(warnings == 1, "one message says that a frame needs more than the limit");
}
}

int TestSVOAbort(int, char*[])
{
  Checks checks;
  testAbort(checks);
  testRelease(checks);
  testLimit(checks);
  return checks.exitCode();
}
