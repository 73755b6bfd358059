// A group of 4x4 tiles of an image, of which a window is asked for.
#ifndef svoTileGroup_h
#define svoTileGroup_h

#include "svoGroupView.h"
#include "svoPyramidNodes.h"
#include "svoView.h"

#include <algorithm>
#include <cstdint>

namespace svo
{
struct TileGroup
{
  /// Tiles along an edge.
  static constexpr int Tiles = GroupView::Tiles;

  int x = 0, y = 0;   // of the image, in tiles
  GroupWindow window; // around those of its tiles that are asked for

  /// What a rectangle of pixels, of which the window has some, has of the group.
  GroupWindow windowOf(const PixelRect& r) const
  {
    const auto inGroup = [](int pixel, int firstTile, int low, int high)
    { return static_cast<std::uint8_t>(std::clamp(pixel - 8 * firstTile, low, high)); };
    const GroupWindow& w = this->window;
    return { inGroup(r.x0, this->x, w.x0, w.x1), inGroup(r.x1 - 1, this->x, w.x0, w.x1),
      inGroup(r.y0, this->y, w.y0, w.y1), inGroup(r.y1 - 1, this->y, w.y0, w.y1) };
  }
  bool wants(const PixelRect& r) const
  {
    const int x0 = 8 * this->x, y0 = 8 * this->y;
    return r.x0 <= x0 + this->window.x1 && r.x1 > x0 + this->window.x0 &&
      r.y0 <= y0 + this->window.y1 && r.y1 > y0 + this->window.y0;
  }
  /// Calls function(tileX, tileY) for the tiles of the window.
  template <class Function>
  void eachTile(Function&& function) const
  {
    for (int row = this->window.y0 / 8; row <= this->window.y1 / 8; ++row)
    {
      for (int column = this->window.x0 / 8; column <= this->window.x1 / 8; ++column)
      {
        function(this->x + column, this->y + row);
      }
    }
  }
};
}

#endif
