/**
 * @class vtkSMSVORepresentationProxy
 * @brief tells the representation, on all processes, whether the user is interacting
 *
 * ParaView updates its pipelines before interactive frames, too, but only a view's proxy says what
 * kind of frame begins. Representations that are shown hear from this one when an interaction
 * begins and when the next still picture does.
 */
#ifndef vtkSMSVORepresentationProxy_h
#define vtkSMSVORepresentationProxy_h

#include "vtkSMRepresentationProxy.h"
#include "vtkSVOViewsModule.h" // for the export macro
#include "vtkWeakPointer.h"    // for vtkWeakPointer

class VTKSVOVIEWS_EXPORT vtkSMSVORepresentationProxy : public vtkSMRepresentationProxy
{
public:
  static vtkSMSVORepresentationProxy* New();
  vtkTypeMacro(vtkSMSVORepresentationProxy, vtkSMRepresentationProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSMSVORepresentationProxy();
  ~vtkSMSVORepresentationProxy() override;

  // Views are consumers.
  void AddConsumer(vtkSMProperty* property, vtkSMProxy* proxy) override;
  void RemoveConsumer(vtkSMProperty* property, vtkSMProxy* proxy) override;
  void RemoveAllConsumers() override;

  void UpdatePropertyInformationInternal(vtkSMProperty* property) override;

private:
  vtkSMSVORepresentationProxy(const vtkSMSVORepresentationProxy&) = delete;
  void operator=(const vtkSMSVORepresentationProxy&) = delete;

  void Listen(vtkSMProxy* view);
  void FrameBegins(vtkObject* view, unsigned long event, void* interactive);

  vtkWeakPointer<vtkSMProxy> View;
  unsigned long Observer = 0;
  bool Interactive = false; // as the processes were told last
};

#endif
