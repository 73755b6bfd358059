#include "vtkSMSVOReasonProperty.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVSVOReasonInformation.h"
#include "vtkSMProxy.h"

vtkStandardNewMacro(vtkSMSVOReasonProperty);

vtkSMSVOReasonProperty::vtkSMSVOReasonProperty() = default;
vtkSMSVOReasonProperty::~vtkSMSVOReasonProperty() = default;

void vtkSMSVOReasonProperty::ReadFrom(
  const vtkSMMessage* message, int offset, vtkSMProxyLocator* locator)
{
  this->Superclass::ReadFrom(message, offset, locator);
  if (vtkSMProxy* parent = this->GetParent())
  {
    vtkNew<vtkPVSVOReasonInformation> information;
    parent->GatherInformation(information);
    this->SetElement(0, information->GetText().c_str());
  }
}

void vtkSMSVOReasonProperty::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
