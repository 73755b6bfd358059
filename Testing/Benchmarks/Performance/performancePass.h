// vtkSVORenderPass with a stopwatch.
#ifndef performancePass_h
#define performancePass_h

#include "vtkSVORenderPass.h"

#include <vtkSmartPointer.h>

#include <functional>
#include <map>
#include <string>

namespace performance
{
/// Milliseconds of the clock, and of processor time of all threads.
struct Moment
{
  double wall;
  double processor;
  static Moment now();
};

/// Milliseconds by key: "eyeMs" is processor time, "eyeWallMs" that of the clock.
using Phases = std::map<std::string, double>;

/// What the phases of a frame took that was drawn between two moments. "collect" is what comes
/// before the tracer, VTK's own beginning included, "present" what comes after it, VTK's own
/// drawing included, so that the phases add up to the frame. Empty of a commit whose frames do not
/// tell.
using PhasesOfFrame = std::function<Phases(const Moment& begin, const Moment& end)>;

/// With `simulatesCores` frames are traced on one core, and there is "eyeCores16Ms" besides, what
/// the phase would take on 16 (performanceCores.h), for each of SimulatedCores, and "eyeSerialMs",
/// what of it one core does alone; likewise for "tracer", all of the tracer.
/// `paceCores`: which of these cores interactive frames keep to their time by; 0: those that there
/// are.
vtkSmartPointer<vtkSVORenderPass> makePass(
  PhasesOfFrame& phases, bool simulatesCores, int paceCores = 0);
constexpr int SimulatedCores[] = { 1, 2, 16, 64 };
}

#endif
