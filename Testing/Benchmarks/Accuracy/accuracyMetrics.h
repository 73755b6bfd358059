// The measures of error. Documentation/Accuracy.md defines them in words.
#ifndef accuracyMetrics_h
#define accuracyMetrics_h

#include "accuracyReference.h"

#include "svoCPUTracer.h"
#include "svoResults.h"

#include <cstdint>
#include <string>
#include <vector>

namespace accuracy
{
using svobench::Results;
using svobench::Row;

/// A finished picture of any method, row by row from the lower left. Depth is OpenGL's window
/// depth, 1 where nothing is; `object` and `normal` are empty where the method does not tell.
struct Picture
{
  std::vector<float> depth;
  std::vector<std::uint8_t> grey; // red channel
  std::vector<int> object;        // index into Stage::objects, or NoObject
  std::vector<glm::vec3> normal;  // world, unit, of the facet
  bool hit(std::size_t i) const { return this->depth[i] < 1.0f; }
};

/// Linear depth of a window depth.
double linearDepth(const svo::View& view, double windowDepth);

/// What the tracer made of a scene.
Picture pictureOf(const svo::Frame& frame, const svo::Scene& scene, const svo::View& view);

/// Pixels that count are hits of both on the same object, away from edges of the reference and
/// with n.v > 0.1.
constexpr float Grazing = 0.1f;

/// How a set of signed numbers lies; the quantiles are of their absolute values.
struct Distribution
{
  explicit Distribution(std::vector<double> values);
  std::size_t count = 0;
  double signedMedian = 0.0, median = 0.0, p95 = 0.0, p99 = 0.0, max = 0.0;
  void write(Row& row, const std::string& prefix) const;
};

/// Signed depth errors in units of `voxel` (world), along the ray and along the normal, positive
/// behind the true surface; at grazing angles and near edges apart; by angle of incidence; share
/// of errors beyond two voxels; angle between facets, degrees.
void measureDepth(const Picture& picture, const std::vector<TruePixel>& truth,
  const svo::View& view, double voxel, Row& row);

/// False hits, false misses, intersection over union of the covered pixels. A pixel on which the
/// two disagree is settled in double precision first; it is `undecided` if rays a thousandth of a
/// pixel beside it disagree among themselves.
void measureSilhouette(const Picture& picture, const std::vector<TruePixel>& truth,
  const Reference& reference, const svo::View& view, Row& row);

/// What is known about a pixel's light. A method shows darkness as a pixel of less than half the
/// brightness that it has without shadows.
enum class Light : std::uint8_t
{
  Unlit, // turned away, out of the cone, not visible: no shadow could be seen
  Lit,
  Dark
};
std::vector<Light> lightOf(const std::vector<TruePixel>& truth);
std::vector<Light> lightOf(const Picture& shadowed, const Picture& unshadowed);

/// Confusion matrix of shadowed and lit pixels: `prefix` + wrong, falseDark, falseLit, iou, counted
/// and wrongTolerant, which forgives a pixel if one of its eight neighbours is in truth what it
/// shows. Shares of the counted pixels.
void measureShadow(const std::vector<Light>& shown, const std::vector<Light>& truth,
  const std::vector<TruePixel>& exact, const Picture& picture, int width, const std::string& prefix,
  Row& row);
}

#endif
