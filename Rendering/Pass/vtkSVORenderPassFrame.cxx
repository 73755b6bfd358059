// The steps of a frame: collected, decided on, traced, finished.
#include "vtkSVORenderPass.h"

#include "svoCameraView.h"
#include "svoOwnCamera.h"
#include "svoPassInternals.h"

#include "vtkCommand.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <string>

namespace
{
/// From this rate on VTK asks for interaction rather than for a picture to keep.
constexpr double InteractiveRate = 1.0; // Hz

/// Share of an interactive frame's time that is the pass's; the rest is for what else is drawn.
constexpr double OwnShare = 0.5;

bool isInteractive(vtkRenderer* renderer)
{
  return renderer->GetRenderWindow()->GetDesiredUpdateRate() >= InteractiveRate;
}

/// True if a light moves with the camera, so that nothing seen from it outlives a frame.
bool hasCameraLight(vtkRenderer* renderer)
{
  vtkCollectionSimpleIterator iterator;
  vtkLightCollection* lights = renderer->GetLights();
  lights->InitTraversal(iterator);
  while (vtkLight* light = lights->GetNextLight(iterator))
  {
    if (light->GetSwitch() && light->LightTypeIsCameraLight())
    {
      return true;
    }
  }
  return false;
}
}

svo::PassFrame& vtkSVORenderPass::BeginFrame(vtkRenderer* renderer)
{
  Internals& impl = *this->Impl;
  impl.frames.push_back(std::make_unique<svo::PassFrame>(impl.stateOf(renderer), renderer));
  return *impl.frames.back();
}

