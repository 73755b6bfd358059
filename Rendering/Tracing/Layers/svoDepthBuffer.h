// The merged depth buffer of a view (ZBT in Huang and Cheng, 2017): for every pixel the nearest
// instance, its depth and its primitive.
#ifndef svoDepthBuffer_h
#define svoDepthBuffer_h

#include "svoPagedArray.h"
#include "svoRay.h"

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
  int tilesX = 0;
  int tilesY = 0;
  PagedArray<float> t; // linear depth minus the base of the winning instance
  PagedArray<std::uint32_t> instance;
  PagedArray<Primitive> primitive;
  std::vector<std::uint8_t> hit; // per tile: some pixel of it has an instance; else its pixels are
                                 // not written at all

  void resize(int width, int height)
  {
    this->tilesX = (width + 7) / 8;
    this->tilesY = (height + 7) / 8;
    const std::size_t tiles = this->tiles();
    this->t.resize(64 * tiles);
    this->instance.resize(64 * tiles);
    this->primitive.resize(64 * tiles);
    this->hit.assign(tiles, 0);
  }
  std::size_t tiles() const { return static_cast<std::size_t>(this->tilesX) * this->tilesY; }
  std::size_t at(int x, int y) const
  {
    assert(x >= 0 && y >= 0 && x < 8 * this->tilesX && y < 8 * this->tilesY);
    return 64 * (static_cast<std::size_t>(y >> 3) * this->tilesX + (x >> 3)) + 8 * (y & 7) +
      (x & 7);
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
    assert(tileX >= 0 && tileY >= 0 && tileX < this->tilesX && tileY < this->tilesY);
    const std::size_t tile = static_cast<std::size_t>(tileY) * this->tilesX + tileX;
    return this->hit[tile] && anyOf(this->instance.data() + 64 * tile, wanted);
  }
};
}

#endif
