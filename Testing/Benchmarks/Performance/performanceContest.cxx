#include "performanceContest.h"

#include "svoInstructionSet.h"

#include <algorithm>
#include <iostream>
#include <memory>

namespace performance
{
namespace
{
constexpr int WarmUpFrames = 2;
constexpr double DegreesPerFrame = 2.0; // of what turns a little

/// The same meshes for other mappers: what VTK keeps of a mapper's last renderer is not ours.
paper::Objects withOwnMappers(const paper::Objects& objects)
{
  paper::Objects own = objects;
  for (paper::Object* object : { &own.a, &own.b, &own.ground })
  {
    for (vtkSmartPointer<vtkPolyDataMapper>& pose : object->poses)
    {
      vtkDataObject* mesh = pose->GetInputDataObject(0, 0);
      pose = vtkSmartPointer<vtkPolyDataMapper>::New();
      pose->SetInputDataObject(mesh);
      pose->ScalarVisibilityOff();
    }
  }
  return own;
}

/// A method with its scene, in a window.
class Entrant
{
public:
  Entrant(vtkRenderWindow* window, const Contest& contest, const Method& method)
    : How(method)
    , Target(window)
    , Shapes(withOwnMappers(*contest.objects))
    , Shown(*contest.experiment, this->Shapes)
  {
    window->AddRenderer(this->Shown.renderer());
    this->Shown.renderer()->DrawOff();
    this->Shown.setLight(method.light);
    if (contest.furnish)
    {
      contest.furnish(this->Shown);
    }
    if (method.technique == paper::Technique::Octrees)
    {
      this->Pass = method.phases ? makePass(this->PhasesOf, method.simulatesCores)
                                 : vtkSmartPointer<vtkSVORenderPass>::New();
      if (method.settings)
      {
        method.settings(this->Pass);
      }
      this->Shown.renderer()->SetPass(this->Pass);
    }
    else if (method.technique == paper::Technique::ShadowMaps)
    {
      this->Shown.renderer()->SetPass(paper::shadowMaps(paper::defaultShadowMapResolution()));
    }
    else if (method.technique == paper::Technique::Empty)
    {
      this->Shown.renderer()->RemoveAllViewProps();
    }
  }
  ~Entrant()
  {
    paper::removePass(this->Shown.renderer());
    this->Target->RemoveRenderer(this->Shown.renderer());
  }
  Entrant(const Entrant&) = delete;
  void operator=(const Entrant&) = delete;

  void begin(Situation situation, const paper::Viewpoint& view)
  {
    this->Shown.setFrame(0);
    this->turn(this->Shown.experiment().a.size(), 0.0);
    this->Shown.setView(view);
    if (this->Pass)
    {
      this->Pass->SetFrameCoherence(situation != Situation::Retraced);
    }
  }

  void draw(Situation situation, const paper::Viewpoint& view, int frame, int frames)
  {
    this->pose(situation, view, frame, frames);
    svobench::useInstructionSet(this->How.instructionSet);
    this->Shown.renderer()->DrawOn();
    const Moment begin = Moment::now();
    const paper::Sample sample = paper::draw(this->Target);
    const Moment end = Moment::now();
    this->Shown.renderer()->DrawOff();
    if (this->First == 0.0)
    {
      this->First = sample.processorMilliseconds;
    }
    if (frame < WarmUpFrames)
    {
      return;
    }
    Phases phases = this->PhasesOf ? this->PhasesOf(begin, end) : Phases();
    phases["wallMs"] = sample.milliseconds;
    phases["processorMs"] = sample.processorMilliseconds;
    for (const auto& [name, time] : phases)
    {
      this->Times[name].push_back(time);
    }
  }

