#include "svoTileRuns.h"

#include <algorithm>
#include <cassert>

namespace svo
{
TileRuns tileRunsOf(const Frame& frame)
{
  constexpr int Size = Frame::TileSize;
  TileRuns runs;
  const PixelRect& rect = frame.covered;
  if (frame.tiles.empty())
  {
    runs.mixed.push_back(rect);
    return runs;
  }
  assert(rect.empty() || (rect.x0 % Size == 0 && rect.y0 % Size == 0));
  const int tilesX = (frame.width + Size - 1) / Size;
  for (int y = rect.y0; y < rect.y1; y += Size)
  {
    FrameTile::Kind last = FrameTile::Kind::Empty;
    for (int x = rect.x0; x < rect.x1; x += Size)
    {
      const FrameTile::Kind kind =
        frame.tiles[static_cast<std::size_t>(y / Size) * tilesX + x / Size].kind;
      const int right = std::min(x + Size, frame.width);
      std::vector<PixelRect>& list = kind == FrameTile::Kind::Whole ? runs.whole : runs.mixed;
      if (kind != FrameTile::Kind::Empty && kind == last)
      {
        list.back().x1 = right;
      }
      else if (kind != FrameTile::Kind::Empty)
      {
        list.push_back({ x, y, right, std::min(y + Size, frame.height) });
      }
      last = kind;
    }
  }
  return runs;
}
}
