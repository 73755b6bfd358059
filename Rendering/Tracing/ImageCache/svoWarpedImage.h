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

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
class VTKSVOTRACING_EXPORT WarpedImage
{
public:
  /// Nothing is known any more.
  void forget();

  /// Brings what is known to a view. `error`: pixels, between 0.5 and 1, or what of these is next to
  /// it; 0: none is accepted. False if nothing is known of it, so all tiles are wanted, as in
  /// parallel views.
  bool warp(const View& view, double error, const ParallelFor& parallelFor);

  /// One byte a tile: it is to be traced. Others may be asked for before add().
  const std::vector<std::uint8_t>& wanted() const { return this->Wanted; }
  void want(std::size_t tile) { this->Wanted[tile] = 1; }
  /// Share of the tiles that are not.
  double share() const;

  /// Takes what was traced and shaded of the tiles that are wanted.
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
  void fill(int firstRow, int endRow, const View& view, float error);
  bool take(std::size_t tile, const View& view);
  void addTile(std::size_t tile, const Hits& hits, const Frame& frame);

  View Seen;
  bool Known = false;
  int TilesX = 0, TilesY = 0; // of Seen
  int NextX = 0, NextY = 0;   // of the view that is being filled
  Points Held, Next;
  RawArray<float> U, V;               // pixels; where the points held are in the new view
  std::vector<float> Lowest, Highest; // V of each tile's points
  RawArray<std::uint32_t> Keys, Sources;
  std::vector<std::uint8_t> Wanted;
};
}

#endif
