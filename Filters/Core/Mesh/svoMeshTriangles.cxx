#include "svoMeshTriangles.h"

#include "svoBox.h"
#include "svoCellIds.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// Polygons with more points than this are worth a look. A fan's triangles all reach from the rim
/// to the first point, so an octree notes each of them in all the bricks on its way: the cost of a
/// fan grows with its points times the bricks across. Cut in halves, again and again, most
/// triangles are as short as the polygon's edges.
constexpr std::size_t LargePolygon = 8192;

/// Calls visit(i, k, j), indices into the polygon in its own winding, for each triangle of the part
/// between two of its points.
template <typename Visit>
void halve(std::size_t first, std::size_t last, const Visit& visit)
{
  if (last - first < 2)
  {
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  visit(first, middle, last);
  halve(first, middle, visit);
  halve(middle, last, visit);
}

/// True if all triangles of the fan and of the halves lie in one plane and have one winding. They
/// cover the same points then: those that the polygon's outline goes around. Only what point data
/// look like inside of the polygon depends on the cut.
bool canBeHalved(const glm::dvec3* points, const std::vector<std::uint32_t>& polygon)
{
  constexpr double Tolerance = 1e-6; // of the polygon's size: float coordinates are no better
  const std::size_t count = polygon.size();
  const glm::dvec3 origin = points[polygon[0]];
  const auto at = [&](std::size_t i) { return points[polygon[i]] - origin; };
  glm::dvec3 area(0.0);
  Box box{ glm::dvec3(0.0), glm::dvec3(0.0) };
  for (std::size_t i = 1; i < count; ++i)
  {
    const glm::dvec3 p = at(i);
    area += glm::cross(at(i - 1), p);
    box.add(p);
  }
  const double size = glm::length(box.high - box.low);
  const double length = glm::length(area);
  // Points that are not finite end here, too.
  if (count < 3 || !(length > Tolerance * size * size) || !std::isfinite(length))
  {
    return false;
  }
  const glm::dvec3 normal = area / length;
  const double allowed = Tolerance * size;
  bool good = true;
  const auto look = [&](std::size_t i, std::size_t k, std::size_t j)
  {
    const glm::dvec3 a = at(i), b = at(k), c = at(j);
    const double longest = std::max({ glm::length(b - a), glm::length(c - b), glm::length(a - c) });
    const double height = glm::dot(glm::cross(b - a, c - a), normal);
    good = good && height >= -allowed * longest && std::abs(glm::dot(b, normal)) <= allowed;
  };
  for (std::size_t i = 1; i + 1 < count && good; ++i)
  {
    look(0, i, i + 1);
  }
  if (good)
  {
    halve(0, count - 1, look);
  }
  return good && std::abs(glm::dot(at(count - 1), normal)) <= allowed;
}

struct Appender
{
  const glm::dvec3* points;
  vtkIdType pointCount;
  std::vector<glm::uvec3>& triangles;
  std::vector<std::uint32_t>& cells;
  std::size_t& broken;

  void appendAll(vtkCellArray* array, vtkIdType firstCell, bool strips)
  {
    const vtkIdType count = array->GetNumberOfCells();
    const auto appendCells = [&](const auto* offsets, const auto* ids)
    {
      for (vtkIdType c = 0; c < count; ++c)
      {
        const auto* first = ids + offsets[c];
        const vtkIdType size = static_cast<vtkIdType>(offsets[c + 1] - offsets[c]);
        bool valid = true;
        for (vtkIdType i = 0; i < size; ++i)
        {
          valid = valid && first[i] >= 0 && first[i] < this->pointCount;
        }
        if (!valid)
        {
          ++this->broken;
          continue;
        }
        const auto cell = static_cast<std::uint32_t>(firstCell + c);
        if (!strips && size > static_cast<vtkIdType>(LargePolygon))
        {
          const std::vector<std::uint32_t> polygon(first, first + size);
          if (canBeHalved(this->points, polygon))
          {
            halve(0, polygon.size() - 1,
              [&](std::size_t i, std::size_t k, std::size_t j)
              { this->append(polygon[i], polygon[k], polygon[j], cell); });
            continue;
          }
        }
        for (vtkIdType i = 0; i + 2 < size; ++i)
        {
          if (strips)
          {
            this->append(first[i], first[i + 1 + i % 2], first[i + 2 - i % 2], cell);
          }
          else
          {
            this->append(first[0], first[i + 1], first[i + 2], cell);
          }
        }
      }
    };
    if (count > 0 && !useCellIds(array, appendCells))
    {
      this->broken += static_cast<std::size_t>(count);
    }
  }

  template <typename Id>
  void append(Id a, Id b, Id c, std::uint32_t cell)
  {
    if (a != b && b != c && c != a)
    {
      this->triangles.emplace_back(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
        static_cast<std::uint32_t>(c));
      this->cells.push_back(cell);
    }
  }
};

std::size_t triangleBound(vtkCellArray* cells)
{
  const vtkIdType bound = cells->GetNumberOfConnectivityIds() - 2 * cells->GetNumberOfCells();
  return bound > 0 ? static_cast<std::size_t>(bound) : 0;
}
}

std::size_t triangleBound(vtkPolyData* mesh)
{
  return triangleBound(mesh->GetPolys()) + triangleBound(mesh->GetStrips());
}

MeshTriangles::MeshTriangles(vtkPolyData* mesh)
{
  vtkPoints* points = mesh->GetPoints();
  this->PointCount = points ? static_cast<std::size_t>(points->GetNumberOfPoints()) : 0;
  vtkCellArray* polys = mesh->GetPolys();
  vtkCellArray* strips = mesh->GetStrips();
  const std::size_t triangles = triangleBound(mesh);
  const vtkIdType firstPoly = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
  const vtkIdType firstStrip = firstPoly + polys->GetNumberOfCells();
  constexpr std::size_t limit = std::numeric_limits<std::uint32_t>::max();
  if (this->PointCount > limit || triangles > limit / 2 ||
    static_cast<std::size_t>(firstStrip + strips->GetNumberOfCells()) > limit)
  {
    this->Addressable = false;
    this->PointCount = 0;
    return;
  }

  if (this->PointCount > 0)
  {
    vtkDataArray* data = points->GetData();
    if (auto* doubles = vtkDoubleArray::FastDownCast(data))
    {
      static_assert(sizeof(glm::dvec3) == 3 * sizeof(double), "points are read in place");
      this->Points = reinterpret_cast<const glm::dvec3*>(doubles->GetPointer(0));
    }
    else
    {
      this->Copy.resize(this->PointCount);
      if (auto* floats = vtkFloatArray::FastDownCast(data))
      {
        std::copy_n(floats->GetPointer(0), 3 * this->PointCount, &this->Copy[0].x);
      }
      else
      {
        for (std::size_t i = 0; i < this->PointCount; ++i)
        {
          data->GetTuple(static_cast<vtkIdType>(i), &this->Copy[i].x);
        }
      }
      this->Points = this->Copy.data();
    }
  }

  this->Triangles.reserve(triangles);
  this->Cells.reserve(triangles);
  Appender append{ this->Points, static_cast<vtkIdType>(this->PointCount), this->Triangles,
    this->Cells, this->Broken };
  append.appendAll(polys, firstPoly, false);
  append.appendAll(strips, firstStrip, true);
}

TriangleMesh MeshTriangles::view() const
{
  return { this->Points, this->PointCount, this->Triangles.data(), this->Triangles.size() };
}
}
