// The edges among the hits of the eye's rays, and where shadows begin on them.
#ifndef svoDepthEdges_h
#define svoDepthEdges_h

#include "svoDarkness.h"
#include "svoDepthBuffer.h"
#include "svoEdges.h"
#include "svoHits.h"
#include "svoView.h"
#include "svoWorldSize.h"

#include <cstdint>
#include <vector>

namespace svo
{
class DepthEdges
{
public:
  /// `darkness`: per pixel, as the view's depth buffer.
  DepthEdges(const Hits& eye, const std::vector<Darkness>& darkness, const View& view)
    : Depth(eye.depth)
    , Eye(eye)
    , Dark(darkness)
    , EyeView(view)
  {
  }

  /// Writes the pixels (8 * row + column) of the tile that are hits and edges; returns how many.
  int find(int tileX, int tileY, int pixels[64]) const
  {
    int count = 0;
    for (int k = 0; k < 64; ++k)
    {
      const int x = 8 * tileX + (k & 7);
      const int y = 8 * tileY + (k >> 3);
      if (this->instance(x, y) != NoInstance && isEdge(*this, x, y))
      {
        pixels[count++] = k;
      }
    }
    return count;
  }

  std::uint32_t instance(int x, int y) const
  {
    if (x < 0 || y < 0 || x >= this->EyeView.width || y >= this->EyeView.height)
    {
      return NoInstance;
    }
    const std::size_t at = this->Depth.at(x, y);
    return this->Depth.hit[at >> 6] ? this->Depth.instance[at] : NoInstance;
  }

  bool changes(int x, int y) const
  {
    return this->changes(x, y, 1, 0) || this->changes(x, y, 0, 1);
  }

private:
  bool changes(int x, int y, int dx, int dy) const
  {
    const std::size_t at = this->Depth.at(x, y);
    const std::size_t before = this->Depth.at(x - dx, y - dy);
    const std::size_t after = this->Depth.at(x + dx, y + dy);
    const double t = this->Depth.t[at];
    return shadowChanges(this->Dark[before], this->Dark[at]) ||
      shadowChanges(this->Dark[after], this->Dark[at]) ||
      depthSteps<double>(this->Depth.t[before], t, this->Depth.t[after],
        worldPixel(this->EyeView, this->Eye.base(this->Depth.instance[at]) + t));
  }

  const DepthBuffer& Depth;
  const Hits& Eye;
  const std::vector<Darkness>& Dark;
  const View& EyeView;
};
}

#endif
