// Speed against accuracy: sweeps the settings, measures times, memory and errors against exact
// references (Embree, refined in double; VTK's rasteriser and vtkShadowMapPass on the same axes),
// and writes every measurement to a JSON and a CSV file. Documentation/Accuracy.md has the
// definitions and what came out.
//
//   BenchmarkAccuracy [--output folder] [--images folder] [--short] [--paper a.off b.md2]
//                     [name=file.off:up ...]
//
// `up` is the mesh's upward axis, x, y or z. --short: a generated body and few settings. --paper:
// the paper's objects A and B, else stand-ins. --images: pictures of what is wrong. The exit code
// is 1 if a bar of accuracyBars.cxx is missed.
#include "accuracyBars.h"
#include "accuracyExperiments.h"

#include <iostream>
#include <string>

namespace
{
using namespace accuracy;

bool readShape(const std::string& argument, Sweep& sweep)
{
  const std::size_t equals = argument.find('='), colon = argument.rfind(':');
  if (equals == std::string::npos || colon == std::string::npos || colon < equals)
  {
    return false;
  }
  Mesh mesh;
  std::string error;
  if (!svobench::readFile(argument.substr(equals + 1, colon - equals - 1), mesh, error))
  {
    std::cerr << error << "\n";
    return false;
  }
  normalise(mesh, std::string("xyz").find(argument.substr(colon + 1)));
  mesh.name = argument.substr(0, equals);
  sweep.shapes.push_back(std::make_shared<Shape>(mesh));
  return true;
}
}

int main(int argc, char** argv)
{
  Sweep sweep;
  std::string output = ".";
  for (int i = 1; i < argc; ++i)
  {
    const std::string argument = argv[i];
    if (argument == "--short")
    {
      sweep.brief = true;
    }
    else if (argument == "--paper" && i + 2 < argc)
    {
      sweep.fileOfA = argv[++i];
      sweep.fileOfB = argv[++i];
    }
    else if (argument == "--images" && i + 1 < argc)
    {
      sweep.images = argv[++i];
    }
    else if (argument == "--output" && i + 1 < argc)
    {
      output = argv[++i];
    }
    else if (!readShape(argument, sweep))
    {
      std::cerr << "usage: BenchmarkAccuracy [--output folder] [--images folder] [--short] "
                   "[--paper a.off b.md2] [name=file.off:up ...]\n"
                << argument << " is neither an option nor a readable mesh\n";
      return 2;
    }
  }
  if (sweep.brief || sweep.shapes.empty())
  {
    sweep.shapes = { std::make_shared<Shape>(knot()) };
  }
  if (sweep.brief)
  {
    sweep.levels = { 8, 10 };
    sweep.shadowLevels = { 8, 10 };
    sweep.resolutions = { 2048 };
    sweep.pixelErrorLevel = 10;
    sweep.pixelErrors = { 1.0, 2.0, 4.0 };
    sweep.repeat = 1;
    sweep.size = 256;
  }
  Results results({ "experiment", "mesh", "light", "method", "level", "leaves", "technique",
    "resolution", "bias", "pixelError", "rayMedian", "rayP95", "normalP99", "falseMisses",
    "meshWrong", "meshWrongTolerant", "meshIoU", "mapWrong", "movedP99", "movedMax",
    "beyondPromise", "selfShadowed", "toothed", "throughWall", "gapVoxels", "antiAliasing",
    "filterShadows", "edgeRms", "shadowEdgeRms", "rms", "processorMs" });
  measureLeaves(sweep, results);
  measurePixelError(sweep, results);
  measureContact(sweep, results);
  measureTerminator(sweep, results);
  measureShadows(sweep, results);
  measureAntiAliasing(sweep, results);
  measurePaperScenes(sweep, results);
  const bool good = checkBars(results);
  if (!results.writeJson(output + "/accuracy.json") || !results.writeCsv(output + "/accuracy.csv"))
  {
    std::cerr << "cannot write to " << output << "\n";
    return 2;
  }
  return good ? 0 : 1;
}
