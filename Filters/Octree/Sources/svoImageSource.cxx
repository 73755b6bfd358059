#include "svoImageSource.h"

#include "svoImageBrick.h"
#include "svoMorton.h"
#include "svoNode.h"

#include <glm/vector_relational.hpp>

namespace svo
{
void ValuePyramid::addLevels()
{
  while (this->Levels.back().blocks != glm::ivec3(1))
  {
    const Level& fine = this->Levels.back();
    Level coarse((fine.blocks + 1) / 2);
    for (int z = 0; z < fine.blocks.z; ++z)
    {
      for (int y = 0; y < fine.blocks.y; ++y)
      {
        for (int x = 0; x < fine.blocks.x; ++x)
        {
          coarse.at(glm::ivec3(x, y, z) / 2).add(fine.at({ x, y, z }));
        }
      }
    }
    this->Levels.push_back(std::move(coarse));
  }
}

bool ValuePyramid::reaches(const glm::dvec3& low, const glm::dvec3& high, double value) const
{
  const glm::dvec3 last(this->Cells);
  if (!glm::all(glm::lessThanEqual(low, last)) ||
    !glm::all(glm::greaterThanEqual(high, glm::dvec3(0.0))))
  {
    return false;
  }
  const glm::ivec3 first(glm::clamp(glm::floor(low), glm::dvec3(0.0), last - 1.0));
  const glm::ivec3 end(glm::clamp(glm::floor(high), glm::dvec3(0.0), last - 1.0));
  // At most two blocks along each axis.
  std::size_t level = 0;
  glm::ivec3 a = first / BlockCells, b = end / BlockCells;
  while (level + 1 < this->Levels.size() && glm::any(glm::greaterThan(b - a, glm::ivec3(1))))
  {
    a /= 2;
    b /= 2;
    ++level;
  }
  Range range;
  for (int z = a.z; z <= b.z; ++z)
  {
    for (int y = a.y; y <= b.y; ++y)
    {
      for (int x = a.x; x <= b.x; ++x)
      {
        range.add(this->Levels[level].at({ x, y, z }));
      }
    }
  }
  // Where all are the same there is no surface, whatever the value.
  return range.low <= value && value <= range.high && range.low < range.high;
}

Box ImageSource::boxOf(const glm::dvec3& centre, double half) const
{
  const glm::dmat3 linear(this->Grid.toIndex);
  const glm::dvec3 middle(this->Grid.toIndex * glm::dvec4(centre, 1.0));
  const glm::dvec3 reach =
    half * (glm::abs(linear[0]) + glm::abs(linear[1]) + glm::abs(linear[2])) + 1e-6;
  return { middle - reach, middle + reach };
}

/// False if no surface passes through the cells that the box touches, where these are few.
bool ImageSource::cellsReach(const Box& box, double value) const
{
  constexpr int Few = 4; // points along an axis; the pyramid judges larger boxes
  const glm::dvec3 last(this->Grid.points - 1);
  const glm::ivec3 from(glm::clamp(glm::floor(box.low), glm::dvec3(0.0), last));
  const glm::ivec3 to(glm::clamp(glm::ceil(box.high), glm::dvec3(0.0), last));
  return glm::any(glm::greaterThanEqual(to - from, glm::ivec3(Few))) ||
    this->Field.crosses(from, to, value);
}

bool ImageSource::mayPass(const glm::dvec3& centre, double half) const
{
  const Box box = this->boxOf(centre, half);
  return std::any_of(this->Values.begin(), this->Values.end(),
    [&](double value) { return this->mayPass(box, value); });
}

bool ImageSource::mayPass(const Box& box, double value) const
{
  if (!this->Pyramid.reaches(box.low, box.high, value) || !this->cellsReach(box, value))
  {
    return false;
  }
  const bool small = glm::all(glm::lessThanEqual(box.high - box.low, glm::dvec3(1.0)));
  return !small || this->reachesIn(box, value);
}

/// A tangent plane may pass where the surface does not: cells that the voxel touches tell.
bool ImageSource::planeIn(const glm::dvec3& centre, double half, SourcePlane& plane) const
{
  glm::ivec3 cell;
  glm::dvec3 in;
  if (!this->Grid.locate(centre, cell, in) || this->Grid.isHidden(cell))
  {
    return false;
  }
  const Box box = this->boxOf(centre, half);
  bool found = false;
  for (const double value : this->Values)
  {
    const FieldSource surface(this->Field, { value, 0.0, 0.0, false });
    SourcePlane its;
    if (this->cellsReach(box, value) && surface.planeIn(centre, half, its) &&
      (!found || std::abs(its.offset) < std::abs(plane.offset)))
    {
      plane = its;
      found = true;
    }
  }
  return found;
}

std::uint32_t ImageSource::planeReach(double half) const
{
  return ImageBrick::ready(this->Grid, half) ? 2 : LongestReach;
}

std::uint64_t ImageSource::planesIn(const SourceBrick& brick, SourcePlane planes[NodeCells]) const
{
  if (!ImageBrick::ready(this->Grid, brick.half))
  {
    return this->SurfaceSource::planesIn(brick, planes);
  }
  const double edge = 2.0 * brick.half;
  ImageBrick read(this->Grid, brick);
  if (this->Values.empty() || !read.read(this->Field, this->Values.front(), this->Values.back()))
  {
    return 0;
  }
  std::uint64_t mask = 0;
  for (const double value : this->Values)
  {
    for (std::uint64_t left = read.passedBy(value) & brick.asked; left != 0; left &= left - 1)
    {
      const int i = lowestBit(left);
      const glm::dvec3 centre = glm::dvec3(cellOfIndex(i)) + 0.5; // in voxels
      glm::ivec3 cell;
      glm::dvec3 in, middle, rise;
      if (!this->Grid.locate(brick.low + edge * centre, cell, in) || this->Grid.isHidden(cell))
      {
        continue;
      }
      read.crossings(value, i, middle, rise);
      const glm::dvec3 gradient = this->Field.gradient(brick.low + edge * middle);
      const double square = glm::dot(gradient, gradient);
      const bool usable = square > 0.0 && std::isfinite(square);
      SourcePlane plane;
      plane.normal = usable ? gradient / std::sqrt(square) : glm::normalize(rise);
      plane.offset = edge * glm::dot(plane.normal, middle - centre);
      const bool nearer = std::abs(plane.offset) < std::abs(planes[i].offset);
      if ((mask & cellBit(i)) == 0 || nearer)
      {
        planes[i] = plane;
      }
      mask |= cellBit(i);
    }
  }
  return mask;
}

/// A field that is trilinear has its extremes in a part of a cell at the part's corners.
bool ImageSource::reachesIn(const Box& box, double surface) const
{
  const glm::dvec3 last(this->Grid.points - 1);
  const glm::dvec3 from = glm::clamp(box.low, glm::dvec3(0.0), last);
  const glm::dvec3 to = glm::clamp(box.high, glm::dvec3(0.0), last);
  const glm::dvec3 border = glm::clamp(glm::floor(to), from, to); // between at most two cells
  glm::dvec3 at[3] = { from, to, border };
  glm::ivec3 count(2);
  for (int a = 0; a < 3; ++a)
  {
    count[a] += border[a] > from[a] && border[a] < to[a];
  }
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (int i = 0; i < count.x * count.y * count.z; ++i)
  {
    const glm::ivec3 which(i % count.x, i / count.x % count.y, i / (count.x * count.y));
    const glm::dvec4 corner(at[which.x].x, at[which.y].y, at[which.z].z, 1.0);
    const double value = this->Field.value(glm::dvec3(this->ToLocal * corner));
    if (std::isfinite(value))
    {
      least = std::min(least, value);
      most = std::max(most, value);
    }
    if (least <= surface && surface <= most && least < most)
    {
      return true;
    }
  }
  return false;
}
}
