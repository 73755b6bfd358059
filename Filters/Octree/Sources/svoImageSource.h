// The surface where an image of three dimensions takes a value, as a source.
//
// Between its points the image is trilinear, so in a cell no value is beyond those of its corners:
// whether a surface may pass through a cube is read off a pyramid of least and largest values; and
// in a part of a cell the extremes are at the part's corners, so cubes smaller than a cell are
// judged by those. Nothing is missed. Normals are those of differences between neighbouring points,
// interpolated as well: the trilinear field's own gradient jumps from cell to cell, and its jumps
// would be seen. They stay close to it, though.
#ifndef svoImageSource_h
#define svoImageSource_h

#include "svoBox.h"
#include "svoFieldSource.h"
#include "svoParallel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// The points of an image and where they lie.
struct ImageGrid
{
  glm::ivec3 points;  // at least 2 along each axis
  glm::dmat4 toIndex; // local coordinates -> continuous indices from 0; affine
  /// Of each cell, borrowed: those with one of the hidden marks have no surface. nullptr: none.
  const unsigned char* cellMarks = nullptr;
  unsigned char hiddenMarks = 0;

  bool isHidden(const glm::ivec3& cell) const
  {
    const std::size_t row = this->points.x - 1, slice = row * (this->points.y - 1);
    return this->cellMarks &&
      (this->cellMarks[cell.z * slice + cell.y * row + cell.x] & this->hiddenMarks) != 0;
  }
  std::size_t index(int x, int y, int z) const
  {
    return (static_cast<std::size_t>(z) * points.y + y) * points.x + x;
  }
  /// The cell that a point is in and where there, 0..1 along each axis. False outside of the image
  /// (or with NaN): then the nearest place in it.
  bool locate(const glm::dvec3& local, glm::ivec3& cell, glm::dvec3& in) const
  {
    constexpr double Rounding = 1e-9; // of indices
    const glm::dmat4& m = this->toIndex;
    bool inside = true;
    for (int i = 0; i < 3; ++i)
    {
      const double p = m[0][i] * local.x + m[1][i] * local.y + m[2][i] * local.z + m[3][i];
      const double last = this->points[i] - 1;
      inside = inside && p >= -Rounding && p <= last + Rounding;
      const double at = p > 0.0 ? std::min(p, last) : 0.0;
      cell[i] = std::min(static_cast<int>(at), this->points[i] - 2);
      in[i] = at - cell[i];
    }
    return inside;
  }
};

/// The trilinear mean of the values that at(x, y, z) has at the corners of a cell; starts from a
/// `sum` of 0.
template <class V, class At>
V trilinear(const glm::ivec3& cell, const glm::dvec3& in, V sum, const At& at)
{
  for (int i = 0; i < 8; ++i)
  {
    const glm::ivec3 upper(i & 1, i >> 1 & 1, i >> 2);
    const double weight =
      (upper.x ? in.x : 1.0 - in.x) * (upper.y ? in.y : 1.0 - in.y) * (upper.z ? in.z : 1.0 - in.z);
    const glm::ivec3 c = cell + upper;
    sum += weight * at(c.x, c.y, c.z);
  }
  return sum;
}

/// A field that is known at the points of a grid.
class GriddedField : public ScalarField
{
public:
  /// Whether finite values at points first to last, inclusive, lie on both sides of `value` or are
  /// it; and are not all the same.
  virtual bool crosses(const glm::ivec3& first, const glm::ivec3& last, double value) const = 0;
  /// Copies values at points first to last, inclusive, into rows, and slices of rows, of `row`
  /// values. False if none is below `highest` or none is at least `lowest`.
  virtual bool read(const glm::ivec3& first, const glm::ivec3& last, double lowest, double highest,
    double* to, int row) const = 0;
};

/// The direction of the smooth gradient, but no further than LargestTurn from the field's own:
/// then planes through the middles of what they stand for are apart by an eighth of a voxel where
/// voxels meet, which is ImageSource::planeReach(). Planes that are turned further leave gaps,
/// where an image has few points for what it shows. As long as the field changes in that direction.
/// Where one of the two is not known, the other.
inline glm::dvec3 turnedTowards(const glm::dvec3& own, const glm::dvec3& smooth)
{
  constexpr double LargestTurn = 0.25; // tangent: 14 degrees
  const double square = glm::dot(own, own), along = glm::dot(own, smooth);
  if (!(square > 0.0) || !std::isfinite(square))
  {
    return smooth;
  }
  const glm::dvec3 aside = smooth - along / square * own; // at right angles to own
  const double turn = glm::dot(aside, aside);
  if (!std::isfinite(turn))
  {
    return own;
  }
  const double most = LargestTurn * along / std::sqrt(square);
  const bool close = along > 0.0 && turn <= most * most;
  const glm::dvec3 direction =
    close ? smooth : own + LargestTurn * std::sqrt(square / turn) * aside;
  return glm::dot(own, direction) / glm::dot(direction, direction) * direction;
}

