#include "vtkSMSVOReasonProperty.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVSVOReasonInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <map>
#include <string>

namespace
{
/// Names of what a view shows, by those that its representations are logged with. Nothing of
/// others.
std::map<std::string, std::string> sourcesOf(vtkSMProxy* view)
{
  std::map<std::string, std::string> sources;
  constexpr bool Quiet = true;
  const vtkSMPropertyHelper shown(view, "Representations", Quiet);
  for (unsigned int i = 0; i < shown.GetNumberOfElements(); ++i)
  {
    vtkSMProxy* representation = shown.GetAsProxy(i);
    vtkSMProxy* source =
      representation ? vtkSMPropertyHelper(representation, "Input", Quiet).GetAsProxy() : nullptr;
    if (source && source->GetLogName())
    {
      sources[representation->GetLogNameOrDefault()] = source->GetLogName();
    }
  }
  return sources;
}
}

vtkStandardNewMacro(vtkSMSVOReasonProperty);

void vtkSMSVOReasonProperty::ReadFrom(
  const vtkSMMessage* message, int offset, vtkSMProxyLocator* locator)
{
  this->Superclass::ReadFrom(message, offset, locator);
  if (vtkSMProxy* parent = this->GetParent())
  {
    vtkNew<vtkPVSVOReasonInformation> information;
    parent->GatherInformation(information);
    this->SetElement(0, information->GetText(sourcesOf(parent)).c_str());
  }
}
