#include "svoFrameTiles.h"

#include <algorithm>
#include <cassert>

namespace svo
{
void wipeTile(Frame& frame, int x0, int y0)
{
  assert(x0 >= 0 && x0 < frame.width && y0 >= 0 && y0 < frame.height);
  const int x1 = std::min(x0 + 8, frame.width);
  for (int y = y0; y < std::min(y0 + 8, frame.height); ++y)
  {
    const std::size_t row = static_cast<std::size_t>(y) * frame.width;
    const std::size_t a = row + x0;
    const std::size_t b = row + x1;
    std::fill(frame.color.begin() + 4 * a, frame.color.begin() + 4 * b, std::uint8_t(0));
    std::fill(frame.depth.begin() + a, frame.depth.begin() + b, 1.0f);
    if (!frame.instance.empty())
    {
      std::fill(frame.instance.begin() + a, frame.instance.begin() + b, NoInstance);
      std::fill(frame.primitive.begin() + a, frame.primitive.begin() + b, NoPrimitive);
    }
    if (!frame.normals.empty())
    {
      std::fill(frame.normals.begin() + 3 * a, frame.normals.begin() + 3 * b, 0.0f);
    }
    if (!frame.slopes.empty())
    {
      std::fill(frame.slopes.begin() + 2 * a, frame.slopes.begin() + 2 * b, 0.0f);
    }
  }
}

bool FrameTiles::find(
  const DepthBuffer& depth, const View& view, const FrameSettings& settings, Frame& frame)
{
  assert(view.isWhole());
  this->TilesX = depth.grid.tilesX;
  const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
  const bool same = frame.width == view.width && frame.height == view.height &&
    frame.color.size() == 4 * pixels &&
    frame.normals.size() == (settings.writeNormals ? 3 * pixels : 0) &&
    frame.slopes.size() == (settings.writeSlopes ? 2 * pixels : 0) &&
    frame.light.size() == (settings.writeLight ? 3 * pixels : 0) &&
    frame.instance.size() == (settings.writeNames ? pixels : 0);
  if (!same)
  {
    frame.width = view.width;
    frame.height = view.height;
    frame.color.assign(4 * pixels, 0);
    frame.depth.assign(pixels, 1.0f);
    frame.instance.assign(settings.writeNames ? pixels : 0, NoInstance);
    frame.primitive.assign(settings.writeNames ? pixels : 0, NoPrimitive);
    frame.tiles.assign(depth.tiles(), FrameTile());
    frame.normals.assign(settings.writeNormals ? 3 * pixels : 0, 0.0f);
    frame.slopes.assign(settings.writeSlopes ? 2 * pixels : 0, 0.0f);
    frame.light.assign(settings.writeLight ? 3 * pixels : 0, 0.0f);
    this->Written.clear();
  }
  ++frame.version;
  this->Written.resize(depth.tiles(), 0);
  this->Hits.clear();
  PixelRect covered{ frame.width, frame.height, 0, 0 };
  for (std::size_t tile = 0; tile < depth.tiles(); ++tile)
  {
    const int x = 8 * static_cast<int>(tile % depth.grid.tilesX);
    const int y = 8 * static_cast<int>(tile / depth.grid.tilesX);
    if (depth.hit[tile])
    {
      this->Hits.push_back(static_cast<std::uint32_t>(tile));
      covered = { std::min(covered.x0, x), std::min(covered.y0, y), std::max(covered.x1, x + 8),
        std::max(covered.y1, y + 8) };
    }
    else if (this->Written[tile])
    {
      wipeTile(frame, x, y);
      frame.tiles[tile] = { FrameTile::Kind::Empty, frame.version };
    }
    this->Written[tile] = depth.hit[tile];
  }
  frame.covered = PixelRect();
  if (!covered.empty())
  {
    frame.covered = { covered.x0, covered.y0, std::min(covered.x1, frame.width),
      std::min(covered.y1, frame.height) };
  }
  return same;
}
}
