// The steps of a frame: collected, decided on, traced, finished.
#include "vtkSVORenderPass.h"

#include "svoCameraView.h"
#include "svoFrameChoice.h"
#include "svoOwnCamera.h"
#include "svoPassInternals.h"
#include "svoSceneLights.h"

#include "vtkCommand.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"

#include <memory>
#include <string>

namespace
{
/// Of a step of lights that get more samples, between which users, or observers, are heard.
constexpr double StepSeconds = 0.5;
}

/// Fills a frame with the renderer's scene, as camera and lights are then, and sets up its camera.
/// Without one the renderer, to which the pass is attached, does that, and the lights. False if the
/// frame cannot be drawn.
bool vtkSVORenderPass::CollectFrame(
  svo::PassFrame& frame, int width, int height, const svo::OwnCamera* camera)
{
  const bool attached = !camera;
  Internals& impl = *this->Impl;
  // What is collected is borrowed, and who observes the progress of a build may change it. So all
  // is collected once more after that, when nothing is left to be built. Of the last collection
  // nobody is told, so that it ends even for those who change something every time.
  constexpr int MostCollections = 4;
  svo::FrameSettings asked;
  vtkRenderer* renderer = frame.renderer;
  frame.state->beginFrame();
  svo::PassStatistics& statistics = frame.state->statistics();
  statistics.imageReduction = this->ImageReductionFactor;
  bool disturbed = true;
  svo::FrameWishes wishes;
  wishes.prefersOpenGL = [&](bool rays, bool volumes)
  { return this->MayPreferOpenGL(frame, rays, volumes); };
  // As the last frame's scene says; this one's has the last word.
  bool planes = frame.state->collected().planes;
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
    store.wait = !this->BuildInBackground || !frame.interactive();
    const bool heard = this->HasObserver(vtkCommand::ProgressEvent) != 0;
    if (i < MostCollections && heard)
    {
      store.progress = [this, &disturbed](double amount)
      {
        disturbed = true;
        this->InvokeEvent(vtkCommand::ProgressEvent, &amount);
      };
    }
    store.aborted = frame.abort(i < MostCollections, heard, disturbed);
    store.complain = [&frame](const std::string& text) { frame.messages.push_back(text); };

    wishes.automatic = this->Backend == BACKEND_AUTO;
    wishes.openGL = this->Backend == BACKEND_OPENGL;
    wishes.severalProcesses = impl.severalProcesses();
    wishes.sampled = this->AmbientOcclusion || this->SkyLight ||
      (this->ShadowTechnique != SHADOW_NONE && svo::hasSoftLight(renderer));
    asked = svo::FrameSettings();
    this->Fill(asked);
    const svo::FrameChoice choice = svo::chooseFrame(asked, wishes, planes);
    statistics.openGL = choice.openGL;
    if (this->SkyLight && this->SkyFromEnvironment)
    {
      std::string why;
      asked.skyPicture = frame.state->skyPicture(why);
      frame.tellOnce(why.empty() ? "" : why + ": the sky has SkyColor and GroundColor.", impl.said);
    }
    svo::CollectSettings collect;
    collect.shadows = this->ShadowTechnique != SHADOW_NONE;
    collect.onlyMarked = attached;
    collect.unmarkedToo = this->ShadowsForEverything;
    collect.translucentShadows = this->TranslucentShadows;
    // Processes do not tell each other their casters' colours.
    collect.meanOpacity = impl.severalProcesses();
    collect.openGL = statistics.openGL;
    const std::string notMarked = this->GetText(TEXT_NOT_CHOSEN, nullptr);
    collect.notMarked = notMarked.c_str();
    collect.said = &impl.said;
    collect.translucentSurfaceText = this->GetText(TEXT_TRANSLUCENT_SURFACE, nullptr);
    collect.translucentText = this->GetText(TEXT_TRANSLUCENT, nullptr);
    collect.cutOutText = this->GetText(TEXT_CUT_OUT, nullptr);
    collect.lightWords = { [this](vtkLight* light) { return this->GetText(TEXT_HEADLIGHT, light); },
      [this](vtkLight* light) { return this->GetText(TEXT_LIGHT, light); } };
    collect.levels.frame = asked;
    svo::viewOfCamera(renderer, width, height, collect.levels.eye);
    frame.state->collect(impl.store, store, collect);
    disturbed = disturbed || !frame.canDraw();
    if (choice.hangsOnPlanes && i < MostCollections && planes != frame.state->collected().planes)
    {
      planes = !planes;
      disturbed = true;
    }
  }
  if (disturbed)
  {
    frame.reopen();
    return false;
  }
  renderer->GetRenderWindow()->MakeCurrent(); // pipelines may have had others drawn
  if (this->ShadowTechnique == SHADOW_VOLUMES && !statistics.openGL)
  {
    frame.tellOnce(svo::whyNoVolumes(wishes), impl.said);
  }
  const svo::CollectedScene& collected = frame.state->collected();
  const auto text = [this](bool wanted, int what)
  { return wanted ? this->GetText(what, nullptr) : std::string(); };
  const bool seen = this->ShadowIntensity > 0.0;
  const bool alone = seen && !impl.severalProcesses(); // else it does not know what others have
  // OpenGL has instances of what casts alone, which may be nothing.
  const bool meant = statistics.openGL ? collected.marked : !collected.scene.instances.empty();
  frame.tellOfShadows({ text(this->ShadowTechnique != SHADOW_NONE && !this->AmbientOcclusion &&
                            !this->SkyLight && (!attached || meant),
                          TEXT_ONLY_HEADLIGHTS),
                        text(alone, TEXT_NOTHING_CASTS), text(alone, TEXT_NOTHING_RECEIVES),
                        text(seen, TEXT_CLIPPED) },
    impl.said);
  frame.decide(asked,
    { this->AutoAdjustSampleDistances, this->MaximumImageSampleDistance,
      this->DetailCullingThreshold,
      frame.sampling == svo::Sampling::InSteps ? StepSeconds : impl.refining, this->LightError,
      frame.sampling != svo::Sampling::AtOnce || impl.idle.may(renderer->GetRenderWindow()) });
  return true;
}

