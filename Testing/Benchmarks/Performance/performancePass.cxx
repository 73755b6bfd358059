#include "performancePass.h"

#ifdef SVO_PHASES
#include "svoTracer.h"

#include <vtkObjectFactory.h>
#endif

#include <chrono>
#include <ctime>

namespace performance
{
Moment Moment::now()
{
  const std::chrono::duration<double, std::milli> wall =
    std::chrono::steady_clock::now().time_since_epoch();
  return { wall.count(), 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC };
}

#ifdef SVO_PHASES
namespace
{
struct Traced
{
  Moment begin, end;
  svo::FrameStatistics statistics;
};

/// The tracer of the processor, timed from outside.
class TimedTracer : public svo::Tracer
{
public:
  explicit TimedTracer(std::shared_ptr<Traced> last)
    : Last(std::move(last))
  {
  }
  std::vector<svo::NeededLevels> neededLevels(const svo::Scene& scene, const svo::View& view,
    const svo::FrameSettings& settings) const override
  {
    return this->Timed->neededLevels(scene, view, settings);
  }
  void render(const svo::Scene& scene, const svo::View& view, const svo::FrameSettings& settings,
    const svo::ParallelFor& parallelFor, svo::Frame& frame) override
  {
    this->Last->begin = Moment::now();
    this->Timed->render(scene, view, settings, parallelFor, frame);
    this->Last->end = Moment::now();
    this->Last->statistics = this->Timed->statistics();
  }
  bool shareShadows(const svo::Scene& scene, const svo::View& view,
    const svo::FrameSettings& settings, const svo::ParallelFor& parallelFor,
    svo::Processes& processes) override
  {
    return this->Timed->shareShadows(scene, view, settings, parallelFor, processes);
  }
  void divideEdges(const svo::Scene& scene, const svo::View& view, const svo::Frame& frame,
    const std::vector<glm::vec2>& positions, const svo::ParallelFor& parallelFor,
    svo::Silhouettes& result) const override
  {
    this->Timed->divideEdges(scene, view, frame, positions, parallelFor, result);
  }
  const svo::FrameStatistics& statistics() const override { return this->Timed->statistics(); }
  const std::vector<svo::ShadowMap>& shadowMaps() const override
  {
    return this->Timed->shadowMaps();
  }
  void releaseLayers() override { this->Timed->releaseLayers(); }

private:
  std::unique_ptr<svo::Tracer> Timed = svo::makeCPUTracer();
  std::shared_ptr<Traced> Last;
};

class TimedPass : public vtkSVORenderPass
{
public:
  static TimedPass* New();
  vtkTypeMacro(TimedPass, vtkSVORenderPass);
  std::shared_ptr<Traced> Last = std::make_shared<Traced>();

protected:
  std::unique_ptr<svo::Tracer> MakeTracer() const override
  {
    return std::make_unique<TimedTracer>(this->Last);
  }
};
vtkStandardNewMacro(TimedPass);

void add(Phases& phases, const std::string& name, double wall, double processor)
{
  phases[name + "Ms"] = processor;
  phases[name + "WallMs"] = wall;
}
}

vtkSmartPointer<vtkSVORenderPass> makePass(PhasesOfFrame& phases)
{
  auto pass = vtkSmartPointer<TimedPass>::New();
  phases = [last = pass->Last](const Moment& begin, const Moment& end)
  {
    Phases result;
    const svo::FrameStatistics& traced = last->statistics;
    add(result, "collect", last->begin.wall - begin.wall, last->begin.processor - begin.processor);
    add(result, "eye", 1e3 * traced.eye.wall, 1e3 * traced.eye.processor);
    add(result, "mark", 1e3 * traced.mark.wall, 1e3 * traced.mark.processor);
    add(result, "lights", 1e3 * traced.lights.wall, 1e3 * traced.lights.processor);
    add(result, "shade", 1e3 * traced.shade.wall, 1e3 * traced.shade.processor);
    add(result, "present", end.wall - last->end.wall, end.processor - last->end.processor);
    return result;
  };
  return pass;
}
#else
vtkSmartPointer<vtkSVORenderPass> makePass(PhasesOfFrame& phases)
{
  phases = [](const Moment&, const Moment&) { return Phases(); };
  return vtkSmartPointer<vtkSVORenderPass>::New();
}
#endif
}
