#include "svoTileIntervals.h"

#include "svoLeafTraits.h"
#include "svoNode.h"
#include "svoProjection.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace svo
{
namespace
{
constexpr double PixelSlack = 0.01;
constexpr double DepthSlack = 1e-5; // of the depth of the whole cube
/// Cells up to this size are not divided any more. Smaller ones would shorten the rays a little,
/// but cost more than that saves.
constexpr double CellPixels = 16.0;
constexpr int RowsPerTask = 8; // tiles
/// Cells that cross the eye plane are divided down to this level.
constexpr int EyePlaneLevel = 6;
constexpr std::size_t ManyTiles = 64;

/// A cell size: steps to the cells' lower corners, and from there to the bounds of a cell.
struct Steps
{
  glm::dvec4 child[8]; // from the lower corner of the cell that is twice as wide
  glm::dvec4 least, most;
};

/// What one cell covers.
struct Footprint
{
  double x0, y0, x1, y1; // pixels
  float t0, t1;
  bool everywhere; // crosses the eye plane
};

/// One walk through the octree for some rows of tiles.
class Projector
{
public:
  Projector(const Octree& octree, const Projection& projection, int stopBits, const View& view,
    TileIntervals& intervals)
    : Nodes(octree.nodes())
    , Map(projection)
    , StopBits(stopBits)
    , Intervals(intervals)
  {
    // Nearer cells first, so that they can hide what lies between them and the far side.
    this->Front = int(projection.x[3] < 0.0) | int(projection.y[3] < 0.0) << 1 |
      int(projection.z[3] < 0.0) << 2;
    this->MiddleX = 0.5 * view.width;
    this->MiddleY = 0.5 * view.height;
    const glm::dvec4 zero(0.0);
    for (int bits = 0; bits <= NodeLevels * MaximumDepths; ++bits)
    {
      const double size = std::ldexp(1.0, -bits);
      const glm::dvec4 x = size * projection.x, y = size * projection.y, z = size * projection.z;
      Steps& steps = this->Levels[bits];
      steps.least = glm::min(x, zero) + glm::min(y, zero) + glm::min(z, zero);
      steps.most = glm::max(x, zero) + glm::max(y, zero) + glm::max(z, zero);
      for (int i = 0; i < 8; ++i)
      {
        steps.child[i] = double(i & 1) * x + double(i >> 1 & 1) * y + double(i >> 2) * z;
      }
    }
  }

  void rows(int first, int last, float tNear, float tFar)
  {
    this->FirstRow = first;
    this->LastRow = last;
    this->Near = tNear;
    this->Far = tFar;
    this->visit(0, this->Map.corner, 0);
  }

private:
  /// The cells of a node from `first` on that make up one `Above` them: its projected lower corner,
  /// and bits of its coordinates.
  template <int Above = NodeLevels>
  void visit(std::uint32_t index, const glm::dvec4& corner, int bits, int first = 0)
  {
    const Node& node = this->Nodes[index];
    for (int i = 0; i < 8; ++i)
    {
      const int octant = i ^ this->Front;
      const int cells = first + octant * cellsBelow(Above - 1);
      if (occupiedBelow(node, cells, Above - 1) == 0)
      {
        continue;
      }
      const glm::dvec4 half = corner + this->Levels[bits + 1].child[octant];
      if (this->settle(half, bits + 1))
      {
        continue;
      }
      if constexpr (Above > 1)
      {
        this->visit<Above - 1>(index, half, bits + 1, cells);
      }
      else
      {
        this->visit(child(node, cells), half, bits + 1);
      }
    }
  }

  /// True if nothing of the cell needs to be looked at more closely.
  bool settle(const glm::dvec4& corner, int bits)
  {
    Footprint f;
    this->project(corner, bits, f);
    if (f.t1 < this->Near || f.t0 > this->Far)
    {
      return true;
    }
    int column0 = 0, column1 = this->Intervals.columns - 1;
    int row0 = this->FirstRow, row1 = this->LastRow - 1;
    bool small = bits >= this->StopBits;
    if (f.everywhere)
    {
      small = small || bits >= EyePlaneLevel;
    }
    else
    {
      constexpr double scale = 1.0 / TileIntervals::TileSize;
      const auto tile = [](double v, int origin)
      {
        // std::floor is a call without SSE4.1.
        const double clamped = std::clamp(v * scale, -1e9, 1e9);
        const int towardsZero = static_cast<int>(clamped);
        return towardsZero - (clamped < towardsZero) - origin;
      };
      column0 = std::max(column0, tile(f.x0, this->Intervals.column0));
      column1 = std::min(column1, tile(f.x1, this->Intervals.column0));
      row0 = std::max(row0, tile(f.y0, this->Intervals.row0));
      row1 = std::min(row1, tile(f.y1, this->Intervals.row0));
      if (column0 > column1 || row0 > row1)
      {
        return true;
      }
      small = small || std::max(f.x1 - f.x0, f.y1 - f.y0) <= CellPixels;
    }
    const std::size_t columns = this->Intervals.columns;
    float* tNear = this->Intervals.tNear.data();
    float* tFar = this->Intervals.tFar.data();
    if (small)
    {
      for (int row = row0; row <= row1; ++row)
      {
        for (std::size_t i = row * columns + column0; i <= row * columns + column1; ++i)
        {
          tNear[i] = std::min(tNear[i], f.t0);
          tFar[i] = std::max(tFar[i], f.t1);
        }
      }
      return true;
    }
    // Nothing inside can widen an interval that holds all of the cell.
    if (std::size_t(column1 - column0 + 1) * (row1 - row0 + 1) > ManyTiles)
    {
      return false;
    }
    for (int row = row0; row <= row1; ++row)
    {
      for (std::size_t i = row * columns + column0; i <= row * columns + column1; ++i)
      {
        if (f.t0 < tNear[i] || f.t1 > tFar[i])
        {
          return false;
        }
      }
    }
    return true;
  }

  void project(const glm::dvec4& corner, int bits, Footprint& f) const
  {
    const glm::dvec4 least = corner + this->Levels[bits].least;
    const glm::dvec4 most = corner + this->Levels[bits].most;
    f.t0 = static_cast<float>(least[3]);
    f.t1 = static_cast<float>(most[3]);
    f.everywhere = !(least[2] > 1e-9 * most[2]);
    if (f.everywhere)
    {
      return;
    }
    // Bounds of x / w from bounds of x and of w: wider than the projected corners by the cell's
    // parallax only, which is little since x is small where the middle of the image is the origin.
    const double nearest = 1.0 / least[2];
    const double farthest = 1.0 / most[2];
    const auto lower = [&](int a) { return least[a] * (least[a] < 0.0 ? nearest : farthest); };
    const auto upper = [&](int a) { return most[a] * (most[a] > 0.0 ? nearest : farthest); };
    f.x0 = lower(0) - PixelSlack + this->MiddleX;
    f.y0 = lower(1) - PixelSlack + this->MiddleY;
    f.x1 = upper(0) + PixelSlack + this->MiddleX;
    f.y1 = upper(1) + PixelSlack + this->MiddleY;
  }

  const Node* Nodes;
  Projection Map;
  int StopBits;
  TileIntervals& Intervals;
  Steps Levels[NodeLevels * MaximumDepths + 1];
  double MiddleX;
  double MiddleY;
  int Front;
  int FirstRow = 0;
  int LastRow = 0;
  float Near = 0.0f;
  float Far = 0.0f;
};
}

void computeTileIntervals(const Octree& octree, const glm::dmat4& localToWorld, const View& view,
  const PixelRect& rect, const TraceOptions& options, double base, const ParallelFor& parallelFor,
  TileIntervals& intervals)
{
  constexpr int size = TileIntervals::TileSize;
  const int x0 = std::max(rect.x0, 0), y0 = std::max(rect.y0, 0);
  const int x1 = std::min(rect.x1, view.width), y1 = std::min(rect.y1, view.height);
  intervals.column0 = x0 / size;
  intervals.row0 = y0 / size;
  intervals.columns = std::max((x1 + size - 1) / size - intervals.column0, 0);
  intervals.rows = std::max((y1 + size - 1) / size - intervals.row0, 0);
  const std::size_t tiles = std::size_t(intervals.columns) * intervals.rows;
  const float infinity = std::numeric_limits<float>::infinity();
  intervals.tNear.assign(tiles, infinity);
  intervals.tFar.assign(tiles, -infinity);
  if (tiles == 0 || !octree || octree.empty())
  {
    return;
  }
  const Projection projection = makeProjection(octree, localToWorld, view, base);
  const int level = std::clamp(options.level, 0, octree.level());
  const double depth =
    std::abs(projection.x[3]) + std::abs(projection.y[3]) + std::abs(projection.z[3]);
  double slack = DepthSlack * depth + 1e-6 * std::abs(projection.corner[3]);
  slack += traitsOf(options.leafGeometry).reach * std::ldexp(depth, -octree.rootBits(level));
  const float tNear = static_cast<float>(view.tNear - base - slack);
  const float tFar = static_cast<float>(std::min(view.tFar - base + slack, 1e30));
  parallelFor(0, intervals.rows, RowsPerTask,
    [&](std::size_t first, std::size_t last)
    {
      Projector projector(octree, projection, std::max(octree.rootBits(level), 1), view, intervals);
      projector.rows(static_cast<int>(first), static_cast<int>(last), tNear, tFar);
      const float widen = static_cast<float>(slack);
      for (std::size_t i = first * intervals.columns; i < last * intervals.columns; ++i)
      {
        intervals.tNear[i] -= widen; // infinities stay
        intervals.tFar[i] += widen;
      }
    });
}
}
