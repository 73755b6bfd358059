// The figures of a run, as a table for people and as JSON for programs.
#ifndef PaperScenes_report_h
#define PaperScenes_report_h

#include "measure.h"

#include <map>
#include <string>
#include <vector>

namespace paper
{
struct SceneFigures
{
  std::string name;
  std::string objects;
  vtkIdType trianglesShown = 0;
  vtkIdType trianglesInMemory = 0;
  double buildSeconds = 0;
  double octreeMebibytes = 0;
  vtkIdType voxels = 0;
  std::vector<std::string> viewpoints;
  std::vector<double> coverage;          ///< share of the pixels, one for each viewpoint
  std::map<std::string, Timing> timings; ///< by Method::name
  std::string paperFramesPerSecond;
};

struct Figures
{
  int size[2] = { 0, 0 };
  int level = 0;
  int shadowMapResolution = 0;
  int framesPerMedian = 0;
  unsigned int processors = 0;
  std::string processor;      ///< what it calls itself
  std::string instructionSet; ///< the one that octrees are traced with
  std::string openGL;
  std::string vtkVersion;
  std::string sourceOfA;
  std::string sourceOfB;
  vtkIdType trianglesOfA = 0;
  vtkIdType trianglesOfB = 0;
  std::vector<SceneFigures> scenes;
};

/// The table, ready to print; at most 100 columns wide.
std::string table(const Figures& figures);
/// False if the file cannot be written.
bool writeJson(const Figures& figures, const std::string& path);
}

#endif
