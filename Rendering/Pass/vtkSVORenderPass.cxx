#include "vtkSVORenderPass.h"

#include "svoCameraView.h"
#include "svoOwnCamera.h"
#include "svoPassInternals.h"

#include "vtkCommand.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkRenderState.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSVORenderPass);

vtkSVORenderPass::vtkSVORenderPass()
  : Impl(new Internals(*this))
{
}

vtkSVORenderPass::~vtkSVORenderPass()
{
  while (!this->Impl->attached.empty())
  {
    this->Detach(this->Impl->attached.begin()->first);
  }
}

void vtkSVORenderPass::SetBackend(int backend)
{
  const int clamped = backend < BACKEND_AUTO
    ? static_cast<int>(BACKEND_AUTO)
    : (backend > BACKEND_OPENGL ? BACKEND_OPENGL : backend);
  if (clamped == BACKEND_OPENGL && !this->Impl->saidOpenGL)
  {
    this->Impl->saidOpenGL = true;
    vtkWarningMacro("The OpenGL backend is not part of this version; rays are traced on the CPU.");
  }
  if (this->Backend != clamped)
  {
    this->Backend = clamped;
    this->Modified();
  }
}

void vtkSVORenderPass::SetNumber(
  const char* name, double value, double least, double most, double& setting)
{
  if (std::isnan(value))
  {
    vtkWarningMacro(<< name << " stays " << setting << ": the value given is not a number.");
    return;
  }
  value = std::min(std::max(value, least), most);
  if (setting != value)
  {
    setting = value;
    this->Modified();
  }
}

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

