#include "vtkSVORenderPass.h"

#include "svoBackendChoice.h"
#include "svoCameraView.h"
#include "svoOpenGLTracer.h"
#include "svoOwnCamera.h"
#include "svoPassInternals.h"
#include "svoPassTexts.h"
#include "svoPropPasses.h"
#include "svoSMPParallel.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkRenderState.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSVORenderPass);

vtkSVORenderPass::vtkSVORenderPass()
  : Impl(new Internals(this))
{
}

vtkSVORenderPass::~vtkSVORenderPass()
{
  while (!this->Impl->attached.empty())
  {
    this->Detach(this->Impl->attached.begin()->first);
  }
}

bool vtkSVORenderPass::PrefersOpenGL(
  vtkOpenGLRenderWindow* window, bool rays, std::string& complaint) const
{
  const svo::BackendChoice choice = svo::chooseBackend(
    window, rays, [window] { return svo::measureRays(window, svo::smpParallelFor()); });
  complaint = choice.complaint;
  return choice.openGL;
}

std::unique_ptr<svo::Tracer> vtkSVORenderPass::MakeTracer() const
{
  return svo::makeOpenGLTracer(svo::makeCPUTracer());
}

std::string vtkSVORenderPass::GetText(int text, vtkLight*) const
{
  static_assert(std::size(svo::PassTexts) == TEXT_LIGHT + 1, "a text of each type");
  return text >= 0 && text <= TEXT_LIGHT ? svo::PassTexts[text] : "";
}

void vtkSVORenderPass::ReleaseOctrees()
{
  Internals& impl = *this->Impl;
  impl.releaseAsked = !impl.frames.idle(); // by an observer of a frame, which needs them
  if (impl.releaseAsked)
  {
    return;
  }
  impl.store.release();
  for (const auto& entry : impl.frames.states())
  {
    entry.second->releaseLayers();
  }
}

bool vtkSVORenderPass::Refine()
{
  return this->RefineFor(std::numeric_limits<double>::infinity());
}

bool vtkSVORenderPass::RefineFor(double seconds)
{
  Internals& impl = *this->Impl;
  if (!impl.frames.idle())
  {
    return false; // by an observer of a frame
  }
  const vtkSmartPointer<vtkSVORenderPass> alive(this);
  std::set<vtkSmartPointer<vtkRenderWindow>> windows;
  const auto look = [&]
  { return impl.frames.unrefined(this->MaximumLightSamples, this->LightError, windows); };
  const int before = look();
  impl.refining = seconds;
  for (const vtkSmartPointer<vtkRenderWindow>& window :
    std::vector<vtkSmartPointer<vtkRenderWindow>>(windows.begin(), windows.end()))
  {
    window->Render();
  }
  impl.refining = 0.0;
  // While somebody interacts they stay as they are.
  return look() > before && !windows.empty();
}

void vtkSVORenderPass::MeasureFrame(
  double& seconds, double& fixedSeconds, double& shadowSeconds) const
{
  this->Impl->statistics.measure(seconds, fixedSeconds, shadowSeconds);
}

void vtkSVORenderPass::Render(const vtkRenderState* state)
{
  const vtkSmartPointer<vtkSVORenderPass> alive(this); // whatever observers do
  vtkRenderer* renderer = state->GetRenderer();
  this->NumberOfRenderedProps = 0;
  const svo::OwnCamera camera(state, this);
  if (renderer->GetSelector() || this->Impl->frames.of(renderer))
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
  svo::PassFrame& frame = this->Impl->frames.begin(renderer);
  vtkRenderWindow* window = renderer->GetRenderWindow();
  const bool heard = this->HasObserver(vtkCommand::ProgressEvent) ||
    window->HasObserver(vtkCommand::AbortCheckEvent);
  if (heard && this->Impl->refining == 0.0 && !this->Impl->idle.may(window))
  {
    frame.sampling = svo::Sampling::Begun;
  }
  bool drawn = false;
  while (!drawn)
  {
    if (!this->CollectFrame(frame, width, height, &camera))
    {
      this->FinishFrame(frame);
      return;
    }
    frame.state->joinPasses(state);
    this->TraceFrame(frame, width, height);
    vtkProp** const props = state->GetPropArray();
    const std::vector<vtkProp*> before(props, props + state->GetPropArrayCount());
    frame.state->exchange(state, this);
    const bool receiving = !frame.state->receivers().idle();
    if (receiving)
    {
      svo::carryPass(&frame.receivers(), this);
      frame.state->findLight(*state);
    }
    drawn = !this->WantsSamples(frame);
    if (drawn)
    {
      this->UpdateGeometry(renderer, state->GetFrameBuffer());
    }
    if (receiving)
    {
      svo::dropPass(&frame.receivers(), this);
    }
    std::copy(before.begin(), before.end(), props);
    frame.state->presenter()->StandFor(nullptr);
    if (!drawn)
    {
      this->TellOfSamples(frame);
    }
  }
  this->FinishFrame(frame);
  this->NumberOfRenderedProps = renderer->GetNumberOfPropsRendered();
}

void vtkSVORenderPass::ReleaseGraphicsResources(vtkWindow* window)
{
  if (window)
  {
    this->Superclass::ReleaseGraphicsResources(window);
  }
  for (const auto& entry : this->Impl->frames.states())
  {
    entry.second->releaseGraphicsResources(window);
  }
}

void vtkSVORenderPass::SetController(vtkMultiProcessController* controller)
{
  this->Impl->controller = controller;
}

vtkMultiProcessController* vtkSVORenderPass::GetController() const
{
  return this->Impl->controller;
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
  svo::RendererState* current = this->Impl->frames.current();
  if (current && vtkOpenGLPolyDataMapper::SafeDownCast(mapper))
  {
    current->receivers().completeShader(vertexShader, geometryShader, fragmentShader);
  }
  return true;
}

bool vtkSVORenderPass::SetShaderParameters(
  vtkShaderProgram* program, vtkAbstractMapper*, vtkProp* prop, vtkOpenGLVertexArrayObject*)
{
  if (svo::RendererState* current = this->Impl->frames.current())
  {
    const svo::ShadowReceivers& receivers = current->receivers();
    receivers.setUniforms(program, GetReceiveShadow(prop), GetShadowCatcher(prop),
      !receivers.gathers() || !prop->HasTranslucentPolygonalGeometry());
  }
  return true;
}

vtkMTimeType vtkSVORenderPass::GetShaderStageMTime()
{
  return this->Impl->shaderTime.GetMTime();
}

const svo::PassStatistics& vtkSVORenderPass::LastFrame() const
{
  return this->Impl->statistics;
}

int vtkSVORenderPass::GetNumberOfOctreesBuilt() const
{
  return this->Impl->store.built();
}

int vtkSVORenderPass::GetNumberOfOctreesInProgress() const
{
  return this->Impl->store.building();
}

vtkIdType vtkSVORenderPass::GetOctreeMemorySize() const
{
  return static_cast<vtkIdType>(this->Impl->store.bytes() / svo::BytesOfKiB);
}

void vtkSVORenderPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->GetController() << '\n'
     << indent << "NumberOfOctreesBuilt: " << this->GetNumberOfOctreesBuilt() << '\n'
     << indent << "NumberOfOctreesInProgress: " << this->GetNumberOfOctreesInProgress() << '\n'
     << indent << "OctreeMemorySize: " << this->GetOctreeMemorySize() << " KiB\n";
}
