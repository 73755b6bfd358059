// A walk among many objects that stand still, the camera turning by 2 degrees and going on by a
// hundredth of the scene a frame: exact frames, and those that show the last one's pixels where
// they are now (ImageCacheError), by turns; then rays that lie apart in the same time. Processor
// time of frames, ms: their mean, median, and the slowest hundredth; and what differs from exact
// frames, in the mean of a channel, and the share of pixels by more than 8 of 255 in one.
//
//   BenchmarkWalk [--objects 4000] [--triangles 20000] [--frames 300] [--size 1920x1080]
//     [--error 1] [--speed 1] [--shadows none|buffer|rays] [--json file] [--pictures prefix]
//
// --speed: so many times as fast.
//
// The exit code is 1 if nothing was shown again.
#include "performanceCrowd.h"
#include "performancePass.h"
#include "performanceWindow.h"
#include "svoResults.h"
#include "vtkSVORenderPass.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <glm/trigonometric.hpp>

namespace
{
struct Options
{
  performance::CrowdOptions crowd;
  int objects = 4000, frames = 300, size[2] = { 1920, 1080 };
  double error = 1.0, speed = 1.0;
  std::string shadows = "buffer", pictures;
};

using Picture = std::vector<unsigned char>; // RGB

class Walker
{
public:
  Walker(const std::string& name, const Options& options)
    : Name(name)
    , Asked(options)
    , Scene(Renderer, options.crowd, options.objects)
  {
    this->Window->SetOffScreenRendering(true);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(options.size[0], options.size[1]);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->SetBackground(0.2, 0.3, 0.4);
    this->Renderer->SetPass(this->Pass);
    this->Pass->SetBackendToCPU();
    this->Pass->SetAutoAdjustSampleDistances(false);
    this->Pass->SetShadowTechnique(options.shadows == "none" ? vtkSVORenderPass::SHADOW_NONE
        : options.shadows == "rays"                          ? vtkSVORenderPass::SHADOW_RAYS
                                                             : vtkSVORenderPass::SHADOW_BUFFER);
    this->Window->SetDesiredUpdateRate(10.0);
  }
  ~Walker() { this->Window->Finalize(); }
  Walker(const Walker&) = delete;
  void operator=(const Walker&) = delete;

  vtkSVORenderPass* pass() { return this->Pass; }
  vtkRenderWindow* window() { return this->Window; }
  void draw(int frame)
  {
    // Around the middle of the scene, at half of its width.
    const double half = 1.5 * std::ceil(std::sqrt(this->Asked.objects));
    const double step = 0.02 * half, turn = glm::radians(2.0);
    const double radius = step / turn, angle = turn * this->Asked.speed * frame;
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    camera->SetPosition(x, y, 5.0);
    camera->SetFocalPoint(x - 10.0 * std::sin(angle), y + 10.0 * std::cos(angle), 3.0);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetViewAngle(40.0);
    camera->SetClippingRange(0.1, 4.0 * half);
    const performance::Moment start = performance::Moment::now();
    this->Window->Render();
    this->Window->WaitForCompletion();
    const performance::Moment end = performance::Moment::now();
    this->Times.push_back(end.processor - start.processor);
    for (const auto& phase : this->Phases(start, end))
    {
      this->Sums[phase.first] += phase.second;
    }
    this->Shown += this->Pass->GetImageCacheShare();
    this->Distances.push_back(this->Pass->GetImageSampleDistance());
  }
  Picture picture() const
  {
    vtkNew<vtkUnsignedCharArray> pixels;
    this->Window->GetPixelData(0, 0, this->Asked.size[0] - 1, this->Asked.size[1] - 1, 0, pixels);
    return Picture(pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues());
  }
  void compare(const Picture& exact, const Picture& mine)
  {
    double sum = 0.0;
    int wrong = 0;
    for (std::size_t p = 0; p < exact.size(); p += 3)
    {
      int most = 0;
      for (std::size_t c = p; c < p + 3; ++c)
      {
        const int difference = std::abs(exact[c] - mine[c]);
        sum += difference;
        most = std::max(most, difference);
      }
      wrong += most > 8;
    }
    this->Mean.push_back(sum / static_cast<double>(exact.size()));
    this->Wrong.push_back(3.0 * wrong / static_cast<double>(exact.size()));
  }
  void write(const std::string& name)
  {
    vtkNew<vtkWindowToImageFilter> grab;
    grab->SetInput(this->Window);
    grab->ShouldRerenderOff();
    grab->ReadFrontBufferOff();
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(grab->GetOutputPort());
    writer->SetFileName(name.c_str());
    writer->Write();
  }