/// An image of scalars of a type, which are borrowed.
template <class T>
class ImageField : public GriddedField
{
public:
  ImageField(const ImageGrid& grid, const T* values)
    : Grid(grid)
    , Values(values)
  {
  }
  double at(int x, int y, int z) const
  {
    return static_cast<double>(this->Values[this->Grid.index(x, y, z)]);
  }
  /// NaN outside of the image.
  double value(const glm::dvec3& local) const override
  {
    glm::ivec3 c;
    glm::dvec3 t;
    if (!this->Grid.locate(local, c, t))
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const std::size_t row = this->Grid.points.x, slice = row * this->Grid.points.y;
    const T* v = this->Values + this->Grid.index(c.x, c.y, c.z);
    const auto along = [&](std::size_t at)
    { return mix(static_cast<double>(v[at]), static_cast<double>(v[at + 1]), t.x); };
    return mix(mix(along(0), along(row), t.y), mix(along(slice), along(slice + row), t.y), t.z);
  }
  glm::dvec3 gradient(const glm::dvec3& local) const override
  {
    glm::ivec3 c;
    glm::dvec3 t;
    if (!this->Grid.locate(local, c, t))
    {
      return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    }
    const auto along = [&](int y, int z)
    {
      return mix(
        this->difference(c.x, c.y + y, c.z + z), this->difference(c.x + 1, c.y + y, c.z + z), t.x);
    };
    const glm::dvec3 smooth =
      mix(mix(along(0, 0), along(1, 0), t.y), mix(along(0, 1), along(1, 1), t.y), t.z);
    const glm::dmat3 toLocal = glm::transpose(glm::dmat3(this->Grid.toIndex));
    return turnedTowards(toLocal * this->ownGradient(c, t), toLocal * smooth);
  }
  bool crosses(const glm::ivec3& first, const glm::ivec3& last, double value) const override
  {
    constexpr double Infinity = std::numeric_limits<double>::infinity();
    bool below = false, above = false, at = false;
    for (int z = first.z; z <= last.z; ++z)
    {
      for (int y = first.y; y <= last.y; ++y)
      {
        const T* row = this->Values + this->Grid.index(first.x, y, z);
        for (int x = 0; x <= last.x - first.x; ++x)
        {
          const double v = static_cast<double>(row[x]);
          below |= (v < value) & (v > -Infinity);
          above |= (v > value) & (v < Infinity);
          at |= v == value;
        }
      }
      if (below && above)
      {
        return true;
      }
    }
    return at && (below || above);
  }
  bool read(const glm::ivec3& first, const glm::ivec3& last, double lowest, double highest,
    double* to, int row) const override
  {
    bool below = false, above = false;
    for (int z = first.z; z <= last.z; ++z)
    {
      for (int y = first.y; y <= last.y; ++y)
      {
        const T* from = this->Values + this->Grid.index(first.x, y, z);
        double* end = to + row * ((z - first.z) * row + (y - first.y));
        for (int x = 0; x <= last.x - first.x; ++x)
        {
          const double v = static_cast<double>(from[x]);
          below |= v < highest;
          above |= v >= lowest;
          end[x] = v;
        }
      }
    }
    return below && above;
  }

private:
  template <class V>
  static V mix(const V& low, const V& high, double t)
  {
    return (1.0 - t) * low + t * high;
  }
  /// Of the trilinear field in a cell, in indices.
  glm::dvec3 ownGradient(const glm::ivec3& c, const glm::dvec3& t) const
  {
    const std::size_t row = this->Grid.points.x, slice = row * this->Grid.points.y;
    const T* v = this->Values + this->Grid.index(c.x, c.y, c.z);
    const auto of = [&](std::size_t at) { return static_cast<double>(v[at]); };
    const double v00 = mix(of(0), of(1), t.x), v10 = mix(of(row), of(row + 1), t.x);
    const double v01 = mix(of(slice), of(slice + 1), t.x);
    const double v11 = mix(of(slice + row), of(slice + row + 1), t.x);
    const auto step = [&](std::size_t at) { return of(at + 1) - of(at); };
    return { mix(mix(step(0), step(row), t.y), mix(step(slice), step(slice + row), t.y), t.z),
      mix(v10 - v00, v11 - v01, t.z), mix(v01, v11, t.y) - mix(v00, v10, t.y) };
  }
  /// Of neighbours, an index apart; one-sided at the image's ends.
  glm::dvec3 difference(int x, int y, int z) const
  {
    const std::ptrdiff_t row = this->Grid.points.x, slice = row * this->Grid.points.y;
    const T* v = this->Values + this->Grid.index(x, y, z);
    const glm::ivec3 last = this->Grid.points - 1;
    return { difference(v, 1, x, last.x), difference(v, row, y, last.y),
      difference(v, slice, z, last.z) };
  }
  static double difference(const T* v, std::ptrdiff_t step, int at, int last)
  {
    const std::ptrdiff_t before = at > 0 ? -step : 0, after = at < last ? step : 0;
    const double change = static_cast<double>(v[after]) - static_cast<double>(v[before]);
    return at > 0 && at < last ? 0.5 * change : change;
  }

