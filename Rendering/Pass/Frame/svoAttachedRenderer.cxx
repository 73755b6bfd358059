#include "svoAttachedRenderer.h"

#include "vtkCullerCollection.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace svo
{
namespace
{
/// Hosts that spread a frame over several processes do so in the same events, before us.
constexpr float AfterHosts = -1.0f;

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

AttachedRenderer::AttachedRenderer(vtkRenderer* renderer, vtkCommand* events,
  vtkSVOPresenter* presenter, std::function<bool(vtkProp*)> traces)
  : Renderer(renderer)
  , Events(events)
  , Presenter(presenter)
{
  renderer->AddObserver(vtkCommand::StartEvent, events, AfterHosts);
  renderer->AddObserver(vtkCommand::EndEvent, events, AfterHosts);
  renderer->AddObserver(vtkCommand::DeleteEvent, events);
  vtkNew<TracedCuller> culler;
  culler->IsTraced = std::move(traces);
  this->Culler = culler;
  // Shadows must be known before the first surface that receives them is drawn.
  renderer->AddViewProp(presenter);
  vtkPropCollection* props = renderer->GetViewProps();
  if (props->GetNumberOfItems() > 1)
  {
    props->RemoveItem(presenter);
    props->InsertItem(-1, presenter);
  }
}

AttachedRenderer::~AttachedRenderer()
{
  this->Presenter->SetPrepare(nullptr);
  if (this->Renderer)
  {
    this->Renderer->RemoveObserver(this->Events);
    this->Renderer->RemoveCuller(this->Culler);
    this->Renderer->RemoveViewProp(this->Presenter);
  }
}

void AttachedRenderer::addCuller()
{
  if (!this->Renderer->GetCullers()->IsItemPresent(this->Culler))
  {
    this->Renderer->AddCuller(this->Culler);
  }
}
}