/// Fills a frame with the renderer's scene, as camera and lights are then, and sets up its camera.
/// Without one the renderer, to which the pass is attached, does that, and the lights. False if the
/// frame cannot be drawn.
bool vtkSVORenderPass::CollectFrame(
  svo::PassFrame& frame, int width, int height, const svo::OwnCamera* camera)
{
  const bool attached = !camera;
  Internals& impl = *this->Impl;
  const bool severalProcesses = impl.controller && impl.controller->GetNumberOfProcesses() > 1;
  // What is collected is borrowed, and who observes the progress of a build may change it. So all
  // is collected once more after that, when nothing is left to be built. Of the last collection
  // nobody is told, so that it ends even for those who change something every time.
  constexpr int MostCollections = 4;
  const bool openGL = this->GetActiveBackend() == BACKEND_OPENGL;
  vtkRenderer* renderer = frame.renderer;
  frame.state->beginFrame();
  bool disturbed = true;
  for (int i = 1; disturbed && i <= MostCollections; ++i)
  {
    if (!frame.reopen())
    {
      return false;
    }
    disturbed = false;
    renderer->GetRenderWindow()->MakeCurrent();
    if (camera)
    {
      camera->setUp();
    }
    this->UpdateLightGeometry(renderer);
    if (!attached)
    {
      this->UpdateLights(renderer);
    }

    svo::StoreOptions store;
    store.convert = this->ConvertPolyData;
    store.level = this->MaximumLevel;
    store.leafGeometry = static_cast<svo::LeafGeometry>(this->LeafGeometry);
    store.wait = !this->BuildInBackground || !isInteractive(renderer);
    if (i < MostCollections && this->HasObserver(vtkCommand::ProgressEvent))
    {
      store.progress = [this, &disturbed](double amount)
      {
        disturbed = true;
        this->InvokeEvent(vtkCommand::ProgressEvent, &amount);
      };
    }
    store.aborted = this->AbortOf(renderer->GetRenderWindow(), i < MostCollections, disturbed);
    store.complain = [&frame](const std::string& text) { frame.messages.push_back(text); };

    svo::CollectSettings collect;
    collect.shadows = this->ShadowTechnique != SHADOW_NONE;
    collect.onlyMarked = attached;
    collect.unmarkedToo = this->ShadowsForEverything;
    collect.translucentShadows = this->TranslucentShadows;
    // Neither what processes tell each other of their casters nor shaders know colours.
    collect.meanOpacity = severalProcesses || openGL;
    collect.onlyCast = openGL;
    const std::string notMarked = this->GetText(TEXT_NOT_CHOSEN, nullptr);
    collect.notMarked = notMarked.c_str();
    collect.said = &impl.said;
    collect.translucentSurfaceText = this->GetText(TEXT_TRANSLUCENT_SURFACE, nullptr);
    collect.translucentText = this->GetText(TEXT_TRANSLUCENT, nullptr);
    collect.cutOutText = this->GetText(TEXT_CUT_OUT, nullptr);
    collect.lightWords = { [this](vtkLight* light) { return this->GetText(TEXT_HEADLIGHT, light); },
      [this](vtkLight* light) { return this->GetText(TEXT_LIGHT, light); } };
    this->Fill(collect.levels.frame);
    collect.levels.frame.lightCode =
      openGL && collect.levels.frame.shadowTechnique == svo::ShadowTechnique::Rays;
    svo::viewOfCamera(renderer, width, height, collect.levels.eye);
    frame.state->collect(impl.store, store, collect);
    disturbed = disturbed || !frame.canDraw();
  }
  if (disturbed)
  {
    frame.reopen();
    return false;
  }
  renderer->GetRenderWindow()->MakeCurrent(); // pipelines may have had others drawn
  const svo::CollectedScene& collected = frame.state->collected();
  impl.castingLights = collected.lightsText;
  if (collected.headlightOnly && !impl.saidHeadlight && this->ShadowTechnique != SHADOW_NONE &&
    (!attached || !collected.scene.instances.empty()))
  {
    impl.saidHeadlight = true;
    frame.messages.push_back(this->GetText(TEXT_ONLY_HEADLIGHTS, nullptr));
  }
  const auto miss = [&](const std::string& why, int text)
  {
    // A process does not know what others have. What has been said of this frame was why.
    if (why.empty() || this->ShadowIntensity <= 0.0 || severalProcesses ||
      !impl.said.insert(why).second || !frame.messages.empty())
    {
      return;
    }
    const std::string start = this->GetText(text, nullptr);
    const std::string of = collected.withoutShadows == 1
      ? "The only object "
      : "Each of " + std::to_string(collected.withoutShadows) + " objects ";
    frame.messages.push_back(start.empty() ? start : start + of + why + ".");
  };
  miss(collected.nothingCasts, TEXT_NOTHING_CASTS);
  miss(collected.nothingReceives, TEXT_NOTHING_RECEIVES);
  const auto sayOnce = [&](const std::string& text)
  {
    if (impl.said.insert(text).second)
    {
      frame.messages.push_back(text);
    }
  };
  if (collected.clippedCastNone && collected.nothingCasts.empty() && this->ShadowIntensity > 0.0)
  {
    sayOnce(this->GetText(TEXT_CLIPPED, nullptr));
  }
  if (collected.aimlessLight)
  {
    sayOnce(
      "A light has no direction, so it lights nothing and casts no shadow: its position is its "
      "focal point, or one of them is not finite.");
  }
  this->DecideSettings(frame);
  return true;
}

/// Whether a window's frame is to wait for no more builds. Its observers are asked only with `ask`.
std::function<bool()> vtkSVORenderPass::AbortOf(vtkRenderWindow* window, bool ask, bool& disturbed)
{
  const bool observed = ask && window->HasObserver(vtkCommand::AbortCheckEvent);
  if (!observed && !this->HasObserver(vtkCommand::ProgressEvent))
  {
    return nullptr; // there is nobody who could say so
  }
  return [window = vtkSmartPointer<vtkRenderWindow>(window), observed, &disturbed]
  {
    if (observed && !window->GetAbortRender())
    {
      disturbed = true;
      window->CheckAbortStatus();
    }
    return window->GetAbortRender() != 0;
  };
}

void vtkSVORenderPass::Fill(svo::TracerSettings& settings) const
{
  this->Superclass::Fill(settings);
  if (this->ShadowTechnique == SHADOW_AUTOMATIC)
  {
    settings.shadowTechnique = this->GetActiveBackend() == BACKEND_OPENGL
      ? svo::ShadowTechnique::Rays
      : svo::ShadowTechnique::Buffer;
  }
}

