// Where the points of a patch are in a map of a shadow buffer, in single precision, and how far off
// that may be; whoever has to know a texel for certain asks svoTexelPlace.h for the other points,
// in double.
//
// A map's clip coordinates are affine in the way to a point. What a texel's coordinate is from the
// one of the origin, u0, rounded down to a whole texel, is their quotient
//
//   u - u0 = (X - u0 W) / W     X, W affine in the way
//
// whose four times two numbers are computed in double and rounded once. With u = 2^-24 the way is
// off by 8 u of the patch's extent (svoPointOrigin.h), an affine function by as much of the sum of
// its terms' sizes, and for a coefficient, a product and three sums 5 u more.
#ifndef svoMapPlaces_h
#define svoMapPlaces_h

#include "svoTexelPlace.h"
#include "svoTilePatch.h"
#include "svoView.h"

#include <cstdint>

namespace svo
{
/// Where the points of a patch are looked up in a map.
struct MapPlaces
{
  int x0, y0;  // texel of the patch's origin, which may lie beyond the map
  double t0;   // linear depth of the origin, from the light
  float error; // texels; that places are off by at most
  /// Points that are in the map for certain; that are not; and those of the former whose texel is
  /// certain as well. The others are to be looked up in double.
  std::uint64_t inside, outside, sure;
  /// A box around those that are inside: texels from x0, y0; linear depth, less t0.
  float lowX, lowY, lowT, highX, highY, highT;
  alignas(64) float x[TilePatch::Most], y[TilePatch::Most];             // texels from x0, y0
  alignas(64) float centreX[TilePatch::Most], centreY[TilePatch::Most]; // ... of the texel
  alignas(64) float t[TilePatch::Most];                                 // linear depth, less t0

  int column(int i) const { return x0 + static_cast<int>(centreX[i] - 0.5f); }
  int row(int i) const { return y0 + static_cast<int>(centreY[i] - 0.5f); }
};

/// Tiles of 8x8 texels; the last ones included.
struct MapTiles
{
  int x0, y0, x1, y1;
  bool atMost(int edge) const { return x1 - x0 < edge && y1 - y0 < edge; }
};
/// Those that the box around points inside of a map is in, made larger by `margin` texels.
MapTiles tilesOf(const MapPlaces& places, const View& map, float margin);
/// Those around each point that is inside, which are among `tiles`, at most 8x8: bit 8 row + column
/// from the lower left one.
std::uint64_t tilesAround(
  const MapPlaces& places, const View& map, float margin, const MapTiles& tiles);

/// Places those points of a patch that are in `lanes`.
void placeInMap(
  const MapGeometry& map, const TilePatch& patch, std::uint64_t lanes, MapPlaces& places);
}

#endif
