// The tiles of a frame that show something, and the wiping of those that did so the last time.
#ifndef svoFrameTiles_h
#define svoFrameTiles_h

#include "svoDepthBuffer.h"
#include "svoTracer.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// Makes the pixels of the tile whose lower left pixel is (x0, y0) misses.
void wipeTile(Frame& frame, int x0, int y0);

/// A frame is wiped as a whole only where it is new; after that only tiles that lost their hits
/// are, and the others are written anew by shading.
class FrameTiles
{
public:
  /// Makes the frame as large as the view, finds the tiles with hits and Frame::covered, and wipes
  /// tiles that have none any more.
  void begin(const DepthBuffer& depth, const View& view, bool writeNormals, Frame& frame);

  /// Indices into the depth buffer's tiles, ascending.
  const std::vector<std::uint32_t>& hits() const { return this->Hits; }

private:
  std::vector<std::uint32_t> Hits;
  std::vector<std::uint8_t> Written; // per tile: the last frame wrote it
  const std::uint8_t* WrittenTo = nullptr;
};
}

#endif
