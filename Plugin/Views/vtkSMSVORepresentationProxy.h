/**
 * @class vtkSMSVORepresentationProxy
 * @brief tells the representation, on all processes, whether the user is interacting
 *
 * ParaView updates its pipelines before interactive frames, too, but only a view's proxy says what
 * kind of frame begins. Where an interactive frame begins with an update, representations that are
 * shown hear of it from this one; before the next still picture they complete what that update left
 * out.
 *
 * Not told of interactive frames are representations of sessions with several clients, of
 * comparative views, and while a screenshot is taken: nothing may be left out there.
 *
 * Properties for information are read where octrees are built: on the server's first process.
 */
#ifndef vtkSMSVORepresentationProxy_h
#define vtkSMSVORepresentationProxy_h

#include "vtkSMRepresentationProxy.h"
#include "vtkSVOViewsModule.h" // for the export macro
#include "vtkWeakPointer.h"    // for vtkWeakPointer

class vtkSVORepresentation;

class VTKSVOVIEWS_EXPORT vtkSMSVORepresentationProxy : public vtkSMRepresentationProxy
{
public:
  static vtkSMSVORepresentationProxy* New();
  vtkTypeMacro(vtkSMSVORepresentationProxy, vtkSMRepresentationProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSMSVORepresentationProxy() = default;
  ~vtkSMSVORepresentationProxy() override = default;

  // Views are consumers.
  void AddConsumer(vtkSMProperty* property, vtkSMProxy* proxy) override;
  void RemoveConsumer(vtkSMProperty* property, vtkSMProxy* proxy) override;
  void RemoveAllConsumers() override;

  void UpdatePropertyInformationInternal(vtkSMProperty* property) override;

private:
  void Listen(vtkSMProxy* view);
  void FrameBegins(vtkObject* view, unsigned long event, void* interactive);
  void FrameEnds();
  bool MustBeComplete(vtkSVORepresentation* own, bool interactive);
  void TellInteractive(bool interactive);

  vtkWeakPointer<vtkSMProxy> View;
  unsigned long Observers[2] = { 0, 0 };
  bool Interactive = false; // as the processes were told last
};

#endif
