// Frames of renderers that the pass is attached to, but not set on.
#include "vtkSVORenderPass.h"

#include "svoPassInternals.h"

#include "vtkCommand.h"
#include "vtkPropCollection.h"
#include "vtkRenderState.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

namespace
{
/// Hosts that spread a frame over several processes do so in the same events, before us.
constexpr float AfterHosts = -1.0f;
}

void vtkSVORenderPass::Attach(vtkRenderer* renderer)
{
  if (!renderer || this->Impl->attached.count(renderer))
  {
    return;
  }
  svo::AttachedRenderer& attached = this->Impl->attached[renderer];
  attached.renderer = renderer;
  attached.observers = { renderer->AddObserver(vtkCommand::StartEvent, this,
                           &vtkSVORenderPass::BeginAttachedFrame, AfterHosts),
    renderer->AddObserver(
      vtkCommand::EndEvent, this, &vtkSVORenderPass::EndAttachedFrame, AfterHosts) };

  vtkSVOPresenter* presenter = this->Impl->of(renderer).presenter();
  presenter->SetPrepare(
    [this](int width, int height)
    {
      Internals& impl = *this->Impl;
      if (impl.current && !impl.traced)
      {
        impl.traced = true;
        this->TraceFrame(width, height);
        impl.current->present(this);
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
  const auto found = this->Impl->attached.find(renderer);
  if (found == this->Impl->attached.end())
  {
    return;
  }
  if (found->second.renderer)
  {
    for (unsigned long observer : found->second.observers)
    {
      renderer->RemoveObserver(observer);
    }
    vtkSVOPresenter* presenter = this->Impl->of(renderer).presenter();
    presenter->SetPrepare(nullptr);
    renderer->RemoveViewProp(presenter);
    if (renderer->GetRenderWindow())
    {
      this->Impl->of(renderer).releaseGraphicsResources(renderer->GetRenderWindow());
    }
  }
  this->Impl->attached.erase(found);
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
  const Internals& impl = *this->Impl;
  return impl.current && impl.current->collected().replaced.count(prop) > 0;
}

void vtkSVORenderPass::BeginAttachedFrame(vtkObject* caller, unsigned long, void*)
{
  auto* renderer = static_cast<vtkRenderer*>(caller);
  if (renderer->GetSelector() || !this->Tracing)
  {
    return;
  }
  // The lights' places are those of this frame's camera.
  this->UpdateLightGeometry(renderer);
  int width, height, left, bottom;
  renderer->GetTiledSizeAndOrigin(&width, &height, &left, &bottom);
  this->CollectFrame(renderer, width, height, true);
  vtkMultiProcessController* controller = this->Impl->controller;
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    // Here, and not when something is drawn: a process that shows nothing may not draw at all.
    if (this->ShadowTechnique == SHADOW_BUFFER)
    {
      this->Impl->current->shareShadows(controller, this->Impl->settings);
    }
    else if (this->ShadowTechnique == SHADOW_RAYS)
    {
      this->Impl->current->shareCasters(
        controller, static_cast<std::size_t>(this->OctreeMemoryLimit) * 1024);
    }
  }
  this->Impl->traced = false;

  svo::AttachedRenderer& attached = this->Impl->attached[renderer];
  attached.props.clear();
  const svo::CollectedScene& collected = this->Impl->current->collected();
  if (collected.rasterizedReceivers && this->Impl->current->hasSomething())
  {
    vtkCollectionSimpleIterator iterator;
    vtkPropCollection* props = renderer->GetViewProps();
    props->InitTraversal(iterator);
    while (vtkProp* prop = props->GetNextProp(iterator))
    {
      attached.props.push_back(prop);
    }
    vtkRenderState state(renderer);
    state.SetPropArrayAndCount(attached.props.data(), static_cast<int>(attached.props.size()));
    this->PreRender(&state);
  }
}

void vtkSVORenderPass::EndAttachedFrame(vtkObject* caller, unsigned long, void*)
{
  auto* renderer = static_cast<vtkRenderer*>(caller);
  if (!this->Impl->current)
  {
    return;
  }
  svo::AttachedRenderer& attached = this->Impl->attached[renderer];
  if (!attached.props.empty())
  {
    vtkRenderState state(renderer);
    state.SetPropArrayAndCount(attached.props.data(), static_cast<int>(attached.props.size()));
    this->PostRender(&state);
    attached.props.clear();
  }
  this->FinishFrame();
}
