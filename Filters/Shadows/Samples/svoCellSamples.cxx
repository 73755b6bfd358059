#include "svoCellSamples.h"

#include "svoSampleOrder.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace svo
{
namespace
{
/// Whether a point of the unit square is on a quad's first triangle.
bool onFirst(const glm::dvec2& p)
{
  return p.x >= p.y;
}
}

CellSamples::CellSamples(const TriangleMesh& mesh, const std::vector<std::uint32_t>& cells,
  int samplesPerCell, const glm::dmat4& toWorld)
  : Mesh(mesh)
  , PerCell(static_cast<std::size_t>(samplesPerCell))
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
  this->OnSquares.prepare(this->PerCell);
  for (std::size_t k = 0; k < this->PerCell; ++k)
  {
    this->OnHalf += onFirst(this->OnSquares.at(k, this->PerCell));
  }
  this->Cells.reserve(found.size());
  this->Begins.push_back(0);
  std::vector<Part> parts;
  const std::size_t cellsAPiece = std::max<std::size_t>(1, PieceSamples / this->PerCell);
  for (const std::uint32_t i : mortonOrder(middles))
  {
    if (this->Cells.size() == this->Begins.back() + cellsAPiece)
    {
      this->Begins.push_back(static_cast<std::uint32_t>(this->Cells.size()));
    }
    this->Cells.push_back(found[i]);
    if (!this->partsOf(found[i], parts))
    {
      for (const Part& part : parts)
      {
        this->OnTriangles.prepare(part.count);
      }
    }
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

bool CellSamples::isQuad(std::vector<Part>& parts) const
{
  if (parts.size() != 2 || parts[0].share > 2.0 * parts[1].share ||
    parts[1].share > 2.0 * parts[0].share)
  {
    return false;
  }
  for (std::size_t p = 0; p < 2; ++p)
  {
    const glm::uvec3 own = this->Mesh.triangles[parts[p].triangle];
    const glm::uvec3 other = this->Mesh.triangles[parts[1 - p].triangle];
    int apart = 0;
    for (int i = 0; i < 3; ++i)
    {
      if (own[i] != other.x && own[i] != other.y && own[i] != other.z)
      {
        parts[p].apex = i;
        ++apart;
      }
    }
    if (apart != 1)
    {
      return false;
    }
  }
  return true;
}

bool CellSamples::partsOf(const Cell& cell, std::vector<Part>& parts) const
{
  parts.clear();
  const double whole = this->area(cell);
  for (std::uint32_t t = cell.first; t < cell.end; ++t)
  {
    if (const double share = this->area(t) / whole; share > 0.0)
    {
      parts.push_back({ t, 0, 0, share });
    }
  }
  const bool quad = this->isQuad(parts);
  const auto points = static_cast<double>(this->PerCell);
  double before = 0.0, sampled = 0.0; // areas
  std::size_t given = 0;
  for (Part& part : parts)
  {
    before += part.share;
    const bool last = &part == &parts.back();
    const auto upToHere = last ? this->PerCell
      : quad                   ? this->OnHalf
                               : static_cast<std::size_t>(std::lround(before * points));
    part.count = std::max(upToHere, given) - given;
    given += part.count;
    sampled += part.count == 0 ? 0.0
      : quad                   ? part.share * static_cast<double>(part.count)
                               : part.share;
  }
  for (Part& part : parts)
  {
    part.share /= quad ? sampled : sampled * static_cast<double>(part.count);
  }
  return quad;
}

void CellSamples::piece(
  std::size_t index, std::vector<std::uint32_t>& places, std::vector<Sample>& samples) const
{
  places.clear();
  samples.clear();
  std::vector<Part> parts;
  for (std::uint32_t i = this->Begins[index]; i < this->Begins[index + 1]; ++i)
  {
    const auto place = static_cast<std::uint32_t>(places.size());
    places.push_back(this->Cells[i].id);
    const bool quad = this->partsOf(this->Cells[i], parts);
    for (std::size_t p = 0; p < parts.size(); ++p)
    {
      const Part& part = parts[p];
      const glm::dvec3 a = this->corner(part.triangle, part.apex);
      const glm::dvec3 toB = this->corner(part.triangle, (part.apex + 1) % 3) - a;
      const glm::dvec3 toC = this->corner(part.triangle, (part.apex + 2) % 3) - a;
      const glm::dvec3 normal = this->Outside * glm::normalize(glm::cross(toB, toC));
      const auto add = [&](double b, double c) {
        samples.push_back({ a + b * toB + c * toC, normal, part.triangle, place, part.share });
      };
      for (std::size_t k = 0; !quad && k < part.count; ++k)
      {
        const glm::dvec2 at = this->OnTriangles.at(k, part.count);
        add(at.x, at.y);
      }
      for (std::size_t k = 0; quad && k < this->PerCell; ++k)
      {
        // The apices are (1, 0) and (0, 1); edges go round in the same sense in both triangles.
        const glm::dvec2 at = this->OnSquares.at(k, this->PerCell);
        if (onFirst(at) == (p == 0))
        {
          p == 0 ? add(at.y, 1.0 - at.x) : add(1.0 - at.y, at.x);
        }
      }
    }
  }
}
}
