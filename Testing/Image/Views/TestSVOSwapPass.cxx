// Swapping the pass on and off ten times leaves nothing behind: not in the picture, not in the
// renderer's props, not in anybody's reference count.
#include "svoTestStage.h"

#include "vtkDataObject.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"

#include <vector>

namespace
{
std::vector<int> references(vtkRenderer* renderer)
{
  std::vector<int> counts;
  vtkPropCollection* props = renderer->GetViewProps();
  for (int i = 0; i < props->GetNumberOfItems(); ++i)
  {
    auto* actor = vtkActor::SafeDownCast(props->GetItemAsObject(i));
    counts.push_back(actor->GetReferenceCount());
    counts.push_back(actor->GetMapper()->GetReferenceCount());
    counts.push_back(actor->GetMapper()->GetInputDataObject(0, 0)->GetReferenceCount());
    counts.push_back(actor->GetVisibility());
  }
  return counts;
}
}

int TestSVOSwapPass(int, char*[])
{
  using namespace svotest;
  Checks checks;
  Stage stage;
  stage.addGround();
  stage.add(ball(0.7, -0.6, -0.2, 0.9), 0.9, 0.5, 0.3);
  vtkActor* edged = stage.add(box(0.8, 0.8, 0.0, 0.4), 0.3, 0.6, 0.9);
  edged->GetProperty()->EdgeVisibilityOn();
  vtkActor* glass = stage.add(ball(0.5, 0.4, -1.2, 0.6), 0.3, 0.9, 0.4);
  glass->GetProperty()->SetOpacity(0.5);
  stage.addSun(2.0, -1.5, 4.0);

  stage.usePass(false);
  const Picture off = capture(stage.window);
  const std::vector<int> before = references(stage.renderer);
  stage.usePass(true);
  const Picture on = stage.shadowed();
  checks.expect(difference(on, off).mean > 1.0, "the pass adds shadows");
  for (int i = 0; i < 10; ++i)
  {
    stage.usePass(false);
    checks.expect(difference(capture(stage.window), off).largest == 0, "off: VTK's own picture");
    stage.usePass(true);
    checks.expect(difference(capture(stage.window), on).largest == 0, "on: the first picture");
  }
  stage.usePass(false);
  capture(stage.window);
  stage.pass->ReleaseGraphicsResources(stage.window);
  checks.expect(difference(capture(stage.window), off).largest == 0, "released: VTK's own picture");
  checks.expect(references(stage.renderer) == before, "no reference was kept");
  stage.usePass(true);
  checks.expect(difference(capture(stage.window), on).largest == 0,
    "on again after its resources were released");
  return checks.exitCode();
}
