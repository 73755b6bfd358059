// Which triangle of its brick's list stands for a voxel, as far as rays have asked.
//
// Finding it means to fetch every triangle of the list, which costs a ray as much as its walk; but
// it is a property of the voxel alone, and pictures hit the same voxels again and again. So what
// was found is kept, a byte for each voxel. Threads that ask at the same time find the same, and a
// byte is written whole: whoever comes second writes what is there already.
#ifndef svoBrickRepresentatives_h
#define svoBrickRepresentatives_h

#include "svoLayout.h"
#include "svoNode.h"

#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace svo
{
class BrickRepresentatives
{
public:
  /// A list's later triangles are not kept.
  static constexpr int MostPlaces = std::numeric_limits<std::uint8_t>::max();

  /// Keeps none.
  BrickRepresentatives() = default;
  BrickRepresentatives(const Header& header, const Node* nodes)
    : BrickBegin(header.depthBegin[header.depthCount - 1])
  {
    if (header.voxelCount > std::numeric_limits<std::uint32_t>::max())
    {
      return;
    }
    this->FirstVoxels.reserve(header.nodeCount - this->BrickBegin);
    std::uint32_t voxels = 0;
    for (std::uint32_t brick = this->BrickBegin; brick < header.nodeCount; ++brick)
    {
      this->FirstVoxels.push_back(voxels);
      voxels += static_cast<std::uint32_t>(childCount(nodes[brick]));
    }
    this->Count = voxels;
    this->Places = std::make_unique<std::atomic<std::uint8_t>[]>(voxels);
  }

  /// False: keeps none. The other functions must not be called.
  explicit operator bool() const { return this->Places != nullptr; }

  /// Names the voxel of a brick before which there are `before` others.
  std::size_t voxel(std::uint32_t brick, int before) const
  {
    assert(brick >= this->BrickBegin && brick - this->BrickBegin < this->FirstVoxels.size());
    const std::size_t voxel =
      this->FirstVoxels[brick - this->BrickBegin] + static_cast<std::size_t>(before);
    assert(voxel < this->Count);
    return voxel;
  }

  /// Says that place() will be asked for soon.
  void prefetch(std::size_t voxel) const { __builtin_prefetch(&this->Places[voxel]); }
  /// The triangle's place in the brick's list; negative if it is not known.
  int place(std::size_t voxel) const
  {
    return this->Places[voxel].load(std::memory_order_relaxed) - 1;
  }
  void keep(std::size_t voxel, int place) const
  {
    assert(place >= 0);
    if (place < MostPlaces)
    {
      this->Places[voxel].store(static_cast<std::uint8_t>(place + 1), std::memory_order_relaxed);
    }
  }

  std::size_t bytes() const
  {
    return this->FirstVoxels.size() * sizeof(std::uint32_t) + this->Count;
  }

private:
  std::uint32_t BrickBegin = 0;
  std::size_t Count = 0;
  std::vector<std::uint32_t> FirstVoxels;              // of each brick
  std::unique_ptr<std::atomic<std::uint8_t>[]> Places; // 1 + place; 0: not known
};
}

#endif
