#include "vtkSMSVORepresentationProxy.h"

#include "vtkClientServerStream.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkPVSession.h"
#include "vtkSMViewProxy.h"
#include "vtkSVORepresentation.h"

vtkStandardNewMacro(vtkSMSVORepresentationProxy);

vtkSMSVORepresentationProxy::vtkSMSVORepresentationProxy() = default;
vtkSMSVORepresentationProxy::~vtkSMSVORepresentationProxy() = default;

void vtkSMSVORepresentationProxy::AddConsumer(vtkSMProperty* property, vtkSMProxy* proxy)
{
  this->Superclass::AddConsumer(property, proxy);
  if (vtkSMViewProxy::SafeDownCast(proxy) && proxy != this->View)
  {
    this->Listen(proxy);
  }
}

void vtkSMSVORepresentationProxy::RemoveConsumer(vtkSMProperty* property, vtkSMProxy* proxy)
{
  this->Superclass::RemoveConsumer(property, proxy);
  if (proxy == this->View)
  {
    this->Listen(nullptr);
  }
}

void vtkSMSVORepresentationProxy::RemoveAllConsumers()
{
  this->Superclass::RemoveAllConsumers();
  this->Listen(nullptr);
}

void vtkSMSVORepresentationProxy::Listen(vtkSMProxy* view)
{
  if (this->View)
  {
    this->View->RemoveObserver(this->Observer);
  }
  this->View = view;
  if (view)
  {
    this->Observer =
      view->AddObserver(vtkCommand::StartEvent, this, &vtkSMSVORepresentationProxy::FrameBegins);
  }
}

void vtkSMSVORepresentationProxy::FrameBegins(vtkObject*, unsigned long, void* calldata)
{
  auto* own = vtkSVORepresentation::SafeDownCast(this->GetClientSideObject());
  const bool interactive = calldata && *static_cast<int*>(calldata) != 0;
  if (!own || interactive == this->Interactive || (interactive && !own->GetVisibility()))
  {
    return;
  }
  this->Interactive = interactive;
  const bool again = !interactive && own->GetUpdatedInteractively();
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(this) << "SetInteractive"
         << (interactive ? 1 : 0) << vtkClientServerStream::End;
  this->ExecuteStream(stream);
  if (again)
  {
    this->MarkDirty(this); // so that the view updates before it draws
  }
}

void vtkSMSVORepresentationProxy::UpdatePropertyInformationInternal(vtkSMProperty* property)
{
  this->CreateVTKObjects();
  const vtkTypeUInt32 location = this->Location;
  this->Location &= vtkPVSession::SERVERS;
  this->Superclass::UpdatePropertyInformationInternal(property);
  this->Location = location;
}

void vtkSMSVORepresentationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Interactive: " << this->Interactive << '\n';
}
