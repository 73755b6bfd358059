#include "vtkSVOViewPass.h"

#include "svoShadowGround.h"

#include "vtkActor.h"
#include "vtkCollectionRange.h"
#include "vtkCommand.h"
#include "vtkCompositeRepresentation.h"
#include "vtkGeometryRepresentation.h"
#include "vtkImageSliceRepresentation.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkMoleculeRepresentation.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODActor.h"
#include "vtkPVRenderView.h"
#include "vtkPVSynchronizedRenderer.h"
#include "vtkPointGaussianRepresentation.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkSVOViewRenderPass.h"
#include "vtkSynchronizedRenderers.h"

vtkStandardNewMacro(vtkSVOViewPass);
vtkInformationKeyMacro(vtkSVOViewPass, VIEW_PASS, ObjectBase);

vtkSVOViewPass::vtkSVOViewPass()
  : Pass(vtkSVOViewRenderPass::New())
  , Ground(new svo::ShadowGround)
{
  this->Pass->AddObserver(vtkCommand::ModifiedEvent, this, &vtkSVOViewPass::UpdateAttachment);
}

vtkSVOViewPass::~vtkSVOViewPass()
{
  this->Pass->Delete();
}

/// Null if the view is no render view.
vtkSVOViewPass* vtkSVOViewPass::OfView(vtkObjectBase* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return nullptr;
  }
  vtkRenderer* renderer = renderView->GetRenderer();
  if (!renderer->GetInformation())
  {
    vtkNew<vtkInformation> information;
    renderer->SetInformation(information);
  }
  auto* found = SafeDownCast(renderer->GetInformation()->Get(VIEW_PASS()));
  if (!found)
  {
    vtkNew<vtkSVOViewPass> made;
    made->View = renderView;
    made->Pass->SetView(renderView);
    renderer->GetInformation()->Set(VIEW_PASS(), made);
    found = made;
  }
  return found;
}

vtkSVORenderPass* vtkSVOViewPass::Of(vtkObjectBase* view)
{
  vtkSVOViewPass* self = OfView(view);
  return self ? self->Pass : nullptr;
}

namespace
{
/// The actor by which a representation shows surfaces; null if it does not.
vtkActor* actorOf(vtkPVDataRepresentation* shown)
{
  struct Asking : public vtkPointGaussianRepresentation
  {
    using vtkPointGaussianRepresentation::Actor;
  };
  if (auto* surface = vtkGeometryRepresentation::SafeDownCast(shown))
  {
    return surface->GetActor();
  }
  if (auto* slice = vtkImageSliceRepresentation::SafeDownCast(shown))
  {
    return slice->GetActor();
  }
  if (auto* molecule = vtkMoleculeRepresentation::SafeDownCast(shown))
  {
    return molecule->GetActor();
  }
  auto* points = vtkPointGaussianRepresentation::SafeDownCast(shown);
  return points ? (points->*(&Asking::Actor)).Get() : nullptr;
}
}

std::string vtkSVOViewPass::GetReason(vtkPVDataRepresentation* shown)
{
  vtkSVOViewPass* self = shown && shown->GetVisibility() ? OfView(shown->GetView()) : nullptr;
  if (!self)
  {
    return std::string();
  }
  auto* choice = vtkCompositeRepresentation::SafeDownCast(shown);
  vtkPVDataRepresentation* active = choice ? choice->GetActiveRepresentation() : shown;
  vtkActor* actor = actorOf(active);
  if (!actor)
  {
    const char* key = choice ? choice->GetActiveRepresentationKey() : nullptr;
    return key ? std::string("Casts no shadow: it is shown as ") + key + "." : std::string();
  }
  return self->Observers[0] ? self->Pass->GetReasonInLastFrame(actor)
                            : "Left to the rasteriser: it is not shown as SVO. "
                              "Casts no shadow: it is not shown as SVO.";
}

void vtkSVOViewPass::AddUser(vtkView* view)
{
  if (vtkSVOViewPass* self = OfView(view))
  {
    ++self->Users;
    self->UpdateAttachment();
  }
}

void vtkSVOViewPass::RemoveUser(vtkView* view)
{
  if (vtkSVOViewPass* self = OfView(view))
  {
    self->Users -= self->Users > 0 ? 1 : 0;
    self->UpdateAttachment();
  }
}

/// Attaches the pass to the view's renderer, or detaches it.
void vtkSVOViewPass::UpdateAttachment()
{
  const bool needed =
    this->Users > 0 || this->Pass->GetShadowsForEverything() || this->Pass->GetShadowGround() > 0;
  if (!this->View || needed == (this->Observers[0] != 0))
  {
    return;
  }
  vtkRenderer* renderer = this->View->GetRenderer();
  if (!needed)
  {
    this->Pass->Detach(renderer);
    this->Ground->remove(renderer);
    for (unsigned long& observer : this->Observers)
    {
      renderer->RemoveObserver(observer);
      observer = 0;
    }
    return;
  }
  this->Observers[0] =
    renderer->AddObserver(vtkCommand::StartEvent, this, &vtkSVOViewPass::BeginFrame);
  this->Observers[1] = renderer->AddObserver(vtkCommand::EndEvent, this, &vtkSVOViewPass::EndFrame);
  // The axes at the centre of rotation are part of the view, not of what it shows.
  for (vtkObject* prop : vtk::Range(renderer->GetViewProps()))
  {
    if (prop->IsA("vtkPVCenterAxesActor"))
    {
      vtkSVORenderPass::SetReceiveShadow(false, static_cast<vtkProp*>(prop));
    }
  }
  this->Pass->Attach(renderer);
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
  this->Ground->place(
    view->GetRenderer(), this->Pass->GetShadowGround() - 1, this->Pass->GetController());
  this->Pass->SetImageReductionFactor(ofServers ? ofServers->GetImageReductionFactor() : 1);
}

void vtkSVOViewPass::EndFrame()
{
  this->Ground->endFrame();
}

void vtkSVOViewPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Users: " << this->Users << '\n' << indent << "Pass:\n";
  this->Pass->PrintSelf(os, indent.GetNextIndent());
}
