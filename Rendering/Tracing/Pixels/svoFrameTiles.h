// The tiles of a frame that have hits; tiles that had hits in the last frame only are wiped.
#ifndef svoFrameTiles_h
#define svoFrameTiles_h

#include "svoDepthBuffer.h"
#include "svoFrame.h"
#include "svoParallel.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// A frame is wiped as a whole only where its size or its arrays are others; else only tiles that
/// lost their hits are, and the others are written anew by shading.
class FrameTiles
{
public:
  /// Begins a new version of the frame, always the same one: makes it as large as the view, finds
  /// the tiles with hits and Frame::covered, and wipes tiles that have none any more. Returns true
  /// if the other tiles of the frame are unchanged.
  bool find(
    const DepthBuffer& depth, const View& view, const FrameSettings& settings, Frame& frame);

  /// Indices into the depth buffer's tiles, ascending.
  const std::vector<std::uint32_t>& hits() const { return this->Hits; }

  /// Calls function(tileX, tileY, scratch) for the tiles with hits; a scratch serves some of them,
  /// one after the other.
  template <class Scratch, class Function>
  void each(const ParallelFor& parallelFor, const Function& function) const
  {
    parallelFor(0, this->Hits.size(), 32,
      [&](std::size_t first, std::size_t last)
      {
        Scratch scratch;
        for (std::size_t k = first; k < last; ++k)
        {
          const int tile = static_cast<int>(this->Hits[k]);
          function(tile % this->TilesX, tile / this->TilesX, scratch);
        }
      });
  }

private:
  int TilesX = 0;
  std::vector<std::uint32_t> Hits;
  std::vector<std::uint8_t> Written; // per tile: the last frame wrote it
};
}

#endif
