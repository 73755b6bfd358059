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
      all = true;
    }
    this->Stale.assign(count, all);
  }
  std::size_t index(int tileX, int tileY) const
  {
    assert(tileX >= 0 && tileX < this->TilesX && tileY >= 0);
    return static_cast<std::size_t>(tileY) * this->TilesX + tileX;
  }
  Tile& operator[](std::size_t tile)
  {
    assert(tile < this->Tiles.size());
    return this->Tiles[tile];
  }
  /// Its hits, or their looks or lights, are not what they were. Threads may mark different tiles.
  bool stale(std::size_t tile) const { return this->Stale[tile] != 0; }
  void setStale(std::size_t tile, bool stale)
  {
    this->Stale[tile] |= static_cast<std::uint8_t>(stale);
  }
  std::size_t size() const { return this->Tiles.size(); }

private:
  int TilesX = 0;
  std::vector<Tile> Tiles;
  std::vector<std::uint8_t> Stale; // apart, since each frame looks at all of them
};
}

#endif
