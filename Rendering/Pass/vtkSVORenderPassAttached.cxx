// Frames of renderers that the pass is attached to, but not set on.
#include "vtkSVORenderPass.h"

#include "svoPassInternals.h"

#include "vtkCameraPass.h"
#include "vtkCommand.h"
#include "vtkCuller.h"
#include "vtkCullerCollection.h"
#include "vtkObjectFactory.h"
#include "vtkPropCollection.h"
#include "vtkRenderState.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <string>

namespace
{
/// Hosts that spread a frame over several processes do so in the same events, before us.
constexpr float AfterHosts = -1.0f;

/// True if the first that a renderer with this pass draws into its cleared framebuffer are its
/// props, in their order. ParaView's views have such a pass, unless they have effects.
bool drawsPropsFirst(vtkRenderPass* pass)
{
  const auto isA = [](vtkObject* object, const char* name)
  { return object && std::string(object->GetClassName()) == name; };
  if (!isA(pass, "vtkCameraPass"))
  {
    return !pass;
  }
  vtkRenderPass* inner = static_cast<vtkCameraPass*>(pass)->GetDelegatePass();
  return isA(inner, "vtkDefaultPass") || isA(inner, "vtkPVDefaultPass");
}

/// Takes what is traced out of what a renderer draws in a frame. The props stay visible and in the
/// renderer's list, where bounds, pickers and selectors find them.
class TracedCuller : public vtkCuller
{
public:
  static TracedCuller* New();
  vtkTypeMacro(TracedCuller, vtkCuller);

  double Cull(vtkRenderer*, vtkProp** props, int& count, int& initialized) override
  {
    count = static_cast<int>(std::stable_partition(props, props + count,
                               [this](vtkProp* prop) { return !this->IsTraced(prop); }) -
      props);
    // The times that cullers before this one have allotted; without one VTK gives each prop 1.
    return !initialized
      ? count
      : std::accumulate(props, props + count, 0.0,
          [](double sum, vtkProp* prop) { return sum + prop->GetRenderTimeMultiplier(); });
  }

  std::function<bool(vtkProp*)> IsTraced;
};
vtkStandardNewMacro(TracedCuller);
}

void vtkSVORenderPass::Attach(vtkRenderer* renderer)
{
  Internals& impl = *this->Impl;
  if (!renderer)
  {
    return;
  }
  svo::AttachedRenderer& attached = impl.attached[renderer];
  attached.leaving = false;
  if (attached.renderer == renderer)
  {
    return;
  }
  attached.renderer = renderer;
  attached.observers = { renderer->AddObserver(vtkCommand::StartEvent, this,
                           &vtkSVORenderPass::BeginAttachedFrame, AfterHosts),
    renderer->AddObserver(
      vtkCommand::EndEvent, this, &vtkSVORenderPass::EndAttachedFrame, AfterHosts),
    renderer->AddObserver(vtkCommand::DeleteEvent, this, &vtkSVORenderPass::ForgetAttached) };
  vtkNew<TracedCuller> culler;
  culler->IsTraced = [this, renderer](vtkProp* prop)
  {
    const svo::PassFrame* frame = this->Impl->frameOf(renderer);
    return frame && frame->state->traces(prop);
  };
  attached.culler = culler;

  vtkSVOPresenter* presenter = impl.stateOf(renderer)->presenter();
  presenter->SetPrepare(
    [this, renderer](int width, int height)
    {
      svo::PassFrame* frame = this->Impl->frameOf(renderer);
      if (frame && !(frame->traced && frame->state->shows(width, height)))
      {
        this->TraceFrame(*frame, width, height);
        if (frame->shadowed)
        {
          frame->state->findLight(frame->receivers());
        }
        frame->state->present(this);
        frame->state->presenter()->SetFirst(drawsPropsFirst(renderer->GetPass()));
      }
    });
  // Shadows must be known before the first surface that receives them is drawn.
  renderer->AddViewProp(presenter);
  vtkPropCollection* props = renderer->GetViewProps();
  if (props->GetNumberOfItems() > 1)
  {
    props->RemoveItem(presenter);
    props->InsertItem(-1, presenter);
  }
}

