// Pixels where the picture changes from one surface, depth or shadow to another.
#ifndef svoEdges_h
#define svoEdges_h

#include "svoDepthBuffer.h"
#include "svoLayeredView.h"
#include "svoView.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace svo
{
/// How dark a pixel is in the shadows of the lights: four bits for each of the first eight, the
/// others share theirs with these.
using Darkness = std::uint32_t;

/// `share` of light number l, 0..1.
inline void darken(Darkness& darkness, std::size_t l, float share)
{
  const unsigned shift = 4 * (l % 8);
  const Darkness held = (darkness >> shift) & 15u;
  const Darkness more = static_cast<Darkness>(std::clamp(share, 0.0f, 1.0f) * 15.0f + 0.5f);
  darkness = (darkness & ~(15u << shift)) | (std::min(held + more, 15u) << shift);
}

/// True if one light's shadow changes from the one to the other by more than an eighth of the
/// light; a gentler change needs no further rays.
inline bool shadowChanges(Darkness a, Darkness b)
{
  if (a == b)
  {
    return false;
  }
  for (unsigned shift = 0; shift < 32; shift += 4)
  {
    const int change = static_cast<int>((a >> shift) & 15u) - static_cast<int>((b >> shift) & 15u);
    if (std::abs(change) > 2)
    {
      return true;
    }
  }
  return false;
}

class EdgeFinder
{
public:
  /// `darkness`: per pixel, as the depth buffer.
  EdgeFinder(const DepthBuffer& depth, const LayeredView& eye,
    const std::vector<Darkness>& darkness, const View& view)
    : Depth(depth)
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
      if (x < this->EyeView.width && y < this->EyeView.height &&
        this->instance(x, y) != NoInstance && (this->edge(x, y, 1, 0) || this->edge(x, y, 0, 1)))
      {
        pixels[count++] = k;
      }
    }
    return count;
  }

private:
  std::uint32_t instance(int x, int y) const
  {
    if (x < 0 || y < 0 || x >= this->EyeView.width || y >= this->EyeView.height)
    {
      return NoInstance;
    }
    const std::size_t at = this->Depth.at(x, y);
    return this->Depth.hit[at >> 6] ? this->Depth.instance[at] : NoInstance;
  }

  /// Compares a pixel with its two neighbours in one direction.
  bool edge(int x, int y, int dx, int dy) const
  {
    const std::uint32_t i = this->instance(x, y);
    if (this->instance(x - dx, y - dy) != i || this->instance(x + dx, y + dy) != i)
    {
      return true;
    }
    const std::size_t at = this->Depth.at(x, y);
    const std::size_t before = this->Depth.at(x - dx, y - dy);
    const std::size_t after = this->Depth.at(x + dx, y + dy);
    if (shadowChanges(this->Dark[before], this->Dark[at]) ||
      shadowChanges(this->Dark[after], this->Dark[at]))
    {
      return true;
    }
    // One surface bends little between pixels; a step is of more than a few pixels' size.
    const double bend =
      std::abs(double(this->Depth.t[before]) - 2.0 * this->Depth.t[at] + this->Depth.t[after]);
    return bend > 3.0 * worldPixel(this->EyeView, this->Eye.base(i) + this->Depth.t[at]);
  }

  const DepthBuffer& Depth;
  const LayeredView& Eye;
  const std::vector<Darkness>& Dark;
  const View& EyeView;
};
}

#endif
