// What frames cost: vtkSVORenderPass beside VTK's rasteriser without shadows and with
// vtkShadowMapPass, in turn, frame by frame, in wall and processor time and by phase. Writes each
// measurement to a JSON file; run-performance.sh makes tables and plots of it.
//
//   BenchmarkFrames [--a dragon.off --b sydney.md2] [--experiments name,...]
//                   [--scenes name,...] [--triangles n,...] [--size WxH] [--output file.json]
//                   [--frames n]
//                   [--seconds s] [--ours] [--short]
//
// --frames: timed for each figure, of all viewpoints together. --seconds: for each figure; where
// that is too short there are fewer frames.
// --ours: not VTK's own. --short: few, small and generated things; the figures mean nothing. The
// exit code is 1 if something could not be measured.
#include "performanceExperiments.h"

#include <cstdlib>
#include <exception>
#include <iostream>
#include <sstream>
#include <string>

namespace
{
void shorten(performance::Sweep& sweep)
{
  sweep.scenes = { "paper1a", "paper2" };
  sweep.triangles = { 2000, 8000 };
  sweep.ballsOfTen = { 2000 };
  sweep.objects = { 1, 9 };
  sweep.levels = { 6, 8 };
  sweep.sizes = { { 96, 54 }, { 192, 108 } };
  sweep.subdivisions = 1;
  sweep.lights = 2;
  sweep.size = { 192, 108 };
  sweep.effort = { 3, 60.0 };
}

std::vector<std::string> namesIn(const std::string& list)
{
  std::vector<std::string> names;
  std::istringstream text(list);
  for (std::string name; std::getline(text, name, ',');)
  {
    names.push_back(name);
  }
  return names;
}
}

int main(int argc, char** argv)
{
  performance::Sweep sweep;
  std::vector<std::string> names = performance::Experiments::names();
  std::string fileOfA, fileOfB, output;
  for (int i = 1; i < argc; ++i)
  {
    const std::string argument = argv[i];
    const bool more = i + 1 < argc;
    if (argument == "--short")
    {
      shorten(sweep);
    }
    else if (argument == "--ours")
    {
      sweep.oursOnly = true;
    }
    else if (argument == "--a" && more)
    {
      fileOfA = argv[++i];
    }
    else if (argument == "--b" && more)
    {
      fileOfB = argv[++i];
    }
    else if (argument == "--output" && more)
    {
      output = argv[++i];
    }
    else if (argument == "--frames" && more)
    {
      sweep.effort.frames = std::max(1, std::atoi(argv[++i]));
    }
    else if (argument == "--seconds" && more)
    {
      sweep.effort.seconds = std::atof(argv[++i]);
    }
    else if (argument == "--experiments" && more)
    {
      names = namesIn(argv[++i]);
    }
    else if (argument == "--triangles" && more)
    {
      sweep.triangles.clear();
      for (const std::string& count : namesIn(argv[++i]))
      {
        sweep.triangles.push_back(std::atoi(count.c_str()));
      }
    }
    else if (argument == "--size" && more)
    {
      char times = 0;
      std::istringstream(argv[++i]) >> sweep.size.first >> times >> sweep.size.second;
    }
    else if (argument == "--scenes" && more)
    {
      sweep.scenes = namesIn(argv[++i]);
    }
    else
    {
      std::cerr << "usage: BenchmarkFrames [--a file --b file] [--experiments name,...] "
                   "[--scenes name,...] [--triangles n,...] [--size WxH] [--output "
                   "file.json] [--frames n] "
                   "[--seconds s] [--ours] [--short]\n";
      return 2;
    }
  }
  std::string error;
  if (fileOfA.empty() || fileOfB.empty())
  {
    sweep.meshes = paper::standInMeshes();
  }
  else if (!paper::readMeshes(fileOfA, fileOfB, sweep.meshes, error))
  {
    std::cerr << error << "\n";
    return 2;
  }
  svobench::Results results({ "experiment", "scene", "situation", "method", "triangles", "objects",
    "level", "lights", "width", "height", "threads", "instructionSet", "frames", "wallMs",
    "processorMs", "collectMs", "eyeMs", "markMs", "lightsMs", "shadeMs", "presentMs" });
  bool good = true, written = true;
  try
  {
    performance::Experiments experiments(sweep, results);
    for (const std::string& name : names)
    {
      good = experiments.run(name) && good;
      written = output.empty() || results.writeJson(output); // of what there is so far
    }
  }
  catch (const std::exception& problem)
  {
    std::cerr << "BenchmarkFrames: " << problem.what() << "\n";
    good = false;
  }
  if (!written)
  {
    std::cerr << "cannot write " << output << "\n";
    return 2;
  }
  return good ? 0 : 1;
}
