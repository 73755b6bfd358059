#include "svoSharedDepth.h"

#include <algorithm>
#include <cmath>

namespace svo
{
void SharedDepth::merge(
  Processes& processes, const View& view, const Hits& traced, std::size_t first)
{
  constexpr double Depths = static_cast<double>((std::uint64_t(1) << 39) - 1);
  this->Near = view.tNear;
  this->Step = (view.tFar - view.tNear) / Depths;

  // Only tiles where somebody has something are sent around.
  const DepthBuffer& own = traced.depth;
  std::vector<std::uint64_t> empty(own.tiles());
  for (std::size_t tile = 0; tile < empty.size(); ++tile)
  {
    empty[tile] = own.hit[tile] ? 0 : 1;
  }
  processes.minimum(empty);
  this->TileBegin.assign(empty.size(), Nothing);
  std::uint32_t size = 0;
  for (std::size_t tile = 0; tile < empty.size(); ++tile)
  {
    if (!empty[tile])
    {
      this->TileBegin[tile] = size;
      size += 64;
    }
  }
  this->Texels.assign(size, Empty);
  for (std::size_t tile = 0; tile < empty.size(); ++tile)
  {
    for (std::size_t k = 64 * tile; own.hit[tile] && k < 64 * (tile + 1); ++k)
    {
      const std::uint32_t instance = own.instance[k];
      if (instance != NoInstance)
      {
        const double depth = (traced.base(instance) + own.t[k] - this->Near) / this->Step;
        const auto steps = static_cast<std::uint64_t>(std::clamp(std::round(depth), 0.0, Depths));
        this->Texels[this->TileBegin[tile] + (k & 63)] =
          steps << 24 | std::min<std::size_t>(first + instance, MostCasters - 1);
      }
    }
  }
  processes.minimum(this->Texels);
}
}
