// Which tiles of a frame need not be shaded again: those whose hits, looks and lights are what they
// were, the tiles of the lights' maps that they look up as well, and the casters that their rays to
// the lights can meet. Then their pixels are, to the bit.
#ifndef svoKeptTiles_h
#define svoKeptTiles_h

#include "svoCasterBox.h"
#include "svoLightTile.h"
#include "svoView.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
class KeptTiles
{
public:
  struct Tile
  {
    bool stale = true; // its hits or their looks are not what they were
    LightTiles looksUp;
    RaisedTiles raised;    // of points at the terminator (svoTerminator.h)
    PointBox raysToLights; // world; where they begin
  };

  /// `all`: none is kept.
  void beginFrame(int tilesX, int tilesY, bool all)
  {
    const std::size_t count = static_cast<std::size_t>(tilesX) * tilesY;
    this->TilesX = tilesX;
    if (this->Tiles.size() != count)
    {
      this->Tiles.assign(count, Tile());
    }
    for (Tile& tile : this->Tiles)
    {
      tile.stale = all;
    }
  }
  Tile& at(int tileX, int tileY)
  {
    return (*this)[static_cast<std::size_t>(tileY) * this->TilesX + tileX];
  }
  Tile& operator[](std::size_t tile)
  {
    assert(tile < this->Tiles.size());
    return this->Tiles[tile];
  }
  std::size_t size() const { return this->Tiles.size(); }

private:
  int TilesX = 0;
  std::vector<Tile> Tiles;
};
}

#endif
