// Surfaces that VTK draws, as a tracer that samples their light sees them, and what it has found;
// and which planes samples have, of these and of traced surfaces. Plain data.
#ifndef svoReceivers_h
#define svoReceivers_h

#include "vtkSVOTracingModule.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
/// Where they lie, one a pixel of a view, row by row from the lower left. Above these rows those of
/// what is translucent before them: of the nearest surfaces, of those behind them, and so on.
struct ReceiverPlaces
{
  static constexpr float Nowhere = -1e30f;

  int width = 0, height = 0; // of all of them
  int sliceRows = 0;         // from the first of one to the first of the next
  /// Four numbers a pixel: view coordinates; and how far the smooth surface that the normals stand
  /// for lies over the facet, along the normal, or Nowhere: there is none, or nothing falls on it.
  std::vector<float> places;
  /// Four numbers a pixel, 65535 of them 1: the unit normal of the facet, towards the viewer, and
  /// that which is shaded, view coordinates, each as an octahedron's two coordinates, -1..1 (Meyer
  /// et al., "On Floating-Point Normal Vectors", 2010).
  std::vector<std::uint16_t> planes;

  std::size_t bytes() const { return 4 * this->places.size() + 2 * this->planes.size(); }
};

/// What of a frame's light samples answer for, as planes of an image each.
struct SampledPlanes
{
  static constexpr int None = -1;

  std::vector<int> ofLights; // what is missed, by index into Scene::lights
  int ofOcclusion = None;    // what is closed off all around
  int ofSky = None; // the first of red, green and blue of what is seen, of Sky::brightest()
  int count = 0;

  bool any() const { return this->count > 0; }
  bool isOfLight(int plane) const
  {
    return std::count(this->ofLights.begin(), this->ofLights.end(), plane) > 0;
  }
};

/// What of the light that is sampled reaches them.
struct ReceiverShares
{
  SampledPlanes sampled; // but of lights and occlusion 1 less what is missed, or closed off

  /// The numbers are those of the last frame.
  bool current = false;
  /// How far they are from those of fewer samples which they have replaced, RMS of 0..255;
  /// negative: they have replaced none.
  double error = -1.0;
  /// Four planes a layer, layer by layer, four numbers a pixel; 65535: all.
  std::vector<std::uint16_t> numbers;

  int layers() const { return (this->sampled.count + 3) / 4; }
};

/// How far numbers as above are from those before, of these planes and of pixels with a surface:
/// RMS of 0..255. Negative if there are none before.
VTKSVOTRACING_EXPORT double differenceOf(const std::vector<std::uint16_t>& before,
  const std::vector<std::uint16_t>& now, const std::vector<int>& planes,
  const ReceiverPlaces& places);
}

#endif
