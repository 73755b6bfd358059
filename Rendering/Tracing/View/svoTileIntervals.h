// Conservative intervals of depth in which the rays of a tile of 8x8 pixels can meet an object.
// Tiles beside the object have none and are skipped; rays of the others start just before it and
// end just behind.
#ifndef svoTileIntervals_h
#define svoTileIntervals_h

#include "svoOctree.h"
#include "svoParallel.h"
#include "svoRay.h"
#include "svoView.h"
#include "vtkSVOTracingModule.h"

#include <cassert>
#include <vector>

#include <glm/mat4x4.hpp>

namespace svo
{
/// Intervals of the tiles of a rectangle. Tiles lie on the image's 8-pixel grid: tile (0, 0) has
/// the pixels 0..7.
struct TileIntervals
{
  static constexpr int TileSize = 8; // pixels

  int column0 = 0; // first tile
  int row0 = 0;
  int columns = 0;
  int rows = 0;
  /// Row by row; linear depth of the view minus the caller's base. A tile that no ray can hit has
  /// tNear = infinity and tFar = -infinity.
  std::vector<float> tNear;
  std::vector<float> tFar;

  /// Index of a tile of the image, which must be one of the rectangle.
  std::size_t index(int column, int row) const
  {
    assert(column >= column0 && column < column0 + columns && row >= row0 && row < row0 + rows);
    return static_cast<std::size_t>(row - row0) * columns + (column - column0);
  }
};

/// Projects the occupied cells of an octree, down to cells of a few pixels, onto the tiles that
/// `rect` (pixels) touches. Every hit that a ray of `options` through any point of a tile has lies
/// in the tile's interval: 0.01 pixels and 1e-5 of the object's depth are added for rounding, and
/// for leaf geometries other than Voxel the reach of a plane beyond its cell. A cell that crosses
/// the eye plane covers all tiles. `base` is subtracted from all depths before they become floats.
/// The result does not depend on the executor.
VTKSVOTRACING_EXPORT void computeTileIntervals(const Octree& octree, const glm::dmat4& localToWorld,
  const View& view, const PixelRect& rect, const TraceOptions& options, double base,
  const ParallelFor& parallelFor, TileIntervals& intervals);
}

#endif
