#include "svoCellSamples.h"

#include "svoSampleOrder.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace svo
{
glm::dvec3 trianglePoint(std::size_t index, std::size_t count)
{
  constexpr double Golden = 0.61803398874989485;
  if (count == 1)
  {
    return glm::dvec3(1.0 / 3.0);
  }
  const double along = (static_cast<double>(index) + 0.5) / static_cast<double>(count);
  const double turns = (static_cast<double>(index) + 0.5) * Golden;
  const double across = turns - std::floor(turns);
  const double root = std::sqrt(along);
  return { 1.0 - root, root * (1.0 - across), root * across };
}

CellSamples::CellSamples(const TriangleMesh& mesh, const std::vector<std::uint32_t>& cells,
  int samplesPerCell, const glm::dmat4& toWorld)
  : Mesh(mesh)
  , PerCell(samplesPerCell)
  , ToWorld(toWorld)
  , Outside(glm::determinant(glm::dmat3(toWorld)) < 0.0 ? -1.0 : 1.0)
{
  std::vector<Cell> found;
  std::vector<glm::dvec3> middles;
  const auto count = static_cast<std::uint32_t>(mesh.triangleCount);
  for (std::uint32_t first = 0, end = 0; first < count; first = end)
  {
    while (end < count && cells[end] == cells[first])
    {
      ++end;
    }
    const Cell cell{ cells[first], first, end };
    const double whole = this->area(cell);
    std::uint32_t with = first;
    while (with < end && !(this->area(with) > 0.0))
    {
      ++with;
    }
    if (with < end && std::isfinite(whole))
    {
      found.push_back(cell);
      middles.push_back(
        (this->corner(with, 0) + this->corner(with, 1) + this->corner(with, 2)) / 3.0);
    }
  }
  this->Cells.reserve(found.size());
  this->Begins.push_back(0);
  std::size_t samples = 0;
  for (const std::uint32_t i : mortonOrder(middles))
  {
    // Cells of several triangles may have more; pieces need not be equal.
    const auto own = std::max<std::size_t>(this->PerCell, found[i].end - found[i].first);
    if (samples > 0 && samples + own > PieceSamples)
    {
      this->Begins.push_back(static_cast<std::uint32_t>(this->Cells.size()));
      samples = 0;
    }
    samples += own;
    this->Cells.push_back(found[i]);
  }
  if (!this->Cells.empty())
  {
    this->Begins.push_back(static_cast<std::uint32_t>(this->Cells.size()));
  }
}

glm::dvec3 CellSamples::corner(std::uint32_t triangle, int i) const
{
  const glm::dvec3& p = this->Mesh.points[this->Mesh.triangles[triangle][i]];
  return glm::dvec3(this->ToWorld * glm::dvec4(p, 1.0));
}

double CellSamples::area(std::uint32_t triangle) const
{
  const glm::dvec3 a = this->corner(triangle, 0);
  const double area =
    0.5 * glm::length(glm::cross(this->corner(triangle, 1) - a, this->corner(triangle, 2) - a));
  return std::isfinite(area) ? area : 0.0;
}

double CellSamples::area(const Cell& cell) const
{
  double sum = 0.0;
  for (std::uint32_t t = cell.first; t < cell.end; ++t)
  {
    sum += this->area(t);
  }
  return sum;
}

std::size_t CellSamples::samplesOf(double part) const
{
  return part > 0.0 ? std::max<std::size_t>(1, std::lround(part * this->PerCell)) : 0;
}

void CellSamples::piece(
  std::size_t index, std::vector<std::uint32_t>& places, std::vector<Sample>& samples) const
{
  places.clear();
  samples.clear();
  for (std::uint32_t i = this->Begins[index]; i < this->Begins[index + 1]; ++i)
  {
    const Cell& cell = this->Cells[i];
    const double whole = this->area(cell);
    const auto place = static_cast<std::uint32_t>(places.size());
    places.push_back(cell.id);
    for (std::uint32_t t = cell.first; t < cell.end; ++t)
    {
      const double part = this->area(t) / whole;
      const glm::dvec3 a = this->corner(t, 0), b = this->corner(t, 1), c = this->corner(t, 2);
      const std::size_t count = this->samplesOf(part);
      const glm::dvec3 normal =
        count > 0 ? this->Outside * glm::normalize(glm::cross(b - a, c - a)) : glm::dvec3(0.0);
      for (std::size_t k = 0; k < count; ++k)
      {
        const glm::dvec3 w = trianglePoint(k, count);
        samples.push_back({ a + w.y * (b - a) + w.z * (c - a), normal, t, place,
          part / static_cast<double>(count) });
      }
    }
  }
}
}
