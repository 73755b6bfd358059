// The depths of a light's view, merged over the objects of all processes.
#ifndef svoSharedDepth_h
#define svoSharedDepth_h

#include "svoHits.h"
#include "svoProcesses.h"
#include "svoView.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
/// The merging step of Huang and Cheng, 2017, with processes in place of objects. A texel is one
/// number, so that the smallest of them is the nearest caster and, of equally near ones, that of
/// the smallest index: 39 bits of depth from the near to the far plane (finer than a float), 24
/// bits of the caster's index, and none of the sign.
class SharedDepth
{
public:
  static constexpr std::uint32_t MostCasters = (1u << 24) - 1;

  /// Takes the depths that this process has traced, and merges them with the others'. A collective
  /// call. `first`: the index, among the instances of all processes, of this one's first.
  void merge(Processes& processes, const View& view, const Hits& traced, std::size_t first);

  void clear()
  {
    this->Texels.clear();
    this->TileBegin.clear();
  }
  bool merged() const { return !this->TileBegin.empty(); }

  /// Depth and caster at a texel (index as DepthBuffer::at): false if there is none. `caster`:
  /// among the instances of all processes.
  bool at(std::size_t texel, std::uint32_t& caster, double& depth) const
  {
    assert(texel >> 6 < this->TileBegin.size());
    const std::uint32_t begin = this->TileBegin[texel >> 6];
    if (begin == Nothing || this->Texels[begin + (texel & 63)] == Empty)
    {
      return false;
    }
    const std::uint64_t value = this->Texels[begin + (texel & 63)];
    caster = static_cast<std::uint32_t>(value & MostCasters);
    depth = this->Near + static_cast<double>(value >> 24) * this->Step;
    return true;
  }

  /// True if something lies in a tile.
  bool holds(std::size_t tile) const { return this->TileBegin[tile] != Nothing; }

  /// Bytes that the merged texels take.
  std::size_t bytes() const { return this->Texels.size() * sizeof(std::uint64_t); }

private:
  static constexpr std::uint32_t Nothing = ~0u;
  static constexpr std::uint64_t Empty = ~std::uint64_t(0) >> 1;

  double Near = 0.0;                    // linear depth, world
  double Step = 1.0;                    // between two depths
  std::vector<std::uint32_t> TileBegin; // per tile, in Texels, or Nothing
  std::vector<std::uint64_t> Texels;
};
}

#endif
