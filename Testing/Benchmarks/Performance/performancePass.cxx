#include "performancePass.h"

#include "performanceCores.h"
#include "svoTracer.h"

#include <vtkObjectFactory.h>

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

namespace
{
struct Traced
{
  Moment begin, end;
  svo::FrameStatistics statistics;
  bool simulatesCores = false;
  Phases cores;
};

/// What the phases that were recorded take on other numbers of cores.
Phases onCores(const RecordedLoops& recorded, const svo::FrameStatistics& traced)
{
  static const double launch = RecordedLoops::launch();
  const std::pair<const char*, double> phases[] = { { "eye", traced.eye.wall },
    { "mark", traced.mark.wall }, { "lights", traced.lights.wall },
    { "shade", traced.shade.wall } };
  Phases result;
  const auto add = [&](const std::string& name, double first, double last)
  {
    result[name + "SerialMs"] = recorded.serial(first, last);
    for (const int cores : SimulatedCores)
    {
      result[name + "Cores" + std::to_string(cores) + "Ms"] =
        recorded.time(first, last, cores, launch);
    }
  };
  // They follow each other; what is left is behind the last one.
  double first = 0.0;
  for (const auto& phase : phases)
  {
    add(phase.first, first, first + 1e3 * phase.second);
    first += 1e3 * phase.second;
  }
  add("tracer", 0.0, recorded.now());
  return result;
}

/// The tracer of the processor, timed from outside. What it is handed is handed on as it is, since
/// commits are timed that hand it more or less; see TimedTracer.
class TimedCalls : public svo::Tracer
{
public:
  explicit TimedCalls(std::shared_ptr<Traced> last)
    : Last(std::move(last))
  {
  }
  std::vector<svo::NeededLevels> neededLevels(const svo::Scene& scene, const svo::View& view,
    const svo::FrameSettings& settings) const override
  {
    return this->Timed->neededLevels(scene, view, settings);
  }
  bool shareShadows(const svo::Scene& scene, const svo::View& view,
    const svo::FrameSettings& settings, const svo::ParallelFor& parallelFor,
    svo::Processes& processes) override
  {
    return this->Timed->shareShadows(scene, view, settings, parallelFor, processes);
  }
  const svo::FrameStatistics& statistics() const override { return this->Timed->statistics(); }
  const std::vector<svo::ShadowMap>& shadowMaps() const override
  {
    return this->Timed->shadowMaps();
  }
  void releaseLayers() override { this->Timed->releaseLayers(); }

protected:
  void begin()
  {
    this->Last->begin = Moment::now();
    this->Recorded.begin();
  }
  void end()
  {
    if (this->Last->simulatesCores)
    {
      this->Last->cores = onCores(this->Recorded, this->Timed->statistics());
    }
    this->Last->end = Moment::now();
    this->Last->statistics = this->Timed->statistics();
  }
  template <class T>
  T& handOn(T& value)
  {
    return value;
  }
  svo::ParallelFor handOn(const svo::ParallelFor& parallelFor)
  {
    return this->Last->simulatesCores ? this->Recorded.loops() : parallelFor;
  }

  std::unique_ptr<svo::Tracer> Timed = svo::makeCPUTracer();

private:
  std::shared_ptr<Traced> Last;
  RecordedLoops Recorded;
};

template <class Render, class DivideEdges>
class TimedTracer;
template <class... ForFrame, class... ForEdges>
class TimedTracer<void (svo::Tracer::*)(ForFrame...), void (svo::Tracer::*)(ForEdges...) const>
  : public TimedCalls
{
public:
  using TimedCalls::TimedCalls;
  void render(ForFrame... arguments) override
  {
    this->begin();
    this->Timed->render(this->handOn(arguments)...);
    this->end();
  }
  void divideEdges(ForEdges... arguments) const override { this->Timed->divideEdges(arguments...); }
  virtual svo::Frame& frame() { return frameOf(*this->Timed, 0); }

private:
  template <class Tracer>
  static auto frameOf(Tracer& tracer, int) -> decltype(tracer.frame())
  {
    return tracer.frame();
  }
  template <class Tracer>
  static svo::Frame& frameOf(Tracer&, long) // it has none of its own
  {
    static svo::Frame none;
    return none;
  }
};

class TimedPass : public vtkSVORenderPass
{
public:
  static TimedPass* New();
  vtkTypeMacro(TimedPass, vtkSVORenderPass);
  std::shared_ptr<Traced> Last = std::make_shared<Traced>();
  int PaceCores = 0;

protected:
  void MeasureFrame(double& seconds, double& fixedSeconds, double& shadowSeconds) const override
  {
    this->Superclass::MeasureFrame(seconds, fixedSeconds, shadowSeconds);
    if (this->PaceCores > 0)
    {
      const svo::FrameStatistics& traced = this->Last->statistics;
      const double here = traced.traceTime + traced.shadowTime;
      const double there =
        1e-3 * this->Last->cores.at("tracerCores" + std::to_string(this->PaceCores) + "Ms");
      seconds += there - here;
      shadowSeconds *= there / here;
    }
  }
  std::unique_ptr<svo::Tracer> MakeTracer() const override
  {
    return std::make_unique<
      TimedTracer<decltype(&svo::Tracer::render), decltype(&svo::Tracer::divideEdges)>>(this->Last);
  }
};
vtkStandardNewMacro(TimedPass);

void add(Phases& phases, const std::string& name, double wall, double processor)
{
  phases[name + "Ms"] = processor;
  phases[name + "WallMs"] = wall;
}
}

vtkSmartPointer<vtkSVORenderPass> makePass(
  PhasesOfFrame& phases, bool simulatesCores, int paceCores)
{
  auto pass = vtkSmartPointer<TimedPass>::New();
  pass->PaceCores = paceCores;
  pass->Last->simulatesCores = simulatesCores;
  phases = [last = pass->Last](const Moment& begin, const Moment& end)
  {
    Phases result = last->cores;
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

}
