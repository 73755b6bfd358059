#include "vtkSMSVOFrameInformationDomain.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkSMProperty.h"
#include "vtkSMProxy.h"

vtkStandardNewMacro(vtkSMSVOFrameInformationDomain);

int vtkSMSVOFrameInformationDomain::ReadXMLAttributes(
  vtkSMProperty* property, vtkPVXMLElement* element)
{
  if (!this->Superclass::ReadXMLAttributes(property, element))
  {
    return 0;
  }
  if (vtkSMProxy* view = property->GetParent())
  {
    view->AddObserver(vtkCommand::EndEvent, this, &vtkSMSVOFrameInformationDomain::FrameEnds);
  }
  return 1;
}

void vtkSMSVOFrameInformationDomain::FrameEnds(vtkObject* view, unsigned long, void* interactive)
{
  // vtkSMViewProxy passes whether the frame was an interactive one: those must not wait for an
  // answer.
  vtkSMProperty* property = this->GetProperty();
  if (property && interactive && *static_cast<int*>(interactive) == 0)
  {
    static_cast<vtkSMProxy*>(view)->UpdatePropertyInformation(property);
  }
}
