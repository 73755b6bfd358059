// What lights with a size and ambient occlusion cost, and what few samples of them leave of error,
// in the paper's fourth scene. Methods take turns frame by frame; times are medians of processor
// time, in ms.
//
// time: a frame by a point light, and what others take beyond it, retraced and with all kept but
// the shading; rays a second are what more samples of a kind take.
// error: RMS of colours (0..255) against many samples, over pixels that are between the extremes,
// as penumbras are, and over all, of each pixel's samples alone and filtered; the last row of a
// kind is the slope of log(error) over log(samples), of the former and of errors of a grey level
// and more, as colours are whole numbers. nothingSoft: pictures whose bits no setting of soft
// lights may change.
// interactive: frames two thirds as wide and high with a soft light and occlusion, the camera in
// orbit, that keep to a rate, by what they would take on so many cores (performanceCores.h), and
// how far they are from still pictures: the mean of a channel, and the share of pixels with more
// than 8 of 255 in one.
//
//   BenchmarkSoftLight [--a dragon.off --b sydney.md2] [--size 1920x1080] [--frames n]
//   [--errorSize 320x180] [--truth 2048] [--json file] [--experiments time,error,...]
//
// --frames: of each of the three viewpoints. VTK_SMP_MAX_THREADS says how many threads. The exit
// code is 1 where errors do not fall, pictures differ that must not, or the rasteriser drew
// something.
#include "experiments.h"
#include "meshes.h"
#include "objects.h"
#include "performancePass.h"
#include "performanceWindow.h"
#include "pictureDifference.h"
#include "scenes.h"
#include "svoResults.h"
#include "vtkSVORenderPass.h"