void vtkSVORenderPass::Detach(vtkRenderer* renderer)
{
  Internals& impl = *this->Impl;
  const auto found = impl.attached.find(renderer);
  if (found == impl.attached.end())
  {
    return;
  }
  if (impl.frameOf(renderer))
  {
    found->second.leaving = true; // VTK is about to draw the presenter, and others ask the pass
    return;
  }
  if (found->second.renderer)
  {
    for (unsigned long observer : found->second.observers)
    {
      renderer->RemoveObserver(observer);
    }
    renderer->RemoveCuller(found->second.culler);
    const std::shared_ptr<svo::RendererState> kept = impl.stateOf(renderer);
    kept->presenter()->SetPrepare(nullptr);
    renderer->RemoveViewProp(kept->presenter());
    if (renderer->GetRenderWindow())
    {
      kept->releaseGraphicsResources(renderer->GetRenderWindow());
    }
  }
  impl.attached.erase(found);
  impl.renderers.erase(renderer);
  // What is told of the last frame is about none that is seen any more.
  impl.statistics = svo::PassStatistics();
  impl.castingLights.clear();
  impl.reasons.clear();
}

/// The renderer is being deleted.
void vtkSVORenderPass::ForgetAttached(vtkObject* caller, unsigned long, void*)
{
  const vtkSmartPointer<vtkSVORenderPass> alive(this);
  auto* renderer = static_cast<vtkRenderer*>(caller);
  if (svo::PassFrame* frame = this->Impl->frameOf(renderer))
  {
    this->FinishFrame(*frame);
  }
  this->Impl->attached.erase(renderer);
  this->Impl->renderers.erase(renderer);
}

void vtkSVORenderPass::SetController(vtkMultiProcessController* controller)
{
  this->Impl->controller = controller;
}

vtkMultiProcessController* vtkSVORenderPass::GetController() const
{
  return this->Impl->controller;
}

bool vtkSVORenderPass::IsTraced(vtkProp* prop) const
{
  const svo::RendererState* current = this->Impl->current();
  return current && current->traces(prop);
}

std::string vtkSVORenderPass::GetReasonInLastFrame(vtkProp* prop) const
{
  for (const auto& [about, text] : this->Impl->reasons)
  {
    if (about == prop && prop)
    {
      return text;
    }
  }
  return std::string();
}

void vtkSVORenderPass::BeginAttachedFrame(vtkObject* caller, unsigned long, void*)
{
  const vtkSmartPointer<vtkSVORenderPass> alive(this);
  auto* renderer = static_cast<vtkRenderer*>(caller);
  if (svo::PassFrame* unfinished = this->Impl->frameOf(renderer))
  {
    this->FinishFrame(*unfinished); // somebody ended it without an event
  }
  if (renderer->GetSelector() || !this->Tracing)
  {
    return;
  }
  int width, height, left, bottom;
  renderer->GetTiledSizeAndOrigin(&width, &height, &left, &bottom);
  svo::PassFrame& frame = this->BeginFrame(renderer);
  frame.pass = this;
  const auto attached = this->Impl->attached.find(renderer);
  if (attached != this->Impl->attached.end() &&
    !renderer->GetCullers()->IsItemPresent(attached->second.culler)) // some hosts remove them all
  {
    renderer->AddCuller(attached->second.culler);
  }
  if (!this->CollectFrame(frame, width, height, nullptr))
  {
    this->FinishFrame(frame);
    return;
  }
  vtkMultiProcessController* controller = this->Impl->controller;
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    // Here, and not when something is drawn: a process that shows nothing may not draw at all.
    if (frame.settings.shadowTechnique == svo::ShadowTechnique::Buffer)
    {
      frame.state->shareShadows(controller, width, height, frame.pace.distance, frame.settings);
    }
    else if (this->ShadowTechnique == SHADOW_RAYS)
    {
      frame.state->shareCasters(
        controller, static_cast<std::size_t>(this->OctreeMemoryLimit) * svo::BytesOfKiB);
    }
  }
  const svo::CollectedScene& collected = frame.state->collected();
  if ((collected.rasterizedReceivers && frame.state->hasSomething()) || collected.shadowCatchers)
  {
    frame.shadowed = true;
    this->PreRender(&frame.receivers());
  }
}

void vtkSVORenderPass::EndAttachedFrame(vtkObject* caller, unsigned long, void*)
{
  const vtkSmartPointer<vtkSVORenderPass> alive(this);
  auto* renderer = static_cast<vtkRenderer*>(caller);
  svo::PassFrame* frame = this->Impl->frameOf(renderer);
  if (!frame)
  {
    return;
  }
  if (frame->shadowed)
  {
    this->PostRender(&frame->receivers());
  }
  this->FinishFrame(*frame);
  const auto attached = this->Impl->attached.find(renderer);
  if (attached != this->Impl->attached.end() && attached->second.leaving)
  {
    this->Detach(renderer);
  }
}
