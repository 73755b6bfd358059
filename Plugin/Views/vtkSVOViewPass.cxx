#include "vtkSVOViewPass.h"

#include "vtkCollection.h"
#include "vtkCommand.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkPVSynchronizedRenderer.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkSVOViewRenderPass.h"
#include "vtkSynchronizedRenderers.h"

vtkStandardNewMacro(vtkSVOViewPass);
vtkInformationKeyMacro(vtkSVOViewPass, VIEW_PASS, ObjectBase);

vtkSVOViewPass::vtkSVOViewPass()
  : Pass(vtkSVOViewRenderPass::New())
{
}

vtkSVOViewPass::~vtkSVOViewPass()
{
  this->Pass->Delete();
}

vtkSVOViewPass* vtkSVOViewPass::OfRenderer(vtkRenderer* renderer)
{
  if (!renderer->GetInformation())
  {
    vtkNew<vtkInformation> information;
    renderer->SetInformation(information);
  }
  auto* found = SafeDownCast(renderer->GetInformation()->Get(VIEW_PASS()));
  if (!found)
  {
    vtkNew<vtkSVOViewPass> made;
    renderer->GetInformation()->Set(VIEW_PASS(), made);
    found = made;
  }
  return found;
}

vtkSVORenderPass* vtkSVOViewPass::Of(vtkObjectBase* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  return renderView ? OfRenderer(renderView->GetRenderer())->Pass : nullptr;
}

void vtkSVOViewPass::AddUser(vtkView* view)
{
  if (auto* renderView = vtkPVRenderView::SafeDownCast(view))
  {
    vtkSVOViewPass* self = OfRenderer(renderView->GetRenderer());
    if (self->Users++ == 0)
    {
      self->View = renderView;
      self->Observer = renderView->GetRenderer()->AddObserver(
        vtkCommand::StartEvent, self, &vtkSVOViewPass::BeginFrame);
      // The axes at the centre of rotation are part of the view, not of what it shows.
      vtkCollectionSimpleIterator iterator;
      vtkPropCollection* props = renderView->GetRenderer()->GetViewProps();
      props->InitTraversal(iterator);
      while (vtkProp* prop = props->GetNextProp(iterator))
      {
        if (prop->IsA("vtkPVCenterAxesActor"))
        {
          vtkSVORenderPass::SetReceiveShadow(false, prop);
        }
      }
      self->Pass->Attach(renderView->GetRenderer());
    }
  }
}

void vtkSVOViewPass::RemoveUser(vtkView* view)
{
  if (auto* renderView = vtkPVRenderView::SafeDownCast(view))
  {
    vtkSVOViewPass* self = OfRenderer(renderView->GetRenderer());
    if (self->Users > 0 && --self->Users == 0)
    {
      self->Pass->Detach(renderView->GetRenderer());
      renderView->GetRenderer()->RemoveObserver(self->Observer);
    }
  }
}

void vtkSVOViewPass::BeginFrame()
{
  // The view knows, but tells its subclasses only. While it makes a selection it also draws
  // ordinary frames, for their depth.
  struct Asking : public vtkPVRenderView
  {
    using vtkPVRenderView::GetMakingSelection;
    using vtkPVRenderView::SynchronizedRenderers;
  };
  vtkPVRenderView* view = this->View;
  if (!view)
  {
    return;
  }
  this->Pass->SetTracing(!(view->*(&Asking::GetMakingSelection))());
  // Enabled for this frame if all processes render it.
  vtkPVSynchronizedRenderer* together = view->*(&Asking::SynchronizedRenderers);
  vtkSynchronizedRenderers* ofServers =
    together->GetEnabled() ? together->GetParallelSynchronizer() : nullptr;
  this->Pass->SetController(
    together->GetEnabled() ? vtkMultiProcessController::GetGlobalController() : nullptr);
  this->Pass->SetImageReductionFactor(ofServers ? ofServers->GetImageReductionFactor() : 1);
}

void vtkSVOViewPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Users: " << this->Users << '\n' << indent << "Pass:\n";
  this->Pass->PrintSelf(os, indent.GetNextIndent());
}
