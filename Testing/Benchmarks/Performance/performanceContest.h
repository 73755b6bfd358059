// Ways of drawing a scene, timed frame by frame in turn.
//
// All of them live in one window at the same time, each with a renderer, actors and mappers of its
// own, and each frame is drawn by one after the other: whatever else a machine is busy with meets
// them alike, so that ratios of their medians mean something where times themselves do not.
#ifndef performanceContest_h
#define performanceContest_h

#include "measure.h"
#include "performancePass.h"
#include "svoResults.h"

#include <functional>
#include <string>
#include <vector>

namespace performance
{
/// What changes from frame to frame.
enum class Situation
{
  Retraced, ///< the animation, its frames far apart, and nothing kept of the frame before
  All,      ///< all objects move a little
  One,      ///< one object moves a little
  Camera,   ///< the camera orbits
  Nothing
};
const char* nameOf(Situation situation);

/// A way of drawing.
struct Method
{
  std::string name; ///< "method" in the rows
  paper::Technique technique;
  paper::LightKind light;
  std::function<void(vtkSVORenderPass*)> settings; ///< may be empty
  std::string instructionSet;                      ///< svobench::useInstructionSet()
  bool simulatesCores = false;                     ///< makePass()
  bool phases = true; ///< timed; else the pass is as it is, with the tracer that it makes itself
};

struct Contest
{
  const paper::Experiment* experiment;
  const paper::Objects* objects;
  std::vector<Method> methods;
  std::vector<Situation> situations;
  svobench::Row row;                          ///< keys that all rows have
  std::function<void(paper::Scene&)> furnish; ///< further lights; may be empty
};

struct Effort
{
  int frames;     ///< timed, of each method in a situation, from all viewpoints together
  double seconds; ///< for a situation; where that is too short for them there are fewer frames
};

/// Adds a row for each situation and method: medians and quartiles over the frames. False, with a
/// message, if anything of a scene was left to the rasteriser: then it is not what is timed.
bool run(vtkRenderWindow* window, const Contest& contest, const Effort& effort,
  svobench::Results& results);
}

#endif