/// Where the backend is chosen: whether it may be OpenGL for this window, and with rays to lights;
/// for `volumes`, which are its alone, however fast it is.
/// Several processes would have to agree on it.
bool vtkSVORenderPass::MayPreferOpenGL(svo::PassFrame& frame, bool rays, bool volumes)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(frame.renderer->GetRenderWindow());
  std::string complaint;
  const bool prefers = window && !this->Impl->severalProcesses() &&
    (volumes || this->PrefersOpenGL(window, rays, complaint));
  // Without those that were not asked for it takes maps.
  const bool missed = !complaint.empty() &&
    (this->ShadowTechnique == SHADOW_RAYS || this->AmbientOcclusion || this->SkyLight ||
      svo::hasSoftLight(frame.renderer));
  frame.tellOnce(missed ? "The CPU makes the picture: " + complaint : "", this->Impl->said);
  return prefers;
}

/// Whether samples of lights are missing that the frame takes in further steps.
bool vtkSVORenderPass::WantsSamples(const svo::PassFrame& frame) const
{
  return (frame.sampling == svo::Sampling::Begun || frame.sampling == svo::Sampling::InSteps) &&
    !frame.interactive() && !frame.state->refined(this->MaximumLightSamples, this->LightError);
}

/// Between two such steps: observers hear how many samples there are, may end that, and may do as
/// they like with the scene.
void vtkSVORenderPass::TellOfSamples(svo::PassFrame& frame)
{
  frame.lightNothingMore();
  this->Impl->statistics = frame.state->statistics();
  double amount = static_cast<double>(frame.state->samples()) / this->MaximumLightSamples;
  this->InvokeEvent(vtkCommand::ProgressEvent, &amount);
  const vtkSmartPointer<vtkRenderWindow> window = frame.renderer->GetRenderWindow();
  const bool aborted = !window || window->GetAbortRender() || window->CheckAbortStatus();
  frame.sampling = aborted ? svo::Sampling::Ended : svo::Sampling::InSteps;
}

/// Traces a frame and has its shadow maps ready for rasterised surfaces.
void vtkSVORenderPass::TraceFrame(svo::PassFrame& frame, int width, int height)
{
  Internals& impl = *this->Impl;
  frame.trace(width, height);
  if (frame.state->receivers().unlit())
  {
    frame.lightNothing();
    this->UpdateLights(frame.renderer);
  }
  frame.tellOnce(frame.state->complaint(), impl.said);
  frame.tellOnce(this->AntiAliasing && frame.state->drawnByOpenGL()
      ? "OpenGL makes this picture, and of AntiAliasing it does no more than to filter shadow "
        "maps: "
        "MultiSamples of the window smooth edges. SetBackendToCPU() has the CPU smooth them all."
      : "",
    impl.said);
  const std::string signature = frame.state->receivers().signature();
  if (signature != impl.shaderSignature)
  {
    impl.shaderSignature = signature;
    impl.shaderTime.Modified();
  }
}

/// Ends a frame, whether or not it was drawn; the caller holds the pass.
void vtkSVORenderPass::FinishFrame(svo::PassFrame& frame)
{
  Internals& impl = *this->Impl;
  const std::unique_ptr<svo::PassFrame> done = impl.frames.end(frame);
  if (frame.traced && frame.canDraw())
  {
    frame.state->receivers().deactivate();
  }
  frame.state->finish();
  frame.lightNothingMore();
  impl.statistics = frame.state->statistics();
  if (frame.renderer->GetRenderWindow() && !frame.interactive() &&
    !frame.state->refined(this->MaximumLightSamples, this->LightError))
  {
    impl.idle.ask(frame.renderer->GetRenderWindow(), [this] { this->RefineFor(StepSeconds); });
  }
  const svo::FrameStatistics& tracer = impl.statistics.tracer;
  const bool traced = tracer.retracedLayers > 0 || tracer.samplingTime > 0.0;
  if (traced && !impl.statistics.openGL) // which knows no pace
  {
    double seconds, fixedSeconds, shadowSeconds;
    this->MeasureFrame(seconds, fixedSeconds, shadowSeconds);
    frame.state->measured(seconds, fixedSeconds, shadowSeconds);
  }
  const std::size_t beyond =
    impl.store.endFrame(static_cast<std::size_t>(this->OctreeMemoryLimit) * svo::BytesOfKiB);
  if (beyond > 0 && impl.said.insert("OctreeMemoryLimit").second)
  {
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
