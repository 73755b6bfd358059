// Where the tiles of 8x8 pixels that a view looks at are stored.
#ifndef svoTileGrid_h
#define svoTileGrid_h

#include "svoView.h"

#include <algorithm>
#include <cstddef>

namespace svo
{
/// Tiles are numbered in the view's whole image, and stored row by row. Of a crop they are stored
/// on a torus: a tile has its place by its own number alone, so that those stay where they are that
/// two crops of an image have in common, and the others take the places of those that went.
struct TileGrid
{
  int x0 = 0, y0 = 0;         // the first tile
  int tilesX = 0, tilesY = 0; // so many are looked at
  int columns = 0, rows = 0;  // places
  int maskX = -1, maskY = -1; // of a number: its column, its row

  TileGrid() = default;
  explicit TileGrid(const View& view)
    : x0(view.crop.x0 / 8)
    , y0(view.crop.y0 / 8)
    , tilesX((view.crop.x1 + 7) / 8 - x0)
    , tilesY((view.crop.y1 + 7) / 8 - y0)
    , columns(tilesX)
    , rows(tilesY)
  {
    if (!view.isWhole())
    {
      this->columns = powerOfTwo(this->tilesX);
      this->rows = powerOfTwo(this->tilesY);
      this->maskX = this->columns - 1;
      this->maskY = this->rows - 1;
    }
  }

  std::size_t size() const { return static_cast<std::size_t>(this->columns) * this->rows; }
  std::size_t index(int tileX, int tileY) const
  {
    return static_cast<std::size_t>(tileY & this->maskY) * this->columns + (tileX & this->maskX);
  }
  /// The tile at a place; of a crop there may be none that is looked at.
  int tileX(std::size_t index) const
  {
    return this->x0 + ((static_cast<int>(index % this->columns) - this->x0) & this->maskX);
  }
  int tileY(std::size_t index) const
  {
    return this->y0 + ((static_cast<int>(index / this->columns) - this->y0) & this->maskY);
  }
  bool holds(int tileX, int tileY) const
  {
    return tileX >= this->x0 && tileX < this->x0 + this->tilesX && tileY >= this->y0 &&
      tileY < this->y0 + this->tilesY;
  }
  /// Calls function(first, last) for stretches of places of the tiles that a rectangle of pixels
  /// touches, as far as they are looked at.
  template <class Function>
  void eachStretch(const PixelRect& rect, const Function& function) const
  {
    const int from = std::max(rect.x0 / 8, this->x0);
    const int to = std::min((rect.x1 + 7) / 8, this->x0 + this->tilesX);
    const int top = std::min((rect.y1 + 7) / 8, this->y0 + this->tilesY);
    for (int y = std::max(rect.y0 / 8, this->y0); y < top; ++y)
    {
      for (int x = from; x < to;)
      {
        const std::size_t first = this->index(x, y);
        const int count = std::min(to - x, this->columns - static_cast<int>(first % this->columns));
        function(first, first + count);
        x += count;
      }
    }
  }

private:
  static int powerOfTwo(int least)
  {
    int size = 1;
    while (size < least)
    {
      size *= 2;
    }
    return size;
  }
};

inline bool sameGrid(const TileGrid& a, const TileGrid& b)
{
  return a.columns == b.columns && a.rows == b.rows && a.maskX == b.maskX && a.maskY == b.maskY;
}
}

#endif