#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace
{
constexpr double LightRadius = 0.4; // the objects are 1 high, the light 5 away

using Picture = std::vector<unsigned char>; // RGB

const paper::Experiment& paper4()
{
  const auto& all = paper::experiments();
  return *std::find_if(all.begin(), all.end(),
    [](const paper::Experiment& experiment) { return experiment.name == "paper4"; });
}

/// A way to light the scene, with a renderer of its own in a window that others share.
class Lit
{
public:
  Lit(vtkRenderWindow* window, const paper::Objects& objects, const std::string& name, int soft,
    int occlusion,
    vtkSmartPointer<vtkSVORenderPass> pass = vtkSmartPointer<vtkSVORenderPass>::New())
    : Name(name)
    , Soft(soft)
    , Occlusion(occlusion)
    , Window(window)
    , Shown(paper4(), objects)
    , Pass(std::move(pass))
  {
    this->renderer()->DrawOff();
    window->AddRenderer(this->renderer());
    this->Pass->SetBackendToCPU();
    this->Pass->SetAmbientOcclusion(occlusion > 0);
    this->setSamples(std::max({ soft, occlusion, 1 }));
    vtkSVORenderPass::SetLightSize(soft > 0 ? LightRadius : 0.0, this->light());
    this->renderer()->SetPass(this->Pass);
  }
  ~Lit()
  {
    this->Pass->ReleaseGraphicsResources(this->Window);
    this->renderer()->SetPass(nullptr);
    this->Window->RemoveRenderer(this->renderer());
  }
  Lit(const Lit&) = delete;
  void operator=(const Lit&) = delete;

  vtkSVORenderPass* pass() const { return this->Pass; }
  vtkRenderer* renderer() const { return this->Shown.renderer(); }
  vtkLight* light() const
  {
    return vtkLight::SafeDownCast(this->renderer()->GetLights()->GetItemAsObject(0));
  }
  void setView(int view, double orbit = 0.0)
  {
    this->Shown.setView(paper4().views[static_cast<std::size_t>(view)], orbit);
  }
  void setFrame(int frame) { this->Shown.setFrame(frame); }
  void setSamples(int samples) { this->Pass->SetMaximumLightSamples(samples); }

  /// Milliseconds of the processor.
  double draw()
  {
    this->renderer()->DrawOn();
    const std::clock_t start = std::clock();
    this->Window->Render();
    this->Window->WaitForCompletion();
    const double time = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    this->renderer()->DrawOff();
    this->Whole = this->Whole && this->Pass->GetNumberOfTracedActors() > 0 &&
      this->Pass->GetNumberOfRasterizedActors() == 0;
    return time;
  }
  Picture picture()
  {
    this->draw();
    const int* size = this->Window->GetSize();
    vtkNew<vtkUnsignedCharArray> pixels;
    this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
    return Picture(pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues());
  }
  /// False if the rasteriser drew something in any frame.
  bool whole() const { return this->Whole; }

  const std::string Name;
  const int Soft, Occlusion; // samples; 0: none of it
  std::vector<double> Times, Rays;

private:
  vtkRenderWindow* Window;
  paper::Scene Shown;
  vtkSmartPointer<vtkSVORenderPass> Pass;
  bool Whole = true;
};

bool complain(const std::string& what)
{
  std::fprintf(stderr, "BenchmarkSoftLight: %s\n", what.c_str());
  return false;
}

class Benchmark
{
public:
  Benchmark(const paper::Objects& objects, svobench::Results& results)
    : Objects(objects)
    , Out(results)
  {
    this->Window->SetOffScreenRendering(true);
    this->Window->SetMultiSamples(0);
  }
  ~Benchmark() { this->Window->Finalize(); }
  Benchmark(const Benchmark&) = delete;
  void operator=(const Benchmark&) = delete;

  void setSize(const int size[2]) { this->Window->SetSize(size[0], size[1]); }
  bool time(int frames);
  bool error(const std::string& kind, int most);
  bool nothingSoft();
  bool interactive(int cores, double rate, int frames);

private:
  svobench::Row row(const char* experiment) const
  {
    svobench::Row row;
    row["experiment"] = experiment;
    row["width"] = this->Window->GetSize()[0];
    row["height"] = this->Window->GetSize()[1];
    row["threads"] = vtkSMPTools::GetEstimatedNumberOfThreads();
    return row;
  }
  std::unique_ptr<Lit> lit(const std::string& name, int soft, int occlusion)
  {
    return std::make_unique<Lit>(this->Window, this->Objects, name, soft, occlusion);
  }

  const paper::Objects& Objects;
  svobench::Results& Out;
  vtkNew<vtkRenderWindow> Window;
};

bool Benchmark::time(int frames)
{
  std::vector<std::unique_ptr<Lit>> ways;
  ways.push_back(this->lit("point light", 0, 0));
  for (const int samples : { 4, 8, 16 })
  {
    ways.push_back(this->lit("occlusion", 0, samples));
    ways.push_back(this->lit("soft light", samples, 0));
  }
  ways.push_back(this->lit("both", 4, 4));
  bool good = true;
  for (const bool retraced : { true, false })
  {
    for (const auto& way : ways)
    {
      way->Times.clear();
      way->Rays.clear();
      way->pass()->SetFrameCoherence(!retraced);
    }
    for (int view = 0; view < static_cast<int>(paper4().views.size()); ++view)
    {
      for (int i = -1; i < frames; ++i) // the first warms up
      {
        for (const auto& way : ways)
        {
          way->setView(view);
          way->setFrame(retraced ? (i + 1) * paper::Scene::period() / (frames + 1) : 0);
          // Of the look, and of nothing that is kept; less than a grey level.
          way->pass()->SetShadowIntensity(i % 2 ? 1.0 : 0.999);
          const double time = way->draw();
          if (i >= 0)
          {
            way->Times.push_back(time);
            way->Rays.push_back(static_cast<double>(way->pass()->GetNumberOfShadowRays()));
            if (!retraced && way->pass()->GetNumberOfRetracedLayers() > 0)
            {
              good = complain("what is still was traced anew");
            }
          }
        }
      }
    }
    const double point = performance::median(ways.front()->Times);
    const auto few = [&](const Lit& way)
    {
      return std::find_if(
        ways.begin(), ways.end(), [&](const auto& other) { return other->Name == way.Name; })
        ->get();
    };
    for (const auto& way : ways)
    {
      svobench::Row row = this->row("time");
      row["situation"] = retraced ? "retraced" : "shaded";
      row["method"] = way->Name;
      row["samples"] = std::max(way->Soft, way->Occlusion);
      const double time = performance::median(way->Times), rays = performance::median(way->Rays);
      row["processorMs"] = time;
      row["rays"] = rays;
      if (way != ways.front())
      {
        row["beyondMs"] = time - point;
      }
      const Lit* fewer = few(*way);
      if (fewer != way.get())
      {
        row["raysPerSecond"] = (rays - performance::median(fewer->Rays)) /
          (1e-3 * std::max(time - performance::median(fewer->Times), 1e-3));
      }
      this->Out.add(row);
      good = (way->whole() || complain(way->Name + ": the rasteriser drew something")) && good;
    }
  }
  return good;
}

double rms(const Picture& picture, const Picture& truth, const std::vector<bool>& asked)
{
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    if (asked[i / 3])
    {
      sum += std::pow(static_cast<double>(picture[i]) - truth[i], 2);
      ++count;
    }
  }
  return std::sqrt(sum / std::max(count, 1));
}

/// Of the logarithms, by least squares; NaN of less than three.
double slope(const std::vector<int>& samples, const std::vector<double>& errors)
{
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < errors.size() && errors[i] >= 1.0; ++i)
  {
    const double u = std::log(samples[i]), v = std::log(errors[i]);
    n += 1, x += u, y += v, xx += u * u, xy += u * v;
  }
  return n < 3 ? std::nan("") : (n * xy - x * y) / (n * xx - x * x);
}

