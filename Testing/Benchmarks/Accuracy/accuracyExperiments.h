// The experiments. Each appends its rows to the results; what they vary is in Documentation/
// Accuracy.md.
#ifndef accuracyExperiments_h
#define accuracyExperiments_h

#include "accuracyMetrics.h"
#include "accuracyStage.h"

#include <memory>
#include <string>
#include <vector>

namespace accuracy
{
struct Sweep
{
  std::vector<std::shared_ptr<const Shape>> shapes;
  std::vector<int> levels{ 5, 6, 7, 8, 9, 10, 11, 12, 13 };
  std::vector<int> shadowLevels{ 7, 8, 9, 10, 11, 12 };
  std::vector<int> resolutions{ 256, 512, 1024, 2048, 4096, 8192 };
  std::vector<double> pixelErrors{ 0.5, 1.0, 2.0, 4.0, 8.0 };
  int pixelErrorLevel = 12; // of the octrees that these stop in
  int size = 512;           // pixels along an edge of the pictures
  int repeat = 2;           // times each timed frame is drawn; the least time counts
  bool brief = false;       // one of the paper's scenes
  std::string fileOfA;      // the paper's objects; empty: generated stand-ins
  std::string fileOfB;
  std::string images; // folder for difference images; empty: none
};

extern const std::vector<std::pair<svo::LeafGeometry, const char*>> LeafGeometries;

/// Draws with the tracer; times go into the row: processorMs, traceMs, shadowMs of the fastest of
/// the repetitions, none of which reuses anything of another.
Picture traced(const svo::Scene& scene, const svo::View& view, svo::FrameSettings settings,
  int repeat, Row& row);

/// Depth, silhouette and normals against levels and leaf geometries; the object fills the window.
void measureLeaves(const Sweep& sweep, Results& results);

/// The lights that every object is put under, by name: directional, spot, point (one map) and near
/// point (six faces).
std::vector<std::pair<std::string, svo::Light>> lightsAround();
/// An object on a ground that fills the window.
Stage groundStage(const std::shared_ptr<const Shape>& shape, int size);

/// Shadows of an object on a ground and on itself.
void measureShadows(const Sweep& sweep, Results& results);

/// Displacement on the screen, error and time against the pixel error.
void measurePixelError(const Sweep& sweep, Results& results);

/// The paper's scenes, all methods.
void measurePaperScenes(const Sweep& sweep, Results& results);

/// Edges with and without anti-aliasing.
void measureAntiAliasing(const Sweep& sweep, Results& results);

/// Acne on a convex body, and the beginning of a contact shadow.
void measureContact(const Sweep& sweep, Results& results);

/// Few facets with smooth normals: shadows on themselves, and light through a wall above them.
void measureTerminator(const Sweep& sweep, Results& results);
}

#endif
