// What lies in each tile of 8x8 texels of a shadow buffer's map: how near to the light and how far
// from it, and whose, where all of it is one caster's. Found once when the map is traced, this
// answers most patches before any texel is looked up: those that are nearer to the light than all
// of it are lit, those that are much farther dark, and of those in one caster's tiles only depths
// are looked up.
#ifndef svoTileOccluders_h
#define svoTileOccluders_h

#include "svoDepthBuffer.h"
#include "svoHits.h"
#include "svoMapPlaces.h"
#include "svoParallel.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// What lies in one or more tiles.
struct TileOccluders
{
  static constexpr std::uint32_t Several = NoInstance - 1;

  float nearest;        // linear depth; nothing lies nearer. Infinity: nothing lies there
  float farthest;       // ... nothing lies farther; infinity if there is a texel without anything
  std::uint32_t caster; // all texels are this one's; NoInstance: nobody's; or Several
};

class MapOccluders
{
public:
  /// After the map is traced, each time: of the tiles that have changed.
  void find(const Hits& map, const ParallelFor& parallelFor);
  /// The map is not what shadows are looked up in.
  void forget()
  {
    this->Tiles = {};
    this->Of = 0;
  }
  bool known() const { return !this->Tiles.empty(); }
  /// Of each tile. known().
  const TileOccluders* tiles() const { return this->Tiles.data(); }
  /// Of a box of tiles; of large ones, and if it is not known, minus and plus infinity, and
  /// Several. `grid`: of the hits that they were found in.
  TileOccluders in(const MapTiles& tiles, const TileGrid& grid) const;

private:
  std::vector<TileOccluders> Tiles;
  std::uint64_t Of = 0; // Hits::version
};
}

#endif