bool Benchmark::error(const std::string& kind, int most)
{
  const bool soft = kind == "soft light";
  const auto way = this->lit(kind, soft ? most : 0, soft ? 0 : most);
  way->pass()->SetFilterLightSamples(false);
  const Picture truth = way->picture();
  Picture dark(truth.size(), 0); // what is closed off all around
  Picture bright;
  {
    // By nothing of what is asked.
    const auto other = this->lit(kind, 0, 0);
    if (soft)
    {
      other->pass()->SetShadowTechniqueToNone();
    }
    bright = other->picture();
    if (soft)
    {
      other->light()->SetDiffuseColor(0.0, 0.0, 0.0);
      other->light()->SetSpecularColor(0.0, 0.0, 0.0);
      dark = other->picture();
    }
  }
  const std::vector<bool> all(truth.size() / 3, true);
  std::vector<bool> between(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const auto isOf = [&](const Picture& other)
    { return std::equal(&truth[3 * i], &truth[3 * i] + 3, &other[3 * i]); };
    between[i] = !isOf(dark) && !isOf(bright);
  }
  const auto share = static_cast<double>(std::count(between.begin(), between.end(), true)) /
    static_cast<double>(all.size());
  std::vector<int> counts;
  std::vector<double> errors;
  bool good = share > 0.0 || complain(kind + ": nothing is between the extremes");
  for (int samples = 1; samples <= most / 8; samples *= 2)
  {
    way->setSamples(samples);
    const Picture picture = way->picture();
    if (way->pass()->GetNumberOfLightSamples() != samples)
    {
      good = complain(kind + ": another number of samples than was asked for");
    }
    counts.push_back(samples);
    errors.push_back(rms(picture, truth, between));
    svobench::Row row = this->row("error");
    row["method"] = kind;
    row["samples"] = samples;
    row["truthSamples"] = most;
    row["betweenShare"] = share;
    row["betweenError"] = errors.back();
    row["error"] = rms(picture, truth, all);
    way->pass()->SetFilterLightSamples(true);
    const Picture filtered = way->picture();
    way->pass()->SetFilterLightSamples(false);
    row["filteredBetweenError"] = rms(filtered, truth, between);
    row["filteredError"] = rms(filtered, truth, all);
    this->Out.add(row);
    // Below half a grey level it is roundings.
    if (errors.size() > 1 && errors.back() > 0.5 && errors.back() >= errors[errors.size() - 2])
    {
      good = complain(kind + ": the error does not fall");
    }
  }
  svobench::Row row = this->row("error");
  row["method"] = kind;
  row["slope"] = slope(counts, errors);
  this->Out.add(row);
  return (way->whole() || complain(kind + ": the rasteriser drew something")) && good;
}

bool Benchmark::interactive(int cores, double rate, int frames)
{
  performance::PhasesOfFrame phases;
  Lit shown(
    this->Window, this->Objects, "interactive", 4, 4, performance::makePass(phases, true, cores));
  shown.setSamples(32);
  shown.setFrame(0);
  const std::string key = "tracerCores" + std::to_string(cores) + "Ms";
  std::vector<double> times, distances, means, wrongs;
  std::vector<Picture> quick;
  const int warmUp = 4;
  for (const bool still : { false, true })
  {
    this->Window->SetDesiredUpdateRate(still ? 0.001 : rate);
    for (int i = still ? warmUp : 0; i < warmUp + frames; ++i)
    {
      shown.setView(0, 3.0 * i);
      if (still)
      {
        const performance::PictureDifference off(
          shown.picture(), quick[static_cast<std::size_t>(i)]);
        means.push_back(off.mean);
        wrongs.push_back(off.wrong);
        continue;
      }
      const performance::Moment begin = performance::Moment::now();
      quick.push_back(shown.picture());
      const performance::Phases took = phases(begin, performance::Moment::now());
      if (i >= warmUp)
      {
        times.push_back(took.at("collectMs") + took.at(key) + took.at("presentMs") / 2.0);
        distances.push_back(shown.pass()->GetImageSampleDistance());
      }
    }
  }
  svobench::Row row = this->row("interactive");
  row["cores"] = cores;
  row["rate"] = rate;
  row["frameMs"] = performance::median(times);
  row["sampleDistance"] = performance::median(distances);
  row["meanDifference"] = performance::median(means);
  row["wrongShare"] = performance::median(wrongs);
  this->Out.add(row);
  return shown.whole() || complain("interactive: the rasteriser drew something");
}