  /// The row of what was timed since the last one; false if the pass did not trace it all.
  bool finish(svobench::Row row, svobench::Results& results)
  {
    row["method"] = this->How.name;
    if (!this->How.instructionSet.empty())
    {
      row["instructionSet"] = this->How.instructionSet;
    }
    row["frames"] = static_cast<int>(this->Times["wallMs"].size());
    for (auto& [name, times] : this->Times)
    {
      std::sort(times.begin(), times.end());
      row[name] = times[times.size() / 2];
      // Of "wallMs", "eyeWallMs"...: the least is due to us alone, where others are busy, too.
      const std::size_t wall = name.find("allMs");
      if (wall != std::string::npos)
      {
        row[name.substr(0, wall) + "allLeastMs"] = times.front();
      }
    }
    row["firstProcessorMs"] = this->First;
    const std::vector<double>& processor = this->Times["processorMs"];
    row["processorLowMs"] = processor[processor.size() / 4];
    row["processorHighMs"] = processor[3 * processor.size() / 4];
    bool whole = true;
    if (this->Pass)
    {
      row["instances"] = this->Pass->GetNumberOfInstances();
      row["shadowRays"] = Json::Int64(this->Pass->GetNumberOfShadowRays());
      row["lightsWithRays"] = this->Pass->GetNumberOfLightsWithShadowRays();
      row["retracedLayers"] = Json::Int64(this->Pass->GetNumberOfRetracedLayers());
      row["octreeMiB"] = static_cast<double>(this->Pass->GetOctreeMemorySize()) / 1024.0;
      row["gpuMiB"] = static_cast<double>(this->Pass->GetGPUMemory()) / 1024.0;
      row["layerMiB"] = static_cast<double>(this->Pass->GetLayerMemorySize()) / 1024.0;
      whole = this->Pass->GetActiveBackend() == vtkSVORenderPass::BACKEND_OPENGL
        ? this->Pass->GetNumberOfTracedActors() == 0
        : this->Pass->GetNumberOfTracedActors() > 0 &&
          this->Pass->GetNumberOfRasterizedActors() == 0;
    }
    this->Times.clear();
    results.add(row);
    return whole;
  }

private:
  /// Sets what moves, and touches nothing else: whoever keeps something goes by what was modified.
  void pose(Situation situation, const paper::Viewpoint& view, int frame, int frames)
  {
    const std::size_t count = this->Shown.experiment().a.size();
    switch (situation)
    {
      case Situation::Retraced:
        this->Shown.setFrame(frame * paper::Scene::period() / frames);
        break;
      case Situation::All:
        this->Shown.setFrame(frame);
        this->turn(count, DegreesPerFrame * frame);
        break;
      case Situation::One:
        this->turn(1, DegreesPerFrame * frame);
        break;
      case Situation::Camera:
        this->Shown.setView(view, DegreesPerFrame * frame);
        break;
      case Situation::Nothing:
        break;
    }
  }

  /// The first A's.
  void turn(std::size_t count, double degrees)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      this->Shown.turnA(i, degrees);
    }
  }

  const Method& How;
  vtkRenderWindow* Target;
  paper::Objects Shapes;
  paper::Scene Shown;
  vtkSmartPointer<vtkSVORenderPass> Pass;
  PhasesOfFrame PhasesOf;
  std::map<std::string, std::vector<double>> Times;
  double First =
    0.0; // of the very first frame: octrees are built, shaders are compiled, all is sent
};
}

const char* nameOf(Situation situation)
{
  constexpr const char* names[] = { "retraced", "all", "one", "camera", "nothing" };
  return names[static_cast<int>(situation)];
}

bool run(
  vtkRenderWindow* window, const Contest& contest, const Effort& effort, svobench::Results& results)
{
  std::vector<std::unique_ptr<Entrant>> entrants;
  for (const Method& method : contest.methods)
  {
    if (svobench::useInstructionSet(method.instructionSet))
    {
      entrants.push_back(std::make_unique<Entrant>(window, contest, method));
    }
  }
  const int views = static_cast<int>(contest.experiment->views.size());
  const int enough = std::max(1, 3 / views); // for a median
  bool whole = true;
  for (const Situation situation : contest.situations)
  {
    for (const paper::Viewpoint& view : contest.experiment->views)
    {
      for (const std::unique_ptr<Entrant>& entrant : entrants)
      {
        entrant->begin(situation, view);
      }
      // The frames themselves depend on their number, not on the time that they take.
      const int frames = WarmUpFrames + std::max(1, effort.frames / views);
      const double start = Moment::now().wall;
      for (int i = 0; i < frames; ++i)
      {
        for (const std::unique_ptr<Entrant>& entrant : entrants)
        {
          entrant->draw(situation, view, i, frames);
        }
        if (i + 1 >= WarmUpFrames + enough &&
          Moment::now().wall - start > 1e3 * effort.seconds / views)
        {
          break;
        }
      }
    }
    svobench::Row row = contest.row;
    row["situation"] = nameOf(situation);
    row["scene"] = contest.experiment->name;
    const int* size = window->GetSize();
    row["width"] = size[0];
    row["height"] = size[1];
    for (const std::unique_ptr<Entrant>& entrant : entrants)
    {
      whole = entrant->finish(row, results) && whole;
    }
  }
  svobench::useInstructionSet("");
  if (!whole)
  {
    std::cerr << contest.experiment->name << ": the rasteriser drew what should be traced\n";
  }
  return whole;
}
}
