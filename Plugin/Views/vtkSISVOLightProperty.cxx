#include "vtkSISVOLightProperty.h"

#include "vtkLight.h"
#include "vtkObjectFactory.h"
#include "vtkSMMessage.h"
#include "vtkSVORenderPass.h"

vtkStandardNewMacro(vtkSISVOLightProperty);

bool vtkSISVOLightProperty::Push(vtkSMMessage* message, int offset)
{
  this->SaveValueToCache(message, offset);
  const auto& value =
    message->GetExtension(paraview_protobuf::ProxyState::property, offset).value();
  if (value.float64_size() == 1)
  {
    vtkSVORenderPass::SetLightSize(value.float64(0), vtkLight::SafeDownCast(this->GetVTKObject()));
  }
  return true;
}