bool Benchmark::nothingSoft()
{
  const auto usual = this->lit("usual", 0, 0);
  usual->setSamples(vtkNew<vtkSVORenderPass>()->GetMaximumLightSamples());
  const auto other = this->lit("other settings", 0, 0);
  other->pass()->SetLightError(1.0);
  other->pass()->SetFilterLightSamples(false);
  other->pass()->SetAmbientOcclusionDistance(0.3);
  other->pass()->SetAmbientOcclusionStrength(0.5);
  other->pass()->SetAmbientOcclusionOfAllLight(false);
  int pictures = 0, differing = 0;
  bool good = true;
  for (int view = 0; view < static_cast<int>(paper4().views.size()); ++view)
  {
    for (const auto& way : { usual.get(), other.get() })
    {
      way->setView(view);
    }
    const Picture expected = usual->picture();
    for (const int samples : { 1, 16, 4096 })
    {
      other->setSamples(samples);
      ++pictures;
      differing += other->picture() != expected;
      good = other->pass()->GetNumberOfLightSamples() == 0 && good;
    }
  }
  svobench::Row row = this->row("nothingSoft");
  row["pictures"] = pictures;
  row["differing"] = differing;
  this->Out.add(row);
  return (differing == 0 && good && usual->whole() && other->whole()) ||
    complain("settings of soft lights change pictures without them");
}
}

int main(int argc, char** argv)
{
  int size[2] = { 1920, 1080 }, errorSize[2] = { 320, 180 }, frames = 3, truth = 2048;
  std::string fileOfA, fileOfB, json, experiments = "nothingSoft,time,interactive,error";
  for (int i = 1; i < argc; i += 2)
  {
    const std::string name = argv[i], argument = i + 1 < argc ? argv[i + 1] : "";
    if (name == "--a")
    {
      fileOfA = argument;
    }
    else if (name == "--b")
    {
      fileOfB = argument;
    }
    else if (name == "--size")
    {
      std::sscanf(argument.c_str(), "%dx%d", &size[0], &size[1]);
    }
    else if (name == "--errorSize")
    {
      std::sscanf(argument.c_str(), "%dx%d", &errorSize[0], &errorSize[1]);
    }
    else if (name == "--frames")
    {
      frames = std::max(std::atoi(argument.c_str()), 1);
    }
    else if (name == "--truth")
    {
      truth = std::clamp(std::atoi(argument.c_str()), 32, 4096);
    }
    else if (name == "--experiments")
    {
      experiments = argument;
    }
    else if (name == "--json")
    {
      json = argument;
    }
    else
    {
      std::fprintf(stderr, "BenchmarkSoftLight: what is %s?\n", name.c_str());
      return 2;
    }
  }
  paper::Meshes meshes;
  paper::Objects objects;
  std::string problem;
  if (fileOfA.empty() || fileOfB.empty())
  {
    meshes = paper::standInMeshes();
  }
  else if (!paper::readMeshes(fileOfA, fileOfB, meshes, problem))
  {
    std::fprintf(stderr, "BenchmarkSoftLight: %s\n", problem.c_str());
    return 2;
  }
  if (!paper::buildOctrees(
        meshes, 10, [](double) {}, objects, problem))
  {
    std::fprintf(stderr, "BenchmarkSoftLight: %s\n", problem.c_str());
    return 2;
  }
  svobench::Results results(
    { "experiment", "situation", "method", "samples", "processorMs", "beyondMs", "rays",
      "raysPerSecond", "betweenShare", "betweenError", "error", "slope", "pictures", "differing",
      "cores", "rate", "frameMs", "sampleDistance", "meanDifference", "wrongShare" });
  Benchmark benchmark(objects, results);
  benchmark.setSize(size);
  bool good = true;
  const auto asked = [&](const char* name) { return experiments.find(name) != std::string::npos; };
  if (asked("nothingSoft"))
  {
    good = benchmark.nothingSoft() && good;
  }
  if (asked("time"))
  {
    good = benchmark.time(frames) && good;
  }
  if (asked("interactive"))
  {
    const int twoThirds[2] = { size[0] * 2 / 3, size[1] * 2 / 3 };
    benchmark.setSize(twoThirds);
    for (const auto& [cores, rate] :
      std::vector<std::pair<int, double>>{ { 2, 5.0 }, { 2, 2.0 }, { 16, 30.0 }, { 16, 15.0 } })
    {
      good = benchmark.interactive(cores, rate, 2 * frames) && good;
    }
  }
  if (asked("error"))
  {
    benchmark.setSize(errorSize);
    good = benchmark.error("soft light", truth) && good;
    good = benchmark.error("occlusion", truth) && good;
  }
  if (!json.empty() && !results.writeJson(json))
  {
    std::fprintf(stderr, "BenchmarkSoftLight: cannot write %s\n", json.c_str());
    return 1;
  }
  return good ? 0 : 1;
}