svo::FrameSettings vtkSVORenderPass::Internals::settingsOf(const vtkSVORenderPass& pass)
{
  svo::FrameSettings settings;
  settings.shadowTechnique = static_cast<svo::ShadowTechnique>(pass.ShadowTechnique);
  settings.shadowResolution = pass.ShadowBufferResolution;
  settings.automaticBias = pass.AutomaticShadowBias;
  settings.bias = pass.ShadowBias;
  settings.shadowIntensity = pass.ShadowIntensity;
  settings.pixelError = pass.PixelError;
  settings.frameCoherence = pass.FrameCoherence;
  settings.layerMemoryLimit = static_cast<std::size_t>(pass.LayerMemoryLimit) * svo::BytesOfKiB;
  settings.antiAliasing = pass.AntiAliasing;
  settings.filterShadows = pass.AntiAliasing;
  return settings;
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
  // What is collected is borrowed, and who observes the progress of a build may change it. So all
  // is collected once more after that, when nothing is left to be built. Of the last collection
  // nobody is told, so that it ends even for those who change something every time.
  constexpr int MostCollections = 4;
  Internals& impl = *this->Impl;
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
    collect.said = &impl.said;
    collect.translucentSurfaceText = this->GetText(TEXT_TRANSLUCENT_SURFACE, nullptr);
    collect.translucentText = this->GetText(TEXT_TRANSLUCENT, nullptr);
    collect.cutOutText = this->GetText(TEXT_CUT_OUT, nullptr);
    collect.nameOfHeadlight = [this](vtkLight* light)
    { return this->GetText(TEXT_HEADLIGHT, light); };
    collect.levels.frame = Internals::settingsOf(*this);
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

/// Says how a frame is to be traced.
void vtkSVORenderPass::DecideSettings(svo::PassFrame& frame)
{
  svo::FrameSettings& settings = frame.settings;
  settings = Internals::settingsOf(*this);
  vtkRenderer* renderer = frame.renderer;
  if (this->AutoAdjustSampleDistances && isInteractive(renderer))
  {
    frame.sampleDistance =
      frame.state->chooseDistance(OwnShare / renderer->GetRenderWindow()->GetDesiredUpdateRate(),
        std::max(this->MaximumImageSampleDistance / this->ImageReductionFactor, 1.0));
    if (hasCameraLight(renderer))
    {
      settings.shadowResolution =
        std::max(static_cast<int>(settings.shadowResolution / frame.sampleDistance), 16);
    }
  }
}

/// Traces a frame and has its shadow maps ready for rasterised surfaces.
void vtkSVORenderPass::TraceFrame(svo::PassFrame& frame, int width, int height)
{
  Internals& impl = *this->Impl;
  frame.traced = true;
  frame.state->trace(width, height, frame.sampleDistance, frame.settings);
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
  frame.state->finish();
  impl.statistics = frame.state->statistics();
  impl.statistics.imageReduction = this->ImageReductionFactor;
  if (impl.statistics.tracer.retracedLayers > 0)
  {
    double seconds, fixedSeconds;
    this->MeasureFrame(seconds, fixedSeconds);
    frame.state->measured(seconds, fixedSeconds);
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

std::unique_ptr<svo::Tracer> vtkSVORenderPass::MakeTracer() const
{
  return svo::makeCPUTracer();
}

std::string vtkSVORenderPass::GetText(int text, vtkLight*) const
{
  switch (text)
  {
    case TEXT_HEADLIGHT:
      return "headlight";
    case TEXT_ONLY_HEADLIGHTS:
      return "No shadows: the only light is a headlight, which casts none that can be seen. "
             "Add a vtkLight with SetLightTypeToSceneLight().";
    case TEXT_TRANSLUCENT_SURFACE:
      return "A surface casts no shadow because its opacity makes it translucent. "
             "SetCastShadow(true, prop) has it cast, false makes it cast none in silence.";
    case TEXT_TRANSLUCENT:
      return "A surface, or some cells of it, cast no shadow because colours or texture make them "
             "translucent. SetCastShadow(true, prop) has all of it cast, false none and in "
             "silence.";
    case TEXT_CUT_OUT:
      return "A surface casts the shadow of its whole cells although its texture hides parts of "
             "them. SetCastShadow(true, prop) says that this is meant, false takes the shadow "
             "away.";
    default:
      return std::string();
  }
}

void vtkSVORenderPass::ReleaseOctrees()
{
  Internals& impl = *this->Impl;
  impl.releaseAsked = !impl.frames.empty(); // by an observer of a frame, which needs them
  if (impl.releaseAsked)
  {
    return;
  }
  impl.store.release();
  for (auto& entry : impl.renderers)
  {
    entry.second->releaseLayers();
  }
}

void vtkSVORenderPass::MeasureFrame(double& seconds, double& fixedSeconds) const
{
  const svo::PassStatistics& frame = this->Impl->statistics;
  // What was waited for to be built will not be built again.
  fixedSeconds = frame.octreesBuilt > 0 ? 0.0 : frame.collectTime;
  seconds = fixedSeconds + frame.tracer.traceTime + frame.tracer.shadowTime + frame.presentTime;
}

void vtkSVORenderPass::Render(const vtkRenderState* state)
{
  const vtkSmartPointer<vtkSVORenderPass> alive(this); // whatever observers do
  vtkRenderer* renderer = state->GetRenderer();
  this->NumberOfRenderedProps = 0;
  const svo::OwnCamera camera(state, this);
  if (renderer->GetSelector() || this->Impl->frameOf(renderer))
  {
    renderer->GetRenderWindow()->MakeCurrent();
    camera.setUp();
    this->UpdateLightGeometry(renderer);
    this->UpdateLights(renderer);
    this->UpdateGeometry(renderer, state->GetFrameBuffer());
    this->NumberOfRenderedProps = renderer->GetNumberOfPropsRendered();
    return;
  }

  int width, height;
  svo::sizeOf(state, width, height);
  svo::PassFrame& frame = this->BeginFrame(renderer);
  if (!this->CollectFrame(frame, width, height, &camera))
  {
    this->FinishFrame(frame);
    return;
  }
  frame.state->joinPasses(state);
  this->TraceFrame(frame, width, height);
  {
    svo::ExchangedProps props(state->GetPropArray());
    frame.state->exchange(props, state, this);
    const bool receiving = !frame.state->receivers().empty();
    if (receiving)
    {
      this->PreRender(state);
    }
    this->UpdateGeometry(renderer, state->GetFrameBuffer());
    if (receiving)
    {
      this->PostRender(state);
    }
  }
  frame.state->presenter()->StandFor(nullptr);
  this->FinishFrame(frame);
  this->NumberOfRenderedProps = renderer->GetNumberOfPropsRendered();
}

void vtkSVORenderPass::ReleaseGraphicsResources(vtkWindow* window)
{
  if (window)
  {
    this->Superclass::ReleaseGraphicsResources(window);
  }
  for (auto& entry : this->Impl->renderers)
  {
    entry.second->releaseGraphicsResources(window);
  }
}

bool vtkSVORenderPass::PreReplaceShaderValues(
  std::string&, std::string&, std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp*)
{
  if (vtkOpenGLPolyDataMapper::SafeDownCast(mapper))
  {
    svo::ShadowReceivers::markShader(fragmentShader);
  }
  return true;
}

bool vtkSVORenderPass::PostReplaceShaderValues(std::string& vertexShader,
  std::string& geometryShader, std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp*)
{
  svo::RendererState* current = this->Impl->current();
  if (current && vtkOpenGLPolyDataMapper::SafeDownCast(mapper))
  {
    current->receivers().completeShader(vertexShader, geometryShader, fragmentShader);
  }
  return true;
}

bool vtkSVORenderPass::SetShaderParameters(
  vtkShaderProgram* program, vtkAbstractMapper*, vtkProp* prop, vtkOpenGLVertexArrayObject*)
{
  if (svo::RendererState* current = this->Impl->current())
  {
    current->receivers().setUniforms(program, GetReceiveShadow(prop));
  }
  return true;
}

vtkMTimeType vtkSVORenderPass::GetShaderStageMTime()
{
  return this->Impl->shaderTime.GetMTime();
}

void vtkSVORenderPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Backend: " << this->Backend << '\n'
     << indent << "ActiveBackend: " << this->GetActiveBackend() << '\n'
     << indent << "ShadowTechnique: " << this->ShadowTechnique << '\n'
     << indent << "ShadowBufferResolution: " << this->ShadowBufferResolution << " texels\n"
     << indent << "AutomaticShadowBias: " << this->AutomaticShadowBias << '\n'
     << indent << "ShadowBias: " << this->ShadowBias << " voxels\n"
     << indent << "ShadowIntensity: " << this->ShadowIntensity << '\n'
     << indent << "PixelError: " << this->PixelError << " pixels\n"
     << indent << "ConvertPolyData: " << this->ConvertPolyData << '\n'
     << indent << "MaximumLevel: " << this->MaximumLevel << '\n'
     << indent << "LeafGeometry: " << this->LeafGeometry << '\n'
     << indent << "OctreeMemoryLimit: " << this->OctreeMemoryLimit << " KiB\n"
     << indent << "BuildInBackground: " << this->BuildInBackground << '\n'
     << indent << "FrameCoherence: " << this->FrameCoherence << '\n'
     << indent << "LayerMemoryLimit: " << this->LayerMemoryLimit << " KiB\n"
     << indent << "AntiAliasing: " << this->AntiAliasing << '\n'
     << indent << "AutoAdjustSampleDistances: " << this->AutoAdjustSampleDistances << '\n'
     << indent << "MaximumImageSampleDistance: " << this->MaximumImageSampleDistance << " pixels\n"
     << indent << "ImageReductionFactor: " << this->ImageReductionFactor << '\n'
     << indent << "ImageSampleDistance: " << this->GetImageSampleDistance() << " pixels\n"
     << indent << "AcceptedPixelError: " << this->GetAcceptedPixelError() << " pixels\n"
     << indent << "CastingLights:\n"
     << this->GetCastingLights() << indent << "Controller: " << this->GetController() << '\n'
     << indent << "Tracing: " << this->Tracing << '\n'
     << indent << "CollectTime: " << this->GetCollectTime() << " s\n"
     << indent << "TraceTime: " << this->GetTraceTime() << " s\n"
     << indent << "ShadowTime: " << this->GetShadowTime() << " s\n"
     << indent << "PresentTime: " << this->GetPresentTime() << " s\n"
     << indent << "NumberOfPrimaryRays: " << this->GetNumberOfPrimaryRays() << '\n'
     << indent << "NumberOfShadowRays: " << this->GetNumberOfShadowRays() << '\n'
     << indent << "NumberOfRetracedLayers: " << this->GetNumberOfRetracedLayers() << '\n'
     << indent << "NumberOfTracedActors: " << this->GetNumberOfTracedActors() << '\n'
     << indent << "NumberOfRasterizedActors: " << this->GetNumberOfRasterizedActors() << '\n'
     << indent << "NumberOfInstances: " << this->GetNumberOfInstances() << '\n'
     << indent << "NumberOfOctreesBuilt: " << this->GetNumberOfOctreesBuilt() << '\n'
     << indent << "NumberOfOctreesInProgress: " << this->GetNumberOfOctreesInProgress() << '\n'
     << indent << "LayerMemorySize: " << this->GetLayerMemorySize() << " KiB\n"
     << indent << "OctreeMemorySize: " << this->GetOctreeMemorySize() << " KiB\n";
}
