#include "vtkSMSVOViewInformationProperty.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkPVSVOViewInformation.h"
#include "vtkPVSession.h"
#include "vtkSMProxy.h"

vtkStandardNewMacro(vtkSMSVOViewInformationProperty);

void vtkSMSVOViewInformationProperty::ReadFrom(
  const vtkSMMessage* message, int offset, vtkSMProxyLocator* locator)
{
  this->Superclass::ReadFrom(message, offset, locator);
  vtkSMProxy* parent = this->GetParent();
  auto* view = parent ? vtkPVRenderView::SafeDownCast(parent->GetClientSideObject()) : nullptr;
  if (!view || !this->GetCommand())
  {
    return;
  }
  const bool remote = view->GetUsedLODForLastRender()
    ? view->GetUseDistributedRenderingForLODRender()
    : view->GetUseDistributedRenderingForRender();
  if (remote)
  {
    vtkNew<vtkPVSVOViewInformation> information;
    information->SetCommand(this->GetCommand());
    parent->GatherInformation(information, vtkPVSession::RENDER_SERVER);
    this->SetElement(0, information->GetValue());
  }
}
