#include "vtkSMSVORepresentationProxy.h"

#include "vtkClientServerStream.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkPVSession.h"
#include "vtkPVView.h"
#include "vtkSMSession.h"
#include "vtkSMViewProxy.h"
#include "vtkSVORepresentation.h"

vtkStandardNewMacro(vtkSMSVORepresentationProxy);

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
    for (unsigned long observer : this->Observers)
    {
      this->View->RemoveObserver(observer);
    }
  }
  this->FrameEnds();
  this->View = view;
  if (view)
  {
    this->Observers[0] =
      view->AddObserver(vtkCommand::StartEvent, this, &vtkSMSVORepresentationProxy::FrameBegins);
    this->Observers[1] =
      view->AddObserver(vtkCommand::EndEvent, this, &vtkSMSVORepresentationProxy::FrameEnds);
  }
}

/// Whether the frame that begins has to be complete.
bool vtkSMSVORepresentationProxy::MustBeComplete(vtkSVORepresentation* own, bool interactive)
{
  // The view knows, but tells its subclasses only.
  struct Asking : public vtkPVView
  {
    using vtkPVView::GetInCaptureScreenshot;
  };
  auto* view = vtkPVView::SafeDownCast(this->View->GetClientSideObject());
  return !interactive || !view || (view->*(&Asking::GetInCaptureScreenshot))() ||
    own->GetForceUseCache() || this->GetSession()->IsMultiClients();
}

void vtkSMSVORepresentationProxy::FrameBegins(vtkObject*, unsigned long, void* interactive)
{
  struct Asking : public vtkSMProxy
  {
    using vtkSMProxy::NeedsUpdate;
  };
  auto* own = vtkSVORepresentation::SafeDownCast(this->GetClientSideObject());
  if (!own || !this->View)
  {
    return;
  }
  if (!this->MustBeComplete(own, interactive && *static_cast<int*>(interactive) != 0))
  {
    if (own->GetVisibility() && this->View->*(&Asking::NeedsUpdate))
    {
      this->TellInteractive(true);
    }
  }
  else if (own->GetUpdatedInteractively())
  {
    vtkClientServerStream stream;
    stream << vtkClientServerStream::Invoke << VTKOBJECT(this) << "CompleteUpdate"
           << vtkClientServerStream::End;
    this->ExecuteStream(stream);
    this->MarkDirty(this); // so that the view updates before it draws
  }
}

void vtkSMSVORepresentationProxy::FrameEnds()
{
  if (this->Interactive)
  {
    this->TellInteractive(false);
  }
}

void vtkSMSVORepresentationProxy::TellInteractive(bool interactive)
{
  this->Interactive = interactive;
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(this) << "SetInteractive"
         << (interactive ? 1 : 0) << vtkClientServerStream::End;
  this->ExecuteStream(stream);
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
