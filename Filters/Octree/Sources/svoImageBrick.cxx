#include "svoImageBrick.h"

#include "svoImageSource.h"
#include "svoMorton.h"
#include "svoNode.h"
#include "svoSource.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace svo
{
namespace
{
constexpr double IndexRounding = 1e-6; // of indices

/// Of the step from one voxel to the next, in indices along an axis.
double stepOf(const ImageGrid& grid, double half, int axis)
{
  return 2.0 * half * grid.toIndex[axis][axis];
}
}

bool ImageBrick::ready(const ImageGrid& grid, double half)
{
  bool small = true;
  for (int a = 0; a < 3; ++a)
  {
    small = small && std::abs(stepOf(grid, half, a)) <= 1.0 + 0.1 * IndexRounding;
  }
  return small;
}

/// `begin`: the brick's corner, in indices; `last` point of the image. What is beyond the image is
/// moved to its border.
ImageBrick::Axis ImageBrick::axisOf(double begin, double step, int last)
{
  Axis axis;
  const auto add = [&](double index, double at)
  {
    const double whole = std::round(index);
    const double there = std::abs(index - whole) < IndexRounding ? whole : index;
    const double inside = std::clamp(there, 0.0, static_cast<double>(last));
    const int point = std::min(static_cast<int>(inside), last - 1);
    assert(axis.count < Positions);
    axis.at[axis.count] = at;
    axis.point[axis.count] = point;
    axis.in[axis.count++] = inside - point;
  };
  for (int k = 0; k <= NodeEdge; ++k)
  {
    const double here = begin + k * step, next = here + step;
    axis.border[k] = axis.count;
    add(here, k);
    const double between =
      step > 0.0 ? std::floor(here + IndexRounding) + 1.0 : std::ceil(here - IndexRounding) - 1.0;
    if (k < NodeEdge && (next - between) / step > IndexRounding && between > 0.0 && between < last)
    {
      add(between, k + (between - here) / step);
    }
  }
  axis.first = *std::min_element(axis.point, axis.point + axis.count);
  axis.last = *std::max_element(axis.point, axis.point + axis.count) + 1;
  assert(axis.last - axis.first < Points);
  for (int i = 0; i < axis.count; ++i)
  {
    axis.point[i] -= axis.first;
  }
  return axis;
}

ImageBrick::ImageBrick(const ImageGrid& grid, const SourceBrick& brick)
{
  for (int a = 0; a < 3; ++a)
  {
    this->Axes[a] = axisOf(grid.toIndex[a][a] * brick.low[a] + grid.toIndex[3][a],
      stepOf(grid, brick.half, a), grid.points[a] - 1);
  }
}

bool ImageBrick::read(const GriddedField& field, double lowest, double highest)
{
  const Axis &X = this->Axes[0], &Y = this->Axes[1], &Z = this->Axes[2];
  double points[Points][Points][Points];
  if (!field.read({ X.first, Y.first, Z.first }, { X.last, Y.last, Z.last }, lowest, highest,
        &points[0][0][0], Points))
  {
    return false;
  }
  const auto mix = [](double low, double high, double t)
  { return t > 0.0 ? (1.0 - t) * low + t * high : low; };
  double rows[Points][Points][Positions], slices[Points][Positions][Positions];
  const int nz = Z.last - Z.first + 1, ny = Y.last - Y.first + 1;
  for (int z = 0; z < nz; ++z)
  {
    for (int y = 0; y < ny; ++y)
    {
      for (int x = 0; x < X.count; ++x)
      {
        const double* p = points[z][y] + X.point[x];
        rows[z][y][x] = mix(p[0], p[1], X.in[x]);
      }
    }
    for (int y = 0; y < Y.count; ++y)
    {
      const int p = Y.point[y];
      for (int x = 0; x < X.count; ++x)
      {
        slices[z][y][x] = mix(rows[z][p][x], rows[z][p + 1][x], Y.in[y]);
      }
    }
  }
  for (int z = 0; z < Z.count; ++z)
  {
    const int p = Z.point[z];
    for (int y = 0; y < Y.count; ++y)
    {
      for (int x = 0; x < X.count; ++x)
      {
        this->Values[z][y][x] = mix(slices[p][y][x], slices[p + 1][y][x], Z.in[z]);
      }
    }
  }
  return true;
}

std::uint64_t ImageBrick::passedBy(double surface) const
{
  const Axis &X = this->Axes[0], &Y = this->Axes[1], &Z = this->Axes[2];
  std::uint16_t aboves[Positions][Positions], unknown[Positions][Positions]; // bits along x
  for (int z = 0; z < Z.count; ++z)
  {
    for (int y = 0; y < Y.count; ++y)
    {
      unsigned above = 0, bad = 0;
      for (int x = 0; x < X.count; ++x)
      {
        const double v = this->Values[z][y][x];
        above |= static_cast<unsigned>(v >= surface) << x;
        bad |= static_cast<unsigned>(!std::isfinite(v)) << x;
      }
      aboves[z][y] = static_cast<std::uint16_t>(above);
      unknown[z][y] = static_cast<std::uint16_t>(bad);
    }
  }
  std::uint64_t mask = 0;
  for (int i = 0; i < NodeCells; ++i)
  {
    const glm::ivec3 c = cellOfIndex(i);
    const unsigned all = (2u << X.border[c.x + 1]) - (1u << X.border[c.x]);
    unsigned any = 0, every = all, bad = 0;
    for (int z = Z.border[c.z]; z <= Z.border[c.z + 1]; ++z)
    {
      for (int y = Y.border[c.y]; y <= Y.border[c.y + 1]; ++y)
      {
        any |= aboves[z][y];
        every &= aboves[z][y];
        bad |= unknown[z][y];
      }
    }
    mask |= (any & all) != 0 && every != all && (bad & all) == 0 ? cellBit(i) : 0;
  }
  return mask;
}

void ImageBrick::crossings(double surface, int voxel, glm::dvec3& middle, glm::dvec3& rise) const
{
  const glm::ivec3 c = cellOfIndex(voxel);
  glm::ivec3 low, high; // positions
  for (int a = 0; a < 3; ++a)
  {
    low[a] = this->Axes[a].border[c[a]];
    high[a] = this->Axes[a].border[c[a] + 1];
  }
  glm::dvec3 sum(0.0), above(0.0), below(0.0);
  int count = 0;
  double aboves = 0.0, belows = 0.0;
  for (int z = low.z; z <= high.z; ++z)
  {
    for (int y = low.y; y <= high.y; ++y)
    {
      for (int x = low.x; x <= high.x; ++x)
      {
        const double v = this->Values[z][y][x];
        const glm::ivec3 p(x, y, z);
        const glm::dvec3 here(this->Axes[0].at[x], this->Axes[1].at[y], this->Axes[2].at[z]);
        const bool isAbove = v >= surface;
        (isAbove ? above : below) += here;
        (isAbove ? aboves : belows) += 1.0;
        for (int a = 0; a < 3; ++a)
        {
          if (p[a] == high[a])
          {
            continue;
          }
          const double w = a == 0 ? this->Values[z][y][x + 1]
            : a == 1              ? this->Values[z][y + 1][x]
                                  : this->Values[z + 1][y][x];
          if (isAbove != (w >= surface))
          {
            glm::dvec3 at = here;
            at[a] += (surface - v) / (w - v) * (this->Axes[a].at[p[a] + 1] - here[a]);
            sum += at;
            ++count;
          }
        }
      }
    }
  }
  assert(count > 0 && aboves > 0.0 && belows > 0.0);
  middle = sum / static_cast<double>(count);
  rise = above / aboves - below / belows;
  if (rise == glm::dvec3(0.0))
  {
    rise.z = 1.0; // above and below in turns all around: there is no side
  }
}
}
