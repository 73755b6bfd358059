// The pixels of the last frame as points with colours, brought to where a new view sees them (image
// warping: McMillan and Bishop, "Plenoptic Modeling", 1995; holes are traced: Walter, Drettakis,
// Parker, "Interactive Rendering using the Render Cache", 1999).
//
// A point is shown at pixels whose centres lie within an error of where it is: that is how far
// anything is from its place, however old it is, since points stay where they were traced. The
// nearest surface wins, of that the point nearest to the pixel's centre. Tiles with a pixel to
// which no point comes are traced: what was hidden, or outside of the view, is seen there. Surfaces
// that were hidden show nowhere else, unless what hid them moves by more than its own width from
// one frame to the next.
#ifndef svoWarpedImage_h
#define svoWarpedImage_h

#include "svoFrame.h"
#include "svoHits.h"
#include "svoParallel.h"
#include "svoRawArray.h"
#include "svoView.h"
#include "vtkSVOTracingModule.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace svo
{
class VTKSVOTRACING_EXPORT WarpedImage
{
public:
  /// Nothing is known any more.
  void forget();

  /// What an error of so many pixels comes to: points come to the centres of pixels at best.
  static double errorOf(double wanted) { return std::clamp(wanted, 0.5, 1.0); }

  /// Brings what is known to a view. `error`: pixels, see errorOf(); 0: nothing is shown again.
  /// False if nothing is known of it, so all tiles are wanted, as in parallel views.
  bool warp(const View& view, double error, const ParallelFor& parallelFor);

  /// One byte a tile: some of its pixels are to be traced, ...
  const std::vector<std::uint8_t>& wanted() const { return this->Wanted; }
  /// ... namely these, one byte each, 64 a tile.
  const std::vector<std::uint8_t>& missing() const { return this->Missing; }
  /// Share of the pixels that are not.
  double share() const;

  /// Takes what was traced and shaded of the pixels that are missing.
  void add(const Hits& hits, const Frame& frame, const ParallelFor& parallelFor);
  /// Writes the others, and says so in Frame::tiles and Frame::covered.
  void write(Frame& frame, const ParallelFor& parallelFor) const;

  std::size_t memory() const;

private:
  struct Points // 64 a tile
  {
    RawArray<float> x, y, z; // view space; of background: a direction, z = -1 when it was made
    RawArray<std::uint32_t> color, instance;
    void resize(std::size_t count);
    std::size_t bytes() const { return this->x.size() * 5 * sizeof(float); }
  };
  void place(std::size_t tile, const View& view, const float matrix[12]);
  void fill(int firstRow, int endRow, const View& view);
  std::uint64_t unsure(std::size_t tile) const;
  bool isDue(std::size_t tile) const;
  bool isCorner(int x, int y, std::uint32_t own) const;
  std::uint32_t pointAt(int x, int y, const View& view, float error) const;
  bool take(std::size_t tile, const View& view, float error);
  void addTile(std::size_t tile, const Hits& hits, const Frame& frame);

  std::size_t at(int x, int y) const // of the new view
  {
    return 64 * (static_cast<std::size_t>(y >> 3) * this->NextX + (x >> 3)) + 8 * (y & 7) + (x & 7);
  }
  float depthOf(std::size_t point) const
  {
    return this->Held.instance[point] == NoInstance ? std::numeric_limits<float>::infinity()
                                                    : -this->Held.z[point];
  }

  View Seen;
  bool Known = false;
  int TilesX = 0, TilesY = 0; // of Seen
  int NextX = 0, NextY = 0;   // of the view that is being filled
  Points Held, Next;
  RawArray<float> U, V;                  // pixels; where the points held are in the new view
  std::vector<float> Lowest, Highest;    // V of each tile's points
  RawArray<std::uint32_t> Keys, Sources; // by pixel of the new view
  std::vector<std::uint8_t> Wanted, Missing;
  std::size_t Frames = 0;
};
}

#endif
