#include "vtkSISVOViewProperty.h"

#include "vtkClientServerStream.h"
#include "vtkObjectFactory.h"
#include "vtkSMMessage.h"
#include "vtkSVORenderPass.h"
#include "vtkSVOViewPass.h"

#include <string>

vtkStandardNewMacro(vtkSISVOViewProperty);

bool vtkSISVOViewProperty::Push(vtkSMMessage* message, int offset)
{
  this->SaveValueToCache(message, offset);
  vtkSVORenderPass* pass = vtkSVOViewPass::Of(this->GetVTKObject());
  if (this->InformationOnly || !this->Command || !pass)
  {
    return true;
  }
  const auto& property = message->GetExtension(paraview_protobuf::ProxyState::property, offset);
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << pass << this->Command << property.value()
         << vtkClientServerStream::End;
  return this->ProcessMessage(stream);
}

bool vtkSISVOViewProperty::Pull(vtkSMMessage* message)
{
  if (!this->InformationOnly)
  {
    return this->Superclass::Pull(message);
  }
  vtkSVORenderPass* pass = vtkSVOViewPass::Of(this->GetVTKObject());
  if (!this->Command || !pass)
  {
    return true;
  }
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << pass << this->Command << vtkClientServerStream::End;
  this->ProcessMessage(stream);

  const vtkClientServerStream& result = this->GetLastResult();
  paraview_protobuf::Variant value;
  double number;
  std::string text;
  if (result.GetArgument(0, 0, &text))
  {
    value.set_type(paraview_protobuf::Variant::STRING);
    value.add_txt(text);
  }
  else if (result.GetArgument(0, 0, &number))
  {
    value.set_type(paraview_protobuf::Variant::FLOAT64);
    value.add_float64(number);
  }
  else
  {
    return false;
  }
  auto* property = message->AddExtension(paraview_protobuf::ProxyState::property);
  property->set_name(this->GetXMLName());
  property->mutable_value()->CopyFrom(value);
  return true;
}
