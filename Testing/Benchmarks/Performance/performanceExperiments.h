// The experiments. Each appends its rows to the results; what they vary is in Documentation/
// Performance.md.
#ifndef performanceExperiments_h
#define performanceExperiments_h

#include "performanceContest.h"

#include "meshes.h"

#include <string>
#include <vector>

namespace performance
{
struct Sweep
{
  paper::Meshes meshes;
  std::vector<std::string> scenes{ "paper1a", "paper1b", "paper2", "paper3", "paper4" };
  std::vector<int> triangles{ 10000, 30000, 100000, 300000, 1000000, 3000000, 10000000 };
  std::vector<int> objects{ 1, 10, 100, 1000 };
  std::vector<int> levels{ 6, 7, 8, 9, 10, 11, 12 };
  std::vector<std::pair<int, int>> sizes{ { 640, 360 }, { 1280, 720 }, { 1920, 1080 },
    { 2560, 1440 }, { 3840, 2160 } };
  std::vector<int> ballsOfTen{ 20000, 100000, 1000000 }; // triangles of each
  int subdivisions = 3;                                  // of A where it has a million triangles
  int lights = 4;
  std::pair<int, int> size{ 1920, 1080 };
  bool oursOnly = false; // beside another commit's
  Effort effort{ 12, 30.0 };
};

class Experiments
{
public:
  Experiments(const Sweep& sweep, svobench::Results& results);
  ~Experiments();
  Experiments(const Experiments&) = delete;
  void operator=(const Experiments&) = delete;

  static std::vector<std::string> names();
  /// False, and a message, if there is no such experiment or it cannot be measured.
  bool run(const std::string& name);

private:
  bool scenes();
  bool triangles();
  bool objects();
  bool refined();
  bool levels();
  bool sizes();
  bool openGL();
  bool threads();
  bool cores();
  bool instructionSets();
  bool lights();
  bool lightKit();
  bool shadows();

  /// Octrees of the paper's objects, built when first asked for.
  const paper::Objects& paperObjects();
  /// Octrees of a mesh in the place of A, without B.
  paper::Objects objectsWith(vtkPolyData* a, int level) const;
  bool contest(const Contest& contest);

  using Experiment = bool (Experiments::*)();
  static const std::vector<std::pair<std::string, Experiment>>& all();

  const Sweep& Settings;
  svobench::Results& Out;
  vtkNew<vtkRenderWindow> Window;
  paper::Objects PaperObjects;
};
}

#endif