  const ImageGrid Grid;
  const T* Values;
};

/// Least and largest values of blocks of cells; each level has blocks of twice the edge. Values
/// that are not finite do not count.
class VTKSVOOCTREE_EXPORT ValuePyramid
{
public:
  static constexpr int BlockCells = 4; // along an edge of the finest blocks

  template <class T>
  ValuePyramid(const ImageGrid& grid, const ImageField<T>& field, const ParallelFor& parallelFor)
    : Cells(grid.points - 1)
  {
    Level level((this->Cells + (BlockCells - 1)) / BlockCells);
    forEach(parallelFor, static_cast<std::size_t>(level.blocks.z), 1,
      [&](std::size_t z)
      {
        for (int y = 0; y < level.blocks.y; ++y)
        {
          for (int x = 0; x < level.blocks.x; ++x)
          {
            level.at({ x, y, z }) = this->rangeOf(field, BlockCells * glm::ivec3(x, y, z));
          }
        }
      });
    this->Levels.push_back(std::move(level));
    this->addLevels();
  }

  /// Whether some cell that the box touches, continuous indices, has values on both sides of
  /// `value` or equal to it; or one close by.
  bool reaches(const glm::dvec3& low, const glm::dvec3& high, double value) const;

private:
  struct Range
  {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void add(const Range& other)
    {
      low = std::min(low, other.low);
      high = std::max(high, other.high);
    }
  };
  struct Level
  {
    explicit Level(const glm::ivec3& size)
      : blocks(size)
      , ranges(static_cast<std::size_t>(size.x) * size.y * size.z)
    {
    }
    Range& at(const glm::ivec3& b)
    {
      return ranges[(static_cast<std::size_t>(b.z) * blocks.y + b.y) * blocks.x + b.x];
    }
    const Range& at(const glm::ivec3& b) const { return const_cast<Level*>(this)->at(b); }
    glm::ivec3 blocks;
    std::vector<Range> ranges;
  };
  template <class T>
  Range rangeOf(const ImageField<T>& field, const glm::ivec3& first) const
  {
    const glm::ivec3 last = glm::min(first + BlockCells, this->Cells); // points, inclusive
    Range range;
    for (int z = first.z; z <= last.z; ++z)
    {
      for (int y = first.y; y <= last.y; ++y)
      {
        for (int x = first.x; x <= last.x; ++x)
        {
          const double v = field.at(x, y, z);
          if (std::isfinite(v))
          {
            range.add({ v, v });
          }
        }
      }
    }
    return range;
  }
  void addLevels();

  glm::ivec3 Cells;
  std::vector<Level> Levels;
};

/// Where the field takes one of some values, in ascending order. Where the surfaces of two pass
/// through a voxel it has the one that is nearer to its centre. The field is that of the grid, and
/// both are borrowed, as the pyramid is.
class VTKSVOOCTREE_EXPORT ImageSource : public SurfaceSource
{
public:
  ImageSource(const GriddedField& field, const ImageGrid& grid, const ValuePyramid& pyramid,
    const std::vector<double>& values)
    : Field(field)
    , Grid(grid)
    , ToLocal(glm::inverse(grid.toIndex))
    , Pyramid(pyramid)
    , Values(values)
  {
  }
  bool mayPass(const glm::dvec3& centre, double half) const override;
  /// A voxel is part of the cell that its centre is in: hidden cells have none, and of two images
  /// that share a border one has those on it.
  bool planeIn(const glm::dvec3& centre, double half, SourcePlane& plane) const override;
  /// Of voxels no larger than cells from the corners, see svoImageBrick.h.
  std::uint64_t planesIn(const SourceBrick& brick, SourcePlane planes[NodeCells]) const override;
  std::uint32_t planeReach(double half) const override;

private:
  /// Of a cube, in continuous indices, a trifle larger.
  Box boxOf(const glm::dvec3& centre, double half) const;
  bool mayPass(const Box& box, double value) const;
  bool cellsReach(const Box& box, double value) const;
  bool reachesIn(const Box& box, double value) const;

  const GriddedField& Field;
  const ImageGrid& Grid;
  const glm::dmat4 ToLocal;
  const ValuePyramid& Pyramid;
  const std::vector<double> Values;
};
}

#endif
