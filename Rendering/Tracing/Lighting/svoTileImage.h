// A tile's pixels of a frame, put together patch by patch and written all at once.
#ifndef svoTileImage_h
#define svoTileImage_h

#include "svoFrame.h"
#include "svoTileLighting.h"
#include "svoTilePatch.h"

namespace svo
{
class TileImage
{
public:
  /// To be made before the tile is shaded: asks for the frame's memory, which nobody has read, so
  /// that writing it later does not wait.
  TileImage(const TileHits& hits, Frame& frame);
  /// `offset`, and `factor` times the facets' slopes, are added to window depths.
  void put(const TilePatch& patch, const TileColors& colors, double offset, double factor);
  /// Slopes of these depths, where the frame has them; 0 where depths are not `tilted`.
  void putSlopes(const TilePatch& patch, bool tilted);
  /// Writes colours, depths, slopes and names of all pixels of the tile that are in the frame.
  /// Normals of misses as well, if there are any.
  void write() const;

private:
  const TileHits& Hits;
  Frame& Picture;
  alignas(64) std::uint32_t Color[TileHits::Most];
  alignas(64) float Depth[TileHits::Most];
  alignas(64) float Slopes[2 * TileHits::Most];
};
}

#endif
