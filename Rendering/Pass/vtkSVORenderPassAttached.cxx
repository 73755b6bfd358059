// Frames of renderers that the pass is attached to, but not set on.
#include "vtkSVORenderPass.h"

#include "svoPassInternals.h"
#include "svoPropPasses.h"

#include "vtkCommand.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <memory>
#include <string>

void vtkSVORenderPass::Attach(vtkRenderer* renderer)
{
  Internals& impl = *this->Impl;
  if (!renderer)
  {
    return;
  }
  std::unique_ptr<svo::AttachedRenderer>& attached = impl.attached[renderer];
  if (attached && attached->renderer())
  {
    attached->leaving = false;
    return;
  }
  vtkSVOPresenter* presenter = impl.frames.stateOf(renderer)->presenter();
  attached = std::make_unique<svo::AttachedRenderer>(renderer, impl.attachedEvents, presenter,
    [&impl, renderer](vtkProp* prop)
    {
      const svo::PassFrame* frame = impl.frames.of(renderer);
      return frame && frame->state->traces(prop);
    });
  presenter->SetPrepare(
    [this, renderer](int width, int height)
    {
      svo::PassFrame* frame = this->Impl->frames.of(renderer);
      if (frame && !(frame->traced && frame->state->shows(width, height)))
      {
        this->TraceFrame(*frame, width, height);
        if (frame->shadowed)
        {
          frame->state->findLight(frame->receivers());
        }
        frame->state->present(this);
      }
    });
}

void vtkSVORenderPass::Detach(vtkRenderer* renderer)
{
  Internals& impl = *this->Impl;
  const auto found = impl.attached.find(renderer);
  if (found == impl.attached.end())
  {
    return;
  }
  if (impl.frames.of(renderer))
  {
    found->second->leaving = true; // VTK is about to draw the presenter, and others ask the pass
    return;
  }
  const bool alive = found->second->renderer();
  impl.attached.erase(found);
  if (alive && renderer->GetRenderWindow())
  {
    impl.frames.stateOf(renderer)->releaseGraphicsResources(renderer->GetRenderWindow());
  }
  impl.frames.forget(renderer);
  // What is told of the last frame is about none that is seen any more.
  impl.statistics = svo::PassStatistics();
}

bool vtkSVORenderPass::IsTraced(vtkProp* prop) const
{
  const svo::RendererState* current = this->Impl->frames.current();
  return current && current->traces(prop);
}

/// A frame of an attached renderer begins or ends, or the renderer itself ends.
void vtkSVORenderPass::HearAttached(vtkRenderer* renderer, unsigned long event)
{
  const vtkSmartPointer<vtkSVORenderPass> alive(this);
  if (svo::PassFrame* frame = this->Impl->frames.of(renderer)) // or one that ended without an event
  {
    if (frame->shadowed && event == vtkCommand::EndEvent)
    {
      svo::dropPass(&frame->receivers(), this);
    }
    this->FinishFrame(*frame);
  }
  const auto attached = this->Impl->attached.find(renderer);
  if (attached == this->Impl->attached.end())
  {
    return;
  }
  if (event == vtkCommand::StartEvent)
  {
    this->BeginAttachedFrame(*attached->second);
  }
  else if (event == vtkCommand::DeleteEvent)
  {
    attached->second->forget();
    this->Impl->attached.erase(attached);
    this->Impl->frames.forget(renderer);
  }
  else if (attached->second->leaving)
  {
    this->Detach(renderer);
  }
}

void vtkSVORenderPass::BeginAttachedFrame(svo::AttachedRenderer& attached)
{
  vtkRenderer* renderer = attached.renderer();
  if (renderer->GetSelector() || !this->Tracing)
  {
    return;
  }
  int width, height, left, bottom;
  renderer->GetTiledSizeAndOrigin(&width, &height, &left, &bottom);
  svo::PassFrame& frame = this->Impl->frames.begin(renderer);
  frame.pass = this;
  attached.addCuller();
  if (!this->CollectFrame(frame, width, height, nullptr))
  {
    this->FinishFrame(frame);
    return;
  }
  if (this->Impl->severalProcesses())
  {
    // Here, and not when something is drawn: a process that shows nothing may not draw at all.
    frame.state->share(this->Impl->controller, width, height, frame.pace.distance, frame.settings,
      static_cast<std::size_t>(this->OctreeMemoryLimit) * svo::BytesOfKiB);
  }
  const svo::CollectedScene& collected = frame.state->collected();
  if ((collected.rasterizedReceivers && frame.state->hasSomething()) || collected.shadowCatchers)
  {
    frame.shadowed = true;
    svo::carryPass(&frame.receivers(), this);
  }
}
