// Which tiles of a depth buffer are still what the view's instances give, and which have to be
// merged anew: those that an instance touches, or touched, that is not what it was.
#ifndef svoMergedTiles_h
#define svoMergedTiles_h

#include "svoDepthLayer.h"
#include "svoView.h"

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
  double offset; // of window depths
  PixelRect rect;

  bool operator==(const MergedPart& other) const
  {
    return index == other.index && key == other.key && offset == other.offset;
  }
};

class MergedTiles
{
public:
  /// Prepares a frame of these parts, in the order of their indices. `keep`: tiles that no changed
  /// part touches are what they were, if the view is the same. `wanted`: one byte a tile, or null
  /// for all; tiles that are not wanted are empty unless they are known. Returns false if all tiles
  /// are new.
  bool beginFrame(
    const View& view, std::vector<MergedPart> parts, bool keep, const std::uint8_t* wanted);
  void forget() { this->States.clear(); }

  /// True if the tile is to be emptied, and merged if it is wanted.
  bool isStale(std::size_t tile) const
  {
    assert(tile < this->Stale.size());
    return this->Stale[tile] != 0;
  }
  bool isMerged(std::size_t tile) const
  {
    return this->isStale(tile) && this->States[tile] == Known;
  }
  /// True if any tile is.
  bool anyStale() const { return this->Any; }

private:
  enum State : std::uint8_t
  {
    Unknown, // and empty
    Known
  };
  void touch(const PixelRect& rect, int tilesX);

  View Seen;
  std::vector<MergedPart> Parts;
  std::vector<std::uint8_t> States, Stale; // per tile
  bool Any = true;
};
}

#endif
