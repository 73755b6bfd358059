// A depth layer: an instance alone, as one view sees it.
#ifndef svoDepthLayer_h
#define svoDepthLayer_h

#include "svoPages.h"
#include "svoRawArray.h"
#include "svoRay.h"
#include "svoTileIntervals.h"
#include "svoView.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
/// A kept depth layer: the tiles of an instance's rectangle that somebody asked for so far.
struct DepthLayer
{
  PixelRect rect;
  std::vector<std::uint8_t> traced; // per tile of rect, a State
  RawArray<float, Pages<float>> t;  // 64 per tile, of traced ones
  RawArray<Primitive, Pages<Primitive>> primitive;
  TileIntervals intervals; // of rect

  enum State : std::uint8_t
  {
    Unknown,
    Traced,
    Empty // traced, and nothing was there
  };

  explicit DepthLayer(const PixelRect& r)
    : rect(r)
  {
    assert(!r.empty() && ((r.x0 | r.y0 | r.x1 | r.y1) & 7) == 0);
    const std::size_t tiles = static_cast<std::size_t>((r.x1 - r.x0) / 8) * ((r.y1 - r.y0) / 8);
    this->traced.resize(tiles);
    this->t.resize(64 * tiles);
    this->primitive.resize(64 * tiles);
  }
  bool holds(int tileX, int tileY) const
  {
    return 8 * tileX >= this->rect.x0 && 8 * tileX < this->rect.x1 && 8 * tileY >= this->rect.y0 &&
      8 * tileY < this->rect.y1;
  }
  /// Index of a tile of the image, which must be one of the rectangle.
  std::size_t index(int tileX, int tileY) const
  {
    assert(this->holds(tileX, tileY));
    return static_cast<std::size_t>(tileY - this->rect.y0 / 8) *
      ((this->rect.x1 - this->rect.x0) / 8) +
      (tileX - this->rect.x0 / 8);
  }
  std::size_t bytes() const
  {
    return this->traced.size() * (1 + 2 * sizeof(float)) + this->t.size() * sizeof(float) +
      this->primitive.size() * sizeof(Primitive);
  }
};
}

#endif
