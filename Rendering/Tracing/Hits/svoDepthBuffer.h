// The merged depth buffer of a view (ZBT in Huang and Cheng, 2017): for every pixel the nearest
// instance, its depth and its primitive.
#ifndef svoDepthBuffer_h
#define svoDepthBuffer_h

#include "svoPages.h"
#include "svoRawArray.h"
#include "svoRay.h"
#include "svoTileGrid.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
constexpr std::uint32_t NoInstance = ~0u;

/// True if one of a tile's 64 instances is this one. A sum, which becomes vectors.
inline bool anyOf(const std::uint32_t* instances, std::uint32_t wanted)
{
  std::uint32_t count = 0;
  for (int i = 0; i < 64; ++i)
  {
    count += instances[i] == wanted ? 1u : 0u;
  }
  return count != 0;
}

/// Stored tile by tile (8x8 pixels, row by row inside), so that a tile is one stretch of memory.
struct DepthBuffer
{
  TileGrid grid;
  RawArray<float, Pages<float>> t; // linear depth minus the base of the winning instance
  RawArray<std::uint32_t, Pages<std::uint32_t>> instance;
  RawArray<Primitive, Pages<Primitive>> primitive;
  std::vector<std::uint8_t> hit; // per tile: some pixel of it has an instance; else its pixels are
                                 // not written at all

  /// Without a hit.
  void resize(const TileGrid& tilesOfView)
  {
    this->grid = tilesOfView;
    const std::size_t tiles = this->tiles();
    this->t.resize(64 * tiles);
    this->instance.resize(64 * tiles);
    this->primitive.resize(64 * tiles);
    if (this->hit.size() != tiles)
    {
      this->Written.assign(tiles, 0);
    }
    this->hit.assign(tiles, 0);
  }
  /// After a frame, of which `writtenNow` says which tiles it wrote, as the next one will in all
  /// likelihood: where others without a hit hold more memory than these and those with one, theirs
  /// is given back, wherever pages hold no others.
  template <class WrittenNow>
  void trim(const WrittenNow& writtenNow)
  {
    const std::size_t tiles = this->tiles();
    std::size_t held = 0, needed = 0;
    this->Needed = this->hit;
    for (std::size_t tile = 0; tile < tiles; ++tile)
    {
      this->Needed[tile] |= static_cast<std::uint8_t>(writtenNow(tile));
      this->Written[tile] |= this->Needed[tile];
      held += this->Written[tile];
      needed += this->Needed[tile];
    }
    if (held <= 2 * needed)
    {
      return;
    }
    this->Written = this->Needed;
    for (std::size_t first = 0, last; first < tiles; first = last + 1)
    {
      last = static_cast<std::size_t>(
        std::find(
          this->Needed.begin() + static_cast<std::ptrdiff_t>(first), this->Needed.end(), 1) -
        this->Needed.begin());
      Pages<float>::giveBack(this->t.data(), this->t.size(), 64 * first, 64 * last);
      Pages<std::uint32_t>::giveBack(
        this->instance.data(), this->instance.size(), 64 * first, 64 * last);
      Pages<Primitive>::giveBack(
        this->primitive.data(), this->primitive.size(), 64 * first, 64 * last);
    }
  }
  std::size_t tiles() const { return this->grid.size(); }
  std::size_t at(int x, int y) const
  {
    assert(this->grid.holds(x >> 3, y >> 3));
    return 64 * this->grid.index(x >> 3, y >> 3) + 8 * (y & 7) + (x & 7);
  }
  std::uint32_t instanceAt(int x, int y) const
  {
    const std::size_t i = this->at(x, y);
    return this->hit[i / 64] ? this->instance[i] : NoInstance;
  }
  Primitive primitiveAt(int x, int y) const
  {
    const std::size_t i = this->at(x, y);
    return this->hit[i / 64] && this->instance[i] != NoInstance ? this->primitive[i] : NoPrimitive;
  }
  /// True if a pixel of the tile is the instance's.
  bool shows(int tileX, int tileY, std::uint32_t wanted) const
  {
    assert(this->grid.holds(tileX, tileY));
    const std::size_t tile = this->grid.index(tileX, tileY);
    return this->hit[tile] && anyOf(this->instance.data() + 64 * tile, wanted);
  }

private:
  std::vector<std::uint8_t> Written; // per tile: since its memory was given back
  std::vector<std::uint8_t> Needed;  // scratch of trim()
};
}

#endif
