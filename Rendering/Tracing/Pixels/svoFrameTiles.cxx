#include "svoFrameTiles.h"

#include <algorithm>
#include <cassert>

namespace svo
{
namespace
{
/// Calls f(array, numbers of each pixel, each of a miss) for what is known of misses. None of a
/// pixel: the array is not wanted.
template <class F>
void eachArray(Frame& frame, const FrameSettings& settings, F&& f)
{
  f(frame.color, 4, std::uint8_t(0));
  f(frame.depth, 1, 1.0f);
  f(frame.instance, settings.writeNames ? 1 : 0, NoInstance);
  f(frame.primitive, settings.writeNames ? 1 : 0, NoPrimitive);
  f(frame.normals, settings.writeNormals ? 3 : 0, 0.0f);
  f(frame.slopes, settings.writeSlopes ? 2 : 0, 0.0f);
}

/// Makes the pixels of the tile whose lower left pixel is (x0, y0) misses.
void wipeTile(const FrameSettings& settings, int x0, int y0, Frame& frame)
{
  assert(x0 >= 0 && x0 < frame.width && y0 >= 0 && y0 < frame.height);
  const std::size_t columns = std::min(frame.width - x0, 8);
  for (int y = y0; y < std::min(y0 + 8, frame.height); ++y)
  {
    const std::size_t at = static_cast<std::size_t>(y) * frame.width + x0;
    eachArray(frame, settings,
      [&](auto& array, std::size_t numbers, auto miss)
      { std::fill_n(array.data() + numbers * at, numbers * columns, miss); });
  }
}
}

bool FrameTiles::find(
  const DepthBuffer& depth, const View& view, const FrameSettings& settings, Frame& frame)
{
  assert(view.isWhole());
  this->TilesX = depth.grid.tilesX;
  const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
  const std::size_t ofLight = settings.writeLight ? 3 * pixels : 0;
  bool same =
    frame.width == view.width && frame.height == view.height && frame.light.size() == ofLight;
  eachArray(frame, settings,
    [&](const auto& array, std::size_t numbers, auto)
    { same = same && array.size() == numbers * pixels; });
  if (!same)
  {
    frame.width = view.width;
    frame.height = view.height;
    eachArray(frame, settings,
      [&](auto& array, std::size_t numbers, auto miss) { array.assign(numbers * pixels, miss); });
    frame.light.assign(ofLight, 0.0f);
    frame.tiles.assign(depth.tiles(), FrameTile());
    this->Written.clear();
  }
  ++frame.version;
  this->Written.resize(depth.tiles(), 0);
  this->Hits.clear();
  frame.covered = PixelRect();
  for (std::size_t tile = 0; tile < depth.tiles(); ++tile)
  {
    const int x = 8 * static_cast<int>(tile % depth.grid.tilesX);
    const int y = 8 * static_cast<int>(tile / depth.grid.tilesX);
    if (depth.hit[tile])
    {
      this->Hits.push_back(static_cast<std::uint32_t>(tile));
      frame.covered = around(frame.covered, { x, y, x + 8, y + 8 });
    }
    else if (this->Written[tile])
    {
      wipeTile(settings, x, y, frame);
      frame.tiles[tile] = { FrameTile::Kind::Empty, frame.version };
    }
    this->Written[tile] = depth.hit[tile];
  }
  frame.covered.x1 = std::min(frame.covered.x1, frame.width);
  frame.covered.y1 = std::min(frame.covered.y1, frame.height);
  return same;
}
}
