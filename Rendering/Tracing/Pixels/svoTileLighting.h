// Lighting of the visible points of a tile, in loops over the arithmetic of svoLightingLane.h.
#ifndef svoTileLighting_h
#define svoTileLighting_h

#include "svoTilePoints.h"
#include "svoViewLights.h"

#include <algorithm>
#include <cstdint>

namespace svo
{
/// Colours of points, 0..1 and beyond, by index of the point.
struct TileColors
{
  alignas(64) float r[TilePoints::Room], g[TilePoints::Room], b[TilePoints::Room];
};

/// A colour channel as a byte; NaN becomes 0.
inline std::uint8_t toByte(float v)
{
  return v > 0.0f ? static_cast<std::uint8_t>(std::min(v, 1.0f) * 255.0f + 0.5f) : 0;
}

/// Colours as RGBA in memory, alpha 255, by index of the point.
void packColors(const TileColors& colors, int count, std::uint32_t* rgba);

/// Points [first, last) of one instance in view space, and the light that arrives there.
struct TileLight
{
  // By index of the point minus `first`.
  alignas(64) float normalX[TilePoints::Room], normalY[TilePoints::Room], normalZ[TilePoints::Room];
  alignas(64) float positionX[TilePoints::Room], positionY[TilePoints::Room],
    positionZ[TilePoints::Room];
  // Of one light: before any shadow, to be multiplied by its colour.
  alignas(64) float diffuse[TilePoints::Room], specular[TilePoints::Room];
  alignas(64) float base[TilePoints::Room]; // of the highlight's power
  // Of all lights together.
  alignas(64) float diffuseR[TilePoints::Room], diffuseG[TilePoints::Room],
    diffuseB[TilePoints::Room];
  alignas(64) float specularR[TilePoints::Room], specularG[TilePoints::Room],
    specularB[TilePoints::Room];
  /// A point that light reaches from the present one; and those of them that lie in its shadow.
  std::uint8_t reached[TilePoints::Room], dark[TilePoints::Room];
  /// Of the present light, what is left of it, 0..1; addShares() alone reads it.
  alignas(64) float share[TilePoints::Room];
};

/// To view space.
void toViewSpace(
  const Lighting& lighting, const TilePoints& points, int first, int last, TileLight& light);

/// Light number l: sets `diffuse`, `specular` and `reached`.
void arriveLight(
  const Lighting& lighting, std::size_t l, const Material& material, int count, TileLight& light);

/// Adds what arrived. Where it is `dark` a share of `remaining` is left.
void addLight(const ViewLight& from, float remaining, int count, TileLight& light);

/// The same; of every point its `share` is left.
void addShares(const ViewLight& from, int count, TileLight& light);

/// The colours of the points.
void finishLight(const Lighting& lighting, const Material& material, const TilePoints& points,
  int first, int last, bool hasColor, const TileLight& light, TileColors& colors);
}

#endif