  static double mean(const std::vector<double>& all)
  {
    return all.empty()
      ? 0.0
      : std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
  }
  double meanTime() const { return mean(this->Times); }
  svobench::Row row() const
  {
    std::vector<double> sorted = this->Times;
    std::sort(sorted.begin(), sorted.end());
    svobench::Row row;
    row["method"] = this->Name;
    row["meanMs"] = this->meanTime();
    row["medianMs"] = sorted[sorted.size() / 2];
    row["slowestMs"] = sorted[sorted.size() - 1 - sorted.size() / 100];
    for (const char* phase : { "collectMs", "eyeMs", "markMs", "lightsMs", "shadeMs", "presentMs" })
    {
      row[phase] = this->Sums.at(phase) / static_cast<double>(this->Times.size());
    }
    row["shownAgain"] = this->Shown / static_cast<double>(this->Times.size());
    row["sampleDistance"] = mean(this->Distances);
    row["meanDifference"] = mean(this->Mean);
    row["wrongShare"] = mean(this->Wrong);
    row["largestWrongShare"] =
      this->Wrong.empty() ? 0.0 : *std::max_element(this->Wrong.begin(), this->Wrong.end());
    return row;
  }
  void forget()
  {
    this->Times.clear();
    this->Distances.clear();
    this->Sums.clear();
    this->Shown = 0.0;
  }
  double shown() const { return this->Shown; }

private:
  const std::string Name;
  const Options Asked;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  performance::PhasesOfFrame Phases;
  vtkSmartPointer<vtkSVORenderPass> Pass = performance::makePass(Phases, false);
  performance::Crowd Scene;
  std::vector<double> Times, Distances, Mean, Wrong;
  performance::Phases Sums;
  double Shown = 0.0; // share of the picture, a sum
};
}

int main(int argc, char** argv)
{
  Options options;
  std::string json;
  for (int i = 1; i < argc; i += 2)
  {
    const std::string name = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
    if (name == "--objects")
    {
      options.objects = std::max(std::atoi(value.c_str()), 1);
    }
    else if (name == "--triangles")
    {
      options.crowd.triangles = std::max(std::atoi(value.c_str()), 16);
    }
    else if (name == "--frames")
    {
      options.frames = std::max(std::atoi(value.c_str()), 2);
    }
    else if (name == "--size")
    {
      std::sscanf(value.c_str(), "%dx%d", &options.size[0], &options.size[1]);
    }
    else if (name == "--error")
    {
      options.error = std::atof(value.c_str());
    }
    else if (name == "--speed")
    {
      options.speed = std::atof(value.c_str());
    }
    else if (name == "--shadows")
    {
      options.shadows = value;
    }
    else if (name == "--json")
    {
      json = value;
    }
    else if (name == "--pictures")
    {
      options.pictures = value;
    }
    else
    {
      std::fprintf(stderr, "BenchmarkWalk: what is %s?\n", name.c_str());
      return 2;
    }
  }
  svobench::Results results({ "method", "meanMs", "medianMs", "slowestMs", "collectMs", "eyeMs",
    "markMs", "lightsMs", "shadeMs", "presentMs", "shownAgain", "sampleDistance", "meanDifference",
    "wrongShare", "largestWrongShare" });
  Walker exact("exact", options);
  auto cached = std::make_unique<Walker>("cached", options);
  cached->pass()->SetImageCacheError(options.error);
  for (int frame = -2; frame < options.frames; ++frame)
  {
    for (Walker* walker : { &exact, cached.get() })
    {
      walker->draw(frame);
    }
    if (frame < 0)
    {
      exact.forget();
      cached->forget();
      continue;
    }
    cached->compare(exact.picture(), cached->picture());
    if (!options.pictures.empty() && frame % 50 == 49)
    {
      exact.write(options.pictures + "exact" + std::to_string(frame) + ".png");
      cached->write(options.pictures + "cached" + std::to_string(frame) + ".png");
    }
  }
  results.add(exact.row());
  results.add(cached->row());
  const double time = cached->meanTime();
  const bool good = cached->shown() > 0.0;
  cached.reset();
  Walker apart("apart", options);
  apart.pass()->SetAutoAdjustSampleDistances(true);
  // It keeps to half of a frame's time, by the clock.
  apart.window()->SetDesiredUpdateRate(1e3 / time);
  const int fewer = std::min(options.frames, 60);
  exact.forget();
  for (int frame = -8; frame < fewer; ++frame)
  {
    apart.draw(frame);
    if (frame < 0)
    {
      apart.forget();
      continue;
    }
    exact.draw(frame);
    apart.compare(exact.picture(), apart.picture());
  }
  results.add(apart.row());
  if (!json.empty() && !results.writeJson(json))
  {
    std::fprintf(stderr, "BenchmarkWalk: cannot write %s\n", json.c_str());
    return 1;
  }
  return good ? 0 : 1;
}
