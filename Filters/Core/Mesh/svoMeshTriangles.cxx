#include "svoMeshTriangles.h"

#include "svoCellIds.h"
#include "svoLargePolygon.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <limits>

namespace svo
{
namespace
{
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
    if (count > 0 &&
      !useCellIds(array,
        [&](const auto* offsets, const auto* ids)
        { this->appendCells(offsets, ids, count, firstCell, strips); }))
    {
      this->broken += static_cast<std::size_t>(count);
    }
  }

  template <typename Id>
  void appendCells(
    const Id* offsets, const Id* ids, vtkIdType count, vtkIdType firstCell, bool strips)
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
        const float* p = floats->GetPointer(0);
        for (glm::dvec3& q : this->Copy)
        {
          q = { p[0], p[1], p[2] };
          p += 3;
        }
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
  TriangleMesh mesh;
  mesh.points = this->Points;
  mesh.pointCount = this->PointCount;
  mesh.triangles = this->Triangles.data();
  mesh.triangleCount = this->Triangles.size();
  return mesh;
}
}
