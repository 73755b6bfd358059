// Which tiles of a depth buffer are still what the view's instances give, and which have to be
// merged anew: those that an instance touches, or touched, that has changed.
#ifndef svoMergedTiles_h
#define svoMergedTiles_h

#include "svoDepthBuffer.h"
#include "svoDepthOffset.h"
#include "svoLayerKey.h"
#include "svoTileGrid.h"
#include "svoView.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
/// An instance as far as a merged tile depends on it.
struct MergedPart
{
  std::uint32_t index; // in Scene::instances
  LayerKey key;
  DepthOffset offset;
  PixelRect rect;

  bool operator==(const MergedPart& other) const
  {
    return index == other.index && key == other.key && offset == other.offset;
  }
};

class MergedTiles
{
public:
  /// Prepares a frame of these parts, in the order of their indices; their memory is exchanged for
  /// that of the last frame's. `keep`: tiles that no changed part touches, and that were looked at,
  /// stay, if the view has the same image and a crop as large. `wanted`: one byte a
  /// place of the view's grid, or null for all; tiles that are not wanted are empty unless they are
  /// known. Returns false if all tiles are new.
  bool beginFrame(
    const View& view, std::vector<MergedPart>& parts, bool keep, const std::uint8_t* wanted);
  void forget()
  {
    this->States = {};
    this->Changes = {};
  }

  /// True if the tile is to be emptied, and merged if it is wanted.
  bool isStale(std::size_t tile) const { return this->changeOf(tile) != Change::None; }
  bool isMerged(std::size_t tile) const
  {
    return this->isStale(tile) && this->States[tile] == Known;
  }
  /// True if what the stale tile was in the last frame is what the same parts gave, but for those
  /// that changed.
  bool wasMerged(std::size_t tile) const { return this->changeOf(tile) == Change::Touched; }
  /// The stale tile is unchanged after all. Threads may settle different tiles.
  void settle(std::size_t tile)
  {
    assert(this->wasMerged(tile));
    this->Changes[tile] = Change::Same;
  }
  /// After the frame: true if the tile may have changed since the last one.
  bool changed(std::size_t tile) const { return this->changeOf(tile) >= Change::Touched; }
  /// True if the part (by index in Scene::instances) has changed, or is gone.
  bool partChanged(std::uint32_t index) const
  {
    return this->ChangedParts[std::min<std::size_t>(index, this->ChangedParts.size() - 1)] != 0;
  }
  /// True if such a part is one of a tile's 64 hits.
  bool anyChanged(const std::uint32_t* instances) const
  {
    const std::vector<std::uint32_t>& all = this->ChangedIndices;
    constexpr std::size_t Few = 8;
    return all.size() <= Few ? std::any_of(all.begin(), all.end(),
                                 [=](std::uint32_t one) { return anyOf(instances, one); })
                             : std::any_of(instances, instances + 64,
                                 [this](std::uint32_t i) { return this->partChanged(i); });
  }
  /// True if any tile is stale.
  bool anyStale() const { return this->Any; }

private:
  enum State : std::uint8_t
  {
    Unknown, // and empty
    Known
  };
  enum class Change : std::uint8_t
  {
    None,
    Same,    // looked at again: no changed part was or is seen
    Touched, // by a part that changed
    New      // nothing is known of it
  };
  Change changeOf(std::size_t tile) const
  {
    assert(tile < this->Changes.size());
    return this->Changes[tile];
  }
  void touch(const MergedPart& part);
  void forgetOthers(const TileGrid& before);

  View Seen;
  TileGrid Grid; // of it
  std::vector<MergedPart> Parts;
  std::vector<std::uint8_t> States;            // per tile
  std::vector<Change> Changes;                 // per tile
  std::vector<std::uint8_t> ChangedParts{ 0 }; // by index, and a last one for all others
  std::vector<std::uint32_t> ChangedIndices;   // the same ones
  bool Any = true;
};
}

#endif
