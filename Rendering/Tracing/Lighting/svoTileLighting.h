// Lighting of the points of a patch, in loops over the arithmetic of svoLightingLane.h.
#ifndef svoTileLighting_h
#define svoTileLighting_h

#include "svoTilePatch.h"
#include "svoViewLights.h"

#include <algorithm>
#include <cstdint>

namespace svo
{
/// A colour channel as a byte; NaN becomes 0.
inline std::uint8_t toByte(float v)
{
  return v > 0.0f ? static_cast<std::uint8_t>(std::min(v, 1.0f) * 255.0f + 0.5f) : 0;
}

/// The light that arrives at the points of a patch. By pixel; valid where the patch has points.
struct TileLight
{
  // Of one light: before any shadow, to be multiplied by its colour.
  alignas(64) float diffuse[TilePatch::Most], specular[TilePatch::Most];
  /// Of the present light, what its shadow leaves of it, 0..1.
  alignas(64) float share[TilePatch::Most];
  PixelVectors scattered, shining; // of all lights together, diffuse and specular
};

/// Colours of points, 0..1 and beyond; and as RGBA in memory, alpha 255. By pixel.
struct TileColors
{
  PixelVectors rgb;
  alignas(64) std::uint32_t rgba[TilePatch::Most];
};

/// Light number l: sets `diffuse` and `specular`; returns the points that it reaches.
std::uint64_t arriveLight(const Lighting& lighting, std::size_t l, const Material& material,
  const TilePatch& patch, TileLight& light);

/// Adds what arrived, of each point `share` times. `first`: to nothing.
void addLight(const ViewLight& from, const TilePatch& patch, bool first, TileLight& light);

/// Takes from the points' colours, after finishLight(), the share `closed` of each: of their
/// ambient part, or of all.
void closeOff(const Material& material, bool all, const TilePatch& patch, const float* closed,
  TileColors& colors);

/// The colours of the points; `lit`: by what was added.
void finishLight(const Material& material, bool lit, const TilePatch& patch, const TileLight& light,
  TileColors& colors);
}

#endif