/// Says how a frame is to be traced.
void vtkSVORenderPass::DecideSettings(svo::PassFrame& frame)
{
  svo::FrameSettings& settings = frame.settings;
  settings = svo::FrameSettings();
  this->Fill(settings);
  settings.lightCode = this->GetActiveBackend() == BACKEND_OPENGL &&
    settings.shadowTechnique == svo::ShadowTechnique::Rays;
  vtkRenderer* renderer = frame.renderer;
  frame.pacedShadows = hasCameraLight(renderer);
  if (this->AutoAdjustSampleDistances && isInteractive(renderer))
  {
    frame.pace =
      frame.state->choosePace(OwnShare / renderer->GetRenderWindow()->GetDesiredUpdateRate(),
        std::max(this->MaximumImageSampleDistance / this->ImageReductionFactor, 1.0));
    if (frame.pacedShadows)
    {
      settings.shadowCoarseness = frame.pace.coarseness;
    }
    else
    {
      frame.pace.coarseness = 1.0;
    }
  }
  if (isInteractive(renderer))
  {
    const double distance = frame.pace.distance * this->ImageReductionFactor;
    settings.detailThreshold = this->DetailCullingThreshold / (distance * distance);
  }
}

/// Traces a frame and has its shadow maps ready for rasterised surfaces.
void vtkSVORenderPass::TraceFrame(svo::PassFrame& frame, int width, int height)
{
  Internals& impl = *this->Impl;
  frame.traced = true;
  frame.state->trace(width, height, frame.pace, frame.settings);
  const std::string& complaint = frame.state->complaint();
  if (!complaint.empty() && impl.said.insert(complaint).second)
  {
    frame.messages.push_back(complaint);
  }
  svo::ShadowReceivers& receivers = frame.state->receivers();
  const std::string signature = receivers.signature();
  if (signature != impl.shaderSignature)
  {
    impl.shaderSignature = signature;
    impl.shaderTime.Modified();
  }
  receivers.activate();
}

/// Ends a frame, whether or not it was drawn; the caller holds the pass.
void vtkSVORenderPass::FinishFrame(svo::PassFrame& frame)
{
  Internals& impl = *this->Impl;
  const auto entry = std::find_if(impl.frames.begin(), impl.frames.end(),
    [&frame](const auto& other) { return other.get() == &frame; });
  const std::unique_ptr<svo::PassFrame> done = std::move(*entry);
  impl.frames.erase(entry);
  if (frame.traced && frame.canDraw())
  {
    frame.state->receivers().deactivate();
  }
  impl.reasons = frame.state->collected().reasons;
  frame.state->finish();
  impl.statistics = frame.state->statistics();
  impl.statistics.imageReduction = this->ImageReductionFactor;
  impl.statistics.pacedShadows = frame.pacedShadows;
  if (impl.statistics.tracer.retracedLayers > 0)
  {
    double seconds, fixedSeconds, shadowSeconds;
    this->MeasureFrame(seconds, fixedSeconds, shadowSeconds);
    frame.state->measured(seconds, fixedSeconds, shadowSeconds);
  }
  const std::size_t beyond =
    impl.store.endFrame(static_cast<std::size_t>(this->OctreeMemoryLimit) * svo::BytesOfKiB);
  if (beyond > 0 && !impl.saidMemory)
  {
    impl.saidMemory = true;
    frame.messages.push_back("The octrees of a single frame take " +
      std::to_string(this->GetOctreeMemorySize()) + " KiB, more than the OctreeMemoryLimit of " +
      std::to_string(this->OctreeMemoryLimit) + " KiB; they are kept as long as they are shown.");
  }
  if (impl.releaseAsked)
  {
    this->ReleaseOctrees();
  }
  for (const std::string& message : frame.messages)
  {
    if (!message.empty())
    {
      vtkWarningMacro(<< message);
    }
  }
}
