#include "svoTileRuns.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace svo
{
namespace
{
constexpr int Size = 8; // pixels

enum class Kind
{
  Empty,
  Mixed,
  Whole
};

/// Alpha is 255 on a hit and 0 elsewhere.
Kind kindOf(const Frame& frame, int x0, int y0)
{
  const int x1 = std::min(x0 + Size, frame.width), y1 = std::min(y0 + Size, frame.height);
  std::uint32_t any = 0, all = ~0u;
  for (int y = y0; y < y1; ++y)
  {
    const std::uint8_t* row =
      frame.color.data() + 4 * (static_cast<std::size_t>(y) * frame.width + x0);
    for (int x = 0; x < x1 - x0; ++x)
    {
      std::uint32_t pixel;
      std::memcpy(&pixel, row + 4 * x, 4);
      any |= pixel;
      all &= pixel;
    }
  }
  std::uint8_t bytes[4];
  std::memcpy(bytes, &all, 4);
  const bool isWhole = bytes[3] != 0;
  std::memcpy(bytes, &any, 4);
  return isWhole ? Kind::Whole : bytes[3] != 0 ? Kind::Mixed : Kind::Empty;
}
}

TileRuns tileRunsOf(const Frame& frame)
{
  TileRuns runs;
  const PixelRect& rect = frame.covered;
  assert(rect.empty() || (rect.x0 % Size == 0 && rect.y0 % Size == 0));
  for (int y = rect.y0; y < rect.y1; y += Size)
  {
    Kind last = Kind::Empty;
    for (int x = rect.x0; x < rect.x1; x += Size)
    {
      const Kind kind = kindOf(frame, x, y);
      const int right = std::min(x + Size, frame.width);
      std::vector<PixelRect>& list = kind == Kind::Whole ? runs.whole : runs.mixed;
      if (kind != Kind::Empty && kind == last)
      {
        list.back().x1 = right;
      }
      else if (kind != Kind::Empty)
      {
        list.push_back({ x, y, right, std::min(y + Size, frame.height) });
      }
      last = kind;
    }
  }
  return runs;
}
}
