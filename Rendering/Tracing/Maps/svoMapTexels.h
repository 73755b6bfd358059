// What lies at the texels of a map of a shadow buffer that the points of a patch are looked up in:
// by gathers, since neighbours on the screen are no neighbours in the map.
#ifndef svoMapTexels_h
#define svoMapTexels_h

#include "svoMapPlaces.h"
#include "svoTexelPlace.h"
#include "svoTileGrid.h"
#include "svoTileOccluders.h"
#include "svoTilePatch.h"

#include <cstdint>

namespace svo
{
/// The texels of a map, tile by tile as in a DepthBuffer.
struct MapTexels
{
  TileGrid grid;
  const TileOccluders* tiles; // nearest infinity: nothing lies there, and nothing is known further
  const float* t;
  const std::uint32_t* instance;
};

/// What lies at the texels of points, by pixel.
struct TexelOccluders
{
  alignas(64) std::uint32_t caster[TilePatch::Most]; // instance; NoInstance: nothing
  alignas(64) float t[TilePatch::Most];              // linear depth, less the caster's base
};

/// Looks up the depths at the texels of points that are `sure`, where all texels are one caster's.
void lookUpDepths(const MapTexels& map, const MapPlaces& places, TexelOccluders& occluders);

/// Looks up what lies at the texels of points that are `sure`. Returns points that something lies
/// at; `same`: whose caster is the first one's.
std::uint64_t lookUpTexels(
  const MapTexels& map, const MapPlaces& places, TexelOccluders& occluders, std::uint64_t& same);

/// Those of the points in `lanes` that are sure and around which 3x3 texels hold nothing, or one
/// caster without steps and creases, as MapTest::isFlat() has it; some of the others may, too.
std::uint64_t flatWindows(
  const MapGeometry& geometry, const MapTexels& map, const MapPlaces& places, std::uint64_t lanes);
}

#endif
