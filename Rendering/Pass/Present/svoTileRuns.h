// The tiles of a frame in two lists of rectangles: those that are covered whole, and others that
// have hits.
#ifndef svoTileRuns_h
#define svoTileRuns_h

#include "svoFrame.h"

#include <vector>

namespace svo
{
struct TileRuns
{
  std::vector<PixelRect> whole; // every pixel is a hit
  std::vector<PixelRect> mixed; // some are
};

/// Rectangles of tiles of 8x8 pixels, as long as they are alike; those of the frame's border may be
/// smaller. Together they have every hit, each once. Where a tracer does not say what tiles are,
/// Frame::covered is one rectangle of the second list.
TileRuns tileRunsOf(const Frame& frame);
}

#endif
