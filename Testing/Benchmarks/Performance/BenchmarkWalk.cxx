// A walk among many objects that stand still, the camera turning by 2 degrees and going on by a
// hundredth of the scene a frame: frames that keep of the last one what is still true
// (FrameCoherence), and frames that do not, by turns. Processor time of frames, ms: their mean,
// their median and the slowest hundredth; means of the phases and of the texels that were traced.
//
//   BenchmarkWalk [--objects 4000] [--triangles 20000] [--frames 300] [--size 1920x1080]
//     [--speed 1] [--shadows none|buffer|rays] [--backend cpu|opengl] [--apart n,n]
//     [--json file] [--pictures prefix]
//
// --speed: so many times as fast. --apart: beside them interactive frames whose rays are so many
// pixels apart, and how far these are from exact ones: mean difference of a channel, and the share
// of the pixels that are off by more than 8 of 255 in one, its mean and its largest.
//
// The exit code is 1 if a picture of the first is not that of the second, to the bit.
#include "performanceCrowd.h"
#include "performancePass.h"
#include "performanceWindow.h"
#include "pictureDifference.h"
#include "svoResults.h"
#include "vtkSVORenderPass.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include <glm/trigonometric.hpp>

namespace
{
struct Options
{
  performance::CrowdOptions crowd;
  int objects = 4000, frames = 300, size[2] = { 1920, 1080 };
  double speed = 1.0;
  std::string shadows = "buffer", backend = "cpu", pictures;
  std::vector<int> apart;
};

/// How frames are made.
struct Method
{
  std::string name;
  bool keeps = true;
  int apart = 1; // pixels, of rays
};

using Picture = std::vector<unsigned char>; // RGB

class Walker
{
public:
  Walker(const Method& method, const Options& options)
    : How(method)
    , Asked(options)
    , Scene(Renderer, options.crowd, options.objects)
  {
    this->Window->SetOffScreenRendering(true);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(options.size[0], options.size[1]);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->SetBackground(0.2, 0.3, 0.4);
    this->Renderer->SetPass(this->Pass);
    this->Pass->SetBackend(options.backend == "opengl" ? vtkSVORenderPass::BACKEND_OPENGL
                                                       : vtkSVORenderPass::BACKEND_CPU);
    // More frames a second than it can make, so that it goes as far as it may.
    this->Pass->SetAutoAdjustSampleDistances(method.apart > 1);
    this->Pass->SetMaximumImageSampleDistance(method.apart);
    this->Window->SetDesiredUpdateRate(method.apart > 1 ? 1e4 : 1e-3);
    this->Pass->SetFrameCoherence(method.keeps);
    this->Pass->SetShadowTechnique(options.shadows == "none" ? vtkSVORenderPass::SHADOW_NONE
        : options.shadows == "rays"                          ? vtkSVORenderPass::SHADOW_RAYS
                                                             : vtkSVORenderPass::SHADOW_BUFFER);
  }
  ~Walker() { this->Window->Finalize(); }
  Walker(const Walker&) = delete;
  void operator=(const Walker&) = delete;

  /// Around the middle of the scene, at half of its width.
  void draw(int frame)
  {
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
    if (frame < 0)
    {
      return;
    }
    this->Times.push_back(end.processor - start.processor);
    for (const auto& phase : this->Phases(start, end))
    {
      this->Sums[phase.first] += phase.second;
    }
    this->Sums["shadowRays"] += static_cast<double>(this->Pass->GetNumberOfShadowRays());
  }
  Picture picture() const
  {
    vtkNew<vtkUnsignedCharArray> pixels;
    this->Window->GetPixelData(0, 0, this->Asked.size[0] - 1, this->Asked.size[1] - 1, 0, pixels);
    return Picture(pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues());
  }
  void compare(const Picture& exact)
  {
    const performance::PictureDifference difference(exact, this->picture());
    this->Difference += difference.mean;
    this->Wrong.push_back(difference.wrong);
  }
  void write(const std::string& name)
  {
    performance::writePicture(this->Window, name + this->How.name + ".png");
  }

  svobench::Row row() const
  {
    std::vector<double> sorted = this->Times;
    std::sort(sorted.begin(), sorted.end());
    const auto count = static_cast<double>(sorted.size());
    svobench::Row row;
    row["method"] = this->How.name;
    row["meanMs"] = std::accumulate(sorted.begin(), sorted.end(), 0.0) / count;
    row["medianMs"] = sorted[sorted.size() / 2];
    row["slowestMs"] = sorted[sorted.size() - 1 - sorted.size() / 100];
    for (const char* phase :
      { "collectMs", "eyeMs", "markMs", "lightsMs", "shadeMs", "presentMs", "shadowRays" })
    {
      row[phase] = this->Sums.at(phase) / count;
    }
    if (!this->Wrong.empty())
    {
      row["meanDifference"] = this->Difference / count;
      row["wrongShare"] = std::accumulate(this->Wrong.begin(), this->Wrong.end(), 0.0) / count;
      row["largestWrongShare"] = *std::max_element(this->Wrong.begin(), this->Wrong.end());
    }
    return row;
  }

private:
  const Method How;
  const Options Asked;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  performance::PhasesOfFrame Phases;
  vtkSmartPointer<vtkSVORenderPass> Pass = performance::makePass(Phases, false);
  performance::Crowd Scene;
  std::vector<double> Times, Wrong;
  double Difference = 0.0; // a sum
  performance::Phases Sums;
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
    else if (name == "--speed")
    {
      options.speed = std::atof(value.c_str());
    }
    else if (name == "--shadows")
    {
      options.shadows = value;
    }
    else if (name == "--backend")
    {
      options.backend = value;
    }
    else if (name == "--apart")
    {
      std::istringstream numbers(value);
      for (std::string number; std::getline(numbers, number, ',');)
      {
        options.apart.push_back(std::max(std::atoi(number.c_str()), 2));
      }
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
  svobench::Results results(
    { "method", "meanMs", "medianMs", "slowestMs", "collectMs", "eyeMs", "markMs", "lightsMs",
      "shadeMs", "presentMs", "shadowRays", "meanDifference", "wrongShare", "largestWrongShare" });
  std::vector<Method> methods{ { "kept" }, { "fresh", false } };
  for (const int apart : options.apart)
  {
    methods.push_back({ "apart" + std::to_string(apart), true, apart });
  }
  std::vector<std::unique_ptr<Walker>> walkers;
  for (const Method& method : methods)
  {
    walkers.push_back(std::make_unique<Walker>(method, options));
  }
  int different = 0;
  for (int frame = -2; frame < options.frames; ++frame)
  {
    for (const auto& walker : walkers)
    {
      walker->draw(frame);
    }
    const Picture exact = walkers[0]->picture();
    different += exact != walkers[1]->picture();
    for (std::size_t i = 0; i < walkers.size(); ++i)
    {
      if (i > 1 && frame >= 0)
      {
        walkers[i]->compare(exact);
      }
      if (!options.pictures.empty() && frame % 10 == 9)
      {
        walkers[i]->write(options.pictures + std::to_string(frame));
      }
    }
  }
  for (const auto& walker : walkers)
  {
    results.add(walker->row());
  }
  if (different > 0)
  {
    std::fprintf(stderr, "BenchmarkWalk: %d pictures differ\n", different);
  }
  if (!json.empty() && !results.writeJson(json))
  {
    std::fprintf(stderr, "BenchmarkWalk: cannot write %s\n", json.c_str());
    return 1;
  }
  return different > 0 ? 1 : 0;
}
