#include "svoRendererState.h"

#include "svoCameraView.h"
#include "svoControllerProcesses.h"
#include "svoFrameCopy.h"
#include "svoSMPParallel.h"
#include "svoSilhouettes.h"

#include "vtkCameraPass.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLRenderer.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace svo
{
namespace
{
/// From this width on, pixels, what blurs a shadow is complained about.
constexpr double CoarseShadow = 32.0;

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
}

RendererState::RendererState(vtkRenderer* renderer, std::unique_ptr<Tracer> tracer)
  : Renderer(renderer)
  , Trace(std::move(tracer))
{
  this->Presenter->SetLeave(
    [this]
    {
      this->Receivers.release();
      this->Maps.release();
      this->Mask.release();
      this->Sampled.release();
      this->Boxes.release();
      this->Trace->releaseGraphicsResources();
    });
}

RendererState::~RendererState()
{
  this->Presenter->SetLeave(nullptr); // renderers may hold it for longer
  if (this->Window)
  {
    this->Window->forget(this);
  }
}

FramePace RendererState::choosePace(double budget, double maximum)
{
  return this->Distance.choose(
    budget, maximum, this->Window ? this->Window->others(this) : FrameCost());
}

void RendererState::measured(double seconds, double fixed, double shadows)
{
  this->Distance.measured(this->Statistics.pace, seconds, fixed, shadows);
  const std::shared_ptr<WindowTime> window = WindowTime::of(this->Renderer->GetRenderWindow());
  if (this->Window && this->Window != window)
  {
    this->Window->forget(this);
  }
  this->Window = window;
  this->Window->measured(this, this->Distance.cost());
}

void RendererState::beginFrame()
{
  this->Statistics = PassStatistics();
  this->Collected.current = false;
  this->InFrame = true;
  this->HasPicture = false;
  this->Complaint.clear();
  this->SharesShadows = false;
}

void RendererState::collect(
  OctreeStore& store, const StoreOptions& options, CollectSettings settings)
{
  settings.levels.tracer = this->Trace.get();
  const double start = vtkTimerLog::GetUniversalTime();
  const int built = store.built();
  this->Collector.collect(this->Renderer, store, options, settings, this->Collected);
  this->LightsAll = settings.levels.frame.asksHemispheres() &&
    (settings.openGL || this->Collected.rasterizedReceivers);
  this->Statistics.collectTime += vtkTimerLog::GetUniversalTime() - start;
  this->Statistics.octreesBuilt += store.built() - built;
  this->Statistics.castingLights = this->Collected.lights.text;
  this->Statistics.reasons = this->Collected.reasons;
  this->Statistics.tracedActors = this->Collected.tracedActors;
  this->Statistics.rasterizedActors = this->Collected.rasterizedActors;
  this->Statistics.instances = static_cast<int>(this->Collected.scene.instances.size());
}

void RendererState::share(vtkMultiProcessController* controller, int width, int height,
  double distance, FrameSettings settings, std::size_t memoryLimit)
{
  if (settings.shadowTechnique != ShadowTechnique::Buffer)
  {
    if (settings.asksCasters() || settings.asksHemispheres())
    {
      this->OtherCasters.exchange(controller, memoryLimit, this->Collected);
    }
    return;
  }
  const View eye = this->aim(width, height, distance);
  ControllerProcesses processes(controller);
  settings.receiverMaps = this->Collected.rasterizedReceivers;
  this->SharesShadows =
    this->Trace->shareShadows(this->Collected.scene, eye, settings, smpParallelFor(), processes);
}

View RendererState::aim(int width, int height, double distance) const
{
  View view;
  const bool seen = viewOfCamera(this->Renderer, static_cast<int>(std::ceil(width / distance)),
    static_cast<int>(std::ceil(height / distance)), view);
  return seen ? view : View();
}

bool RendererState::shows(int width, int height) const
{
  const View view = this->aim(width, height, this->Statistics.pace.distance);
  return view.width == this->Eye.width && view.height == this->Eye.height &&
    view.worldToView == this->Eye.worldToView && view.viewToClip == this->Eye.viewToClip;
}

/// Which shadows small things cannot have, in words; empty if all is well.
std::string RendererState::lostShadows(const FrameSettings& settings) const
{
  if (settings.shadowTechnique != ShadowTechnique::Rays &&
    this->Statistics.tracer.coarsestTexel > CoarseShadow)
  {
    return "The texels of a shadow map look more than 32 pixels wide, even where it is fitted to "
           "what is seen. Raise ShadowBufferResolution, or take ShadowRays.";
  }
  if (this->Statistics.tracer.fewerTexels)
  {
    return "Shadow maps have fewer texels than ShadowBufferResolution asks for: all of them would "
           "take more than ShadowMemoryLimit, " +
      std::to_string(settings.shadowMemoryLimit >> 20) + " MiB.";
  }
  if (this->Statistics.tracer.largestGap > CoarseShadow)
  {
    return "Shadows of small things on a surface are lost: what its octree tells apart looks more "
           "than 32 pixels wide. Give the octree of a surface that is no mesh a higher level; "
           "divide a mesh that is so vast, or make it smaller.";
  }
  return {};
}

void RendererState::trace(int width, int height, const FramePace& pace, FrameSettings settings,
  double error, bool refinesAtOnce)
{
  this->Statistics.pace = pace;
  Scene& scene = this->Collected.scene;
  // By now the renderer has counted its lights, by rules of its own, for the mappers.
  auto* counted = vtkOpenGLRenderer::SafeDownCast(this->Renderer);
  scene.onlyHeadlight = counted && counted->GetLightingComplexity() == 1;
  View& view = this->Eye;
  view = this->aim(width, height, pace.distance);
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(this->Renderer->GetRenderWindow());
  this->HasPicture = this->hasSomething() && view.width > 0;
  if (!this->HasPicture)
  {
    this->Trace->releaseLayers();
    this->Maps.release();
    this->Sampled.release();
    this->Boxes.clear();
    this->Receivers.update(
      window, this->Maps.code(), settings.shadowIntensity, this->Collected.shadowCatchers);
    return;
  }
  settings.receiverMaps =
    this->Collected.rasterizedReceivers && settings.shadowTechnique != ShadowTechnique::None;
  settings.wholeShadowBuffers = settings.receiverMaps && this->Collected.receiversReach;
  // Some of what receives shows what is no pixel of theirs.
  const auto translucent = [](vtkProp* prop)
  { return prop->HasTranslucentPolygonalGeometry() != 0; };
  const bool seenThrough =
    std::any_of(this->Collected.receivers.begin(), this->Collected.receivers.end(), translucent);
  const bool others = seenThrough || !samplePositions().empty() || pace.distance > 1.0;
  settings.sampledMaps = settings.receiverMaps && others;
  const bool occlusion = this->Renderer->GetUseSSAO(); // into a framebuffer that is not bound yet
  settings.writeNormals = occlusion || this->Presenter->WantsNormals();
  settings.writeLight = occlusion || keepsLight();
  settings.writeSlopes = pace.distance == 1.0 && !samplePositions().empty();
  settings.writeNames = false;
  this->Presenter->Enter(window);
  settings.context = window;
  const bool wantsCode = settings.lightCode;
  const auto refusal = [this]
  { return this->Mask.refusal().empty() ? this->Boxes.refusal() : this->Mask.refusal(); };
  settings.lightCode = wantsCode && refusal().empty();
  // Volumes lie at the pixels of the window.
  const bool wantsVolumes = settings.lightCode && settings.shadowVolumes && pace.distance == 1.0;
  settings.shadowVolumes = wantsVolumes && this->Mask.acceptsVolumes();
  this->LightError = error;
  this->RefinesAtOnce = refinesAtOnce;
  this->render(settings);
  if (!this->Mask.accepts(this->Trace->lightCode()) || !this->Boxes.accepts(this->Trace->eyeCode()))
  {
    settings.lightCode = false;
    this->render(settings);
  }
  const bool receivers =
    this->Collected.rasterizedReceivers && this->Trace->receiverShares().sampled.any();
  // Their places, or what a mask has of fewer samples, have to be known before.
  const bool later = receivers || (error > 0.0 && !this->Trace->lightCode().sampled.empty());
  if (!later)
  {
    this->refine();
  }
  this->Statistics.coarseOctreeError = pace.distance * this->Statistics.tracer.coarsestVoxel;
  this->Boxes.update(window, this->Trace->eyeCode(), scene, this->Collected.props);
  const LightCode& code = this->Trace->lightCode();
  this->Complaint = wantsCode && !settings.lightCode ? refusal()
    : wantsVolumes && !settings.shadowVolumes        ? this->Mask.volumeRefusal()
    : code.complaint.empty()                         ? code.remark
                                                     : code.complaint;
  const std::string missing = this->Maps.update(
    this->Trace->shadowMaps(), scene.lights, view, settings, this->Trace->mapTexture());
  this->Complaint = this->Complaint.empty() ? missing : this->Complaint;
  const std::size_t octrees =
    std::min<std::size_t>(this->Statistics.tracer.gpuMemory, settings.gpuMemoryLimit);
  const LightCode& sampled = this->Sampled.lookUp(this->Maps.code(),
    receivers ? this->Trace->receiverShares() : ReceiverShares(), settings, view,
    scene.lights.empty(), width, height, others, seenThrough);
  const LightCode& masked =
    this->Mask.lookUp(code, width, height, others, settings.gpuMemoryLimit - octrees, seenThrough);
  const LightCode& known = this->Sampled.any() ? sampled : masked;
  if (code.volumes && !masked.fromPlaces)
  {
    FrameStatistics& tracer = this->Statistics.tracer;
    tracer.shadowVolumes = tracer.contourEdges = tracer.sparedCasters = 0;
    this->Complaint = !this->Complaint.empty()
      ? this->Complaint
      : "A picture of what shadow volumes tell does not fit into OpenGL's memory, or "
        "GPUMemoryLimit: rays to the lights find the same shadows.";
  }
  if (later && !known.fromPlaces)
  {
    this->refine();
  }
  if ((receivers || !code.sampled.empty()) && !known.fromPlaces && this->Complaint.empty())
  {
    this->Complaint =
      "A picture of what samples of the light have found does not fit into OpenGL's memory, or "
      "GPUMemoryLimit: on what VTK draws there is neither a sky's light nor ambient occlusion, and "
      "lights with a size are points.";
  }
  if (seenThrough && !known.translucent && (receivers || !code.sampled.empty()) &&
    this->Complaint.empty())
  {
    this->Complaint = "Places of translucent surfaces do not fit into a texture of OpenGL, or "
                      "GPUMemoryLimit: nothing "
                      "closes these off, and lights with a size are points to them.";
  }
  this->Receivers.update(window, known.empty() ? this->Maps.code() : known,
    settings.shadowIntensity, this->Collected.shadowCatchers);
  this->Receivers.setMirrored(view.mirrored);
  this->Statistics.receiverMemory =
    this->Maps.memory() + this->Sampled.bytes() + this->Places.bytes();
  this->Statistics.tracer.gpuMemory += this->Mask.bytes();
  if (this->Complaint.empty() && settings.shadowTechnique != ShadowTechnique::None)
  {
    this->Complaint = this->lostShadows(settings);
  }
}

/// Traces the frame, and notes how long samples take.
void RendererState::render(const FrameSettings& settings)
{
  this->Settings = settings;
  const int samples = this->samples();
  this->Trace->render(this->Collected.scene, this->Eye, settings, smpParallelFor());
  this->Statistics.tracer = this->Trace->statistics();
  this->AddedSamples = samples > 0 ? std::max(this->samples() - samples, 0) : 0;
  if (this->AddedSamples > 0)
  {
    this->SecondsOfSample = this->Statistics.tracer.samplingTime / this->AddedSamples;
  }
}

/// Takes more samples of its lights until they are refined(); of what VTK draws by `sample`.
void RendererState::refine(const std::function<void()>& sample)
{
  while (this->RefinesAtOnce && !this->refined(this->Settings.lightSamples, this->LightError))
  {
    FrameSettings more = this->Settings;
    more.samplesNow = 2 * this->samples();
    this->render(more);
    if (sample)
    {
      sample();
    }
  }
}

/// Has the tracer find the light of receivers whose places are known.
void RendererState::sampleReceivers(bool same)
{
  const double before = this->Trace->statistics().samplingTime;
  this->Trace->sampleReceivers(
    this->Collected.scene, this->Eye, this->Places, same, smpParallelFor());
  const double after = this->Trace->statistics().samplingTime;
  this->SecondsOfSample += this->AddedSamples > 0 ? (after - before) / this->AddedSamples : 0.0;
  this->Statistics.tracer = this->Trace->statistics();
}

void RendererState::findLight(const vtkRenderState& drawn)
{
  if (!this->Receivers.gathers())
  {
    return;
  }
  const bool same = this->Drawn.take(drawn, this->Collected);
  // A vtkSSAOPass around selects buffers of its own with each prop, and VTK warns that they are not
  // those that are drawn into.
  const bool silences =
    this->Presenter->WantsNormals() && vtkObject::GetGlobalWarningDisplay() != 0;
  const auto draw = [&](int slice, int behind)
  {
    if (silences)
    {
      vtkObject::GlobalWarningDisplayOff();
    }
    this->Receivers.setGathers(true, behind);
    this->Drawn.draw(this->Renderer, slice > 0);
    if (slice == 0)
    {
      this->Boxes.draw(this->Renderer, &this->Collected.receivers);
    }
    if (silences)
    {
      vtkObject::GlobalWarningDisplayOn();
    }
  };
  vtkOpenGLState* state =
    vtkOpenGLRenderWindow::SafeDownCast(this->Renderer->GetRenderWindow())->GetState();
  const std::uint64_t memory = this->Statistics.tracer.gpuMemory;
  if (!this->Sampled.any())
  {
    const auto find = [&](bool sameSurfaces)
    {
      const LightCode& code = this->Trace->lightCode();
      this->Mask.find(state, code, sameSurfaces, draw, this->LightError > 0.0);
    };
    find(same);
    this->refine([&] { find(true); });
  }
  else
  {
    this->Sampled.aim(state);
    const ReceiverShares& shares = this->Trace->receiverShares();
    const bool known = same && shares.current && this->Sampled.filled();
    const int before = this->samples();
    if (!known)
    {
      this->Sampled.gather(state, draw, this->Places);
      this->sampleReceivers(same);
    }
    this->refine([this] { this->sampleReceivers(true); });
    if (!known || this->samples() != before)
    {
      this->Sampled.upload(shares);
    }
  }
  this->Statistics.tracer.gpuMemory = memory; // as when it was traced, with the mask
  this->Receivers.setGathers(false);
}

void RendererState::present(vtkOpenGLRenderPass* pass)
{
  this->Presenter->SetFrame(
    this->HasPicture && this->Trace->frame().hasPicture() ? &this->Trace->frame() : nullptr,
    [this](const std::vector<glm::vec2>& positions, Silhouettes& silhouettes)
    {
      if (this->Statistics.pace.distance == 1.0) // else the frame's pixels are not the window's
      {
        this->Trace->divideEdges(
          this->Collected.scene, this->Eye, positions, smpParallelFor(), silhouettes);
      }
    },
    pass);
  this->Presenter->SetSurfaces(this->Boxes.empty() ? vtkSVOPresenter::Draw()
                                                   : [this](vtkViewport* viewport)
      { this->Boxes.draw(viewport, nullptr, this->Presenter); });
  this->Presenter->SetFirst(drawsPropsFirst(this->Renderer->GetPass()));
}

void RendererState::joinPasses(const vtkRenderState* state)
{
  vtkProp** const first = state->GetPropArray();
  vtkProp** const last = first + state->GetPropArrayCount();
  vtkProp** const replaced = std::find_if(
    first, last, [this](vtkProp* prop) { return this->Collected.replaced.count(prop) > 0; });
  this->Presenter->StandFor(replaced != last ? *replaced : nullptr);
}

void RendererState::exchange(const vtkRenderState* state, vtkOpenGLRenderPass* pass)
{
  this->present(pass);
  bool first = this->Renderer->GetPass() == pass; // else others may have drawn
  bool presented = false;
  std::size_t used = 0;
  for (int i = 0; i < state->GetPropArrayCount(); ++i)
  {
    vtkProp*& prop = state->GetPropArray()[i];
    if (this->Collected.replaced.count(prop) == 0)
    {
      first = first && prop->IsA("vtkActor2D"); // drawn later, over everything
      continue;
    }
    if (!presented)
    {
      this->Presenter->SetFirst(first);
      prop = this->Presenter;
      presented = true;
      continue;
    }
    // The same prop twice in the array would leak references.
    if (used == this->Nothings.size())
    {
      this->Nothings.push_back(vtkSmartPointer<vtkSVONothing>::New());
    }
    prop = this->Nothings[used++];
  }
}

void RendererState::finish()
{
  this->Statistics.presentTime = this->Presenter->GetPresentTime();
  this->Presenter->SetFrame(nullptr, nullptr, nullptr);
  this->Presenter->SetSurfaces(nullptr);
  this->Collected.current = false;
  this->InFrame = false;
  if (this->ForgetsScene)
  {
    this->forgetScene();
  }
}

/// In a frame, whose observers may ask for it: as soon as that has ended.
void RendererState::forgetScene()
{
  this->ForgetsScene = this->InFrame;
  if (!this->InFrame)
  {
    this->Collector.forget();
    this->Collected = CollectedScene();
  }
}

void RendererState::releaseLayers()
{
  this->Trace->releaseLayers();
  this->forgetScene();
}

void RendererState::releaseGraphicsResources(vtkWindow* window)
{
  this->Boxes.releaseGraphicsResources(window);
  this->Presenter->ReleaseGraphicsResources(window);
  this->forgetScene(); // who releases these does not draw soon
}
}
