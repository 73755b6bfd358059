// Which tiles of a frame need not be shaded again: those whose hits, looks and lights are what they
// were, the tiles of the lights' maps that they look up as well, and the casters that their rays to
// the lights can meet. Then their pixels are, to the bit.
#ifndef svoShadedTiles_h
#define svoShadedTiles_h

#include "svoBox.h"
#include "svoLightTile.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
class ShadedTiles
{
public:
  struct Tile
  {
    LightTiles looksUp;
    RaisedTiles raised; // of points at the terminator (svoTerminator.h)
    Box raysToLights;   // world; where they begin
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
  /// Its hits, or their looks or lights, have changed. Threads may mark different tiles.
  bool stale(std::size_t tile) const { return (this->Stale[tile] & Itself) != 0; }
  void setStale(std::size_t tile, bool stale)
  {
    this->Stale[tile] |= static_cast<std::uint8_t>(stale ? Itself : 0);
  }
  /// It is stale, or one of those around it, whose samples it shares (svoLightFilter.h).
  bool shadedAnew(std::size_t tile) const { return this->Stale[tile] != 0; }
  void spread()
  {
    const int tilesY = this->TilesX > 0 ? static_cast<int>(this->size()) / this->TilesX : 0;
    for (std::size_t tile = 0; tile < this->size(); ++tile)
    {
      if (this->stale(tile))
      {
        const int x = static_cast<int>(tile) % this->TilesX,
                  y = static_cast<int>(tile) / this->TilesX;
        for (int k = 0; k < 9; ++k)
        {
          const int besideX = x + k % 3 - 1, besideY = y + k / 3 - 1;
          if (besideX >= 0 && besideX < this->TilesX && besideY >= 0 && besideY < tilesY)
          {
            this->Stale[this->index(besideX, besideY)] |= Beside;
          }
        }
      }
    }
  }
  /// Nothing is noted of the stale ones among these any more.
  void forget(const std::vector<std::uint32_t>& tiles)
  {
    for (const std::uint32_t tile : tiles)
    {
      if (this->stale(tile))
      {
        this->Tiles[tile].raised.clear();
        this->Tiles[tile].raysToLights = Box();
      }
    }
  }
  std::size_t size() const { return this->Tiles.size(); }
  /// Of hits in no later version than this (nextTileVersion()), the eye's and the lights'.
  std::uint64_t madeOf() const { return this->MadeOf; }
  void setMadeOf(std::uint64_t version) { this->MadeOf = version; }

private:
  static constexpr std::uint8_t Itself = 1, Beside = 2;
  int TilesX = 0;
  std::uint64_t MadeOf = 0;
  std::vector<Tile> Tiles;
  std::vector<std::uint8_t> Stale; // apart, since each frame looks at all of them
};
}

#endif
