// Selection names the same actors and cells with the pass as without it.
#include "svoTestStage.h"

#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

#include <iostream>
#include <map>
#include <set>

namespace
{
using Selected = std::map<vtkProp*, std::set<vtkIdType>>;

Selected select(vtkRenderer* renderer)
{
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(renderer);
  selector->SetArea(60, 60, 240, 240);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
  vtkSmartPointer<vtkSelection> selection;
  selection.TakeReference(selector->Select());
  Selected result;
  for (unsigned int i = 0; selection && i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection->GetNode(i);
    auto* prop = vtkProp::SafeDownCast(node->GetProperties()->Get(vtkSelectionNode::PROP()));
    auto* ids = vtkIdTypeArray::SafeDownCast(node->GetSelectionList());
    for (vtkIdType k = 0; ids && k < ids->GetNumberOfValues(); ++k)
    {
      result[prop].insert(ids->GetValue(k));
    }
  }
  return result;
}
}

int TestSVOSelection(int, char*[])
{
  using namespace svotest;
  Checks checks;
  Stage stage;
  stage.addGround();
  stage.add(ball(0.7, -0.6, -0.2, 0.9), 0.9, 0.5, 0.3);
  stage.add(box(0.8, 0.8, 0.0, 0.4), 0.3, 0.6, 0.9);
  stage.addSun(2.0, -1.5, 4.0);
  const Picture before = stage.shadowed();
  const Selected traced = select(stage.renderer);
  const Picture after = stage.shadowed();
  checks.expect(difference(before, after).largest == 0, "a selection leaves the picture as it was");
  stage.usePass(false);
  capture(stage.window);
  const Selected rasterised = select(stage.renderer);
  std::cout << traced.size() << " and " << rasterised.size() << " props selected\n";
  checks.expect(rasterised.size() == 3, "all three actors are selected");
  checks.expect(traced == rasterised, "the same cells with the pass as without");
  return checks.exitCode();
}
