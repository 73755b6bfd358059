// Times the scenes with each way of drawing them.
#ifndef PaperScenes_measure_h
#define PaperScenes_measure_h

#include "scenes.h"

#include <vtkRenderPass.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace paper
{
enum class Technique
{
  Octrees,    ///< vtkSVORenderPass
  ShadowMaps, ///< VTK's rasteriser with vtkShadowMapPass
  Rasterizer, ///< VTK's rasteriser, no shadows
  Empty       ///< a renderer without props
};

/// One way of drawing, a row of the table.
struct Method
{
  Technique technique;
  std::string name; ///< also the key in the JSON file
  std::string title;
  LightKind light = LightKind::Point;
  bool frameCoherence = true;
  double pixelError = 1;
};

/// All rows, in the table's order.
const std::vector<Method>& methods();

/// Back to VTK's own way of drawing; the pass's OpenGL objects are freed.
void removePass(vtkRenderer* renderer);
/// VTK's shadow maps as a pass of a renderer.
vtkSmartPointer<vtkRenderPass> shadowMaps(int resolution);
/// Sets the renderer up for a method. @a shadowMapResolution is that of both shadow techniques.
void useMethod(const Method& method, vtkRenderer* renderer, int shadowMapResolution);
/// vtkSVORenderPass's default.
int defaultShadowMapResolution();

struct Sample
{
  double milliseconds;
  double processorMilliseconds; ///< of all threads
};

/// Draws a frame; its time is that from Render() to the end of WaitForCompletion().
Sample draw(vtkRenderWindow* window);

struct Timing
{
  double medianMilliseconds = 0;
  double slowestMilliseconds = 0;
  /// Processor time of all threads, also median: what a frame costs on a machine that is busy.
  double processorMilliseconds = 0;
  int frames = 0;
  /// What vtkSVORenderPass says about the last frame; empty for other techniques.
  std::map<std::string, double> statistics;
  double framesPerSecond() const;
};

/**
 * Draws @a framesPerView frames of every viewpoint, spread over the whole animation, and times
 * each. Two frames a viewpoint warm up, untimed.
 */
Timing timeFrames(vtkRenderWindow* window, Scene& scene, int framesPerView,
  const std::function<void()>& afterFrame);
Timing timeEmptyFrames(vtkRenderWindow* window, int frames);

/// Share of the pixels that the objects (not the ground) cover, on average over the animation, for
/// each viewpoint. Draws with VTK's rasteriser, and every pose once, so that all are uploaded.
std::vector<double> objectCoverage(vtkRenderWindow* window, Scene& scene);
}

#endif
