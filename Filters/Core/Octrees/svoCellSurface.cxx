#include "svoCellSurface.h"

#include "vtkCellArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace svo
{
namespace
{
/// Corners have up to 2^20 + 1 coordinates on an axis, so 21 bits each.
std::uint64_t cornerKey(const glm::ivec3& corner)
{
  return static_cast<std::uint64_t>(corner.z) << 42 | static_cast<std::uint64_t>(corner.y) << 21 |
    static_cast<std::uint64_t>(corner.x);
}
}

bool isOccupied(const Octree& octree, const OctreeCell& cell, const glm::ivec3& at, int level)
{
  // Most neighbours are in the same block, where its mask is the answer.
  const glm::ivec3 difference = (at ^ cell.cell) >> (NodeLevels - cell.above);
  if (cell.above < NodeLevels && difference == glm::ivec3(0))
  {
    const int first = cellAt(at << cell.above);
    return occupiedBelow(octree.nodes()[cell.node], first, cell.above) != 0;
  }
  return octree.occupied(at, level);
}

void CellQuads::add(const glm::ivec3& cell, int faces)
{
  for (int f = 0; f < CellFaces; ++f)
  {
    for (int i = 0; i < 4 && (faces >> f & 1); ++i)
    {
      this->Corners.push_back(cornerKey(cell + FacesOfCell[f].corners[i]));
    }
  }
}

void CellQuads::write(const Octree& octree, int level, int pointType, vtkPolyData* mesh,
  const std::function<void()>& sorted) const
{
  std::vector<std::uint64_t> points = this->Corners;
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  sorted();

  const Header& header = octree.header();
  const double edge = std::ldexp(header.voxelSize, octree.level() - level);
  const glm::dmat4 transform = octree.transform();
  vtkNew<vtkPoints> outPoints;
  outPoints->SetDataType(pointType);
  outPoints->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::uint64_t key = points[i];
    glm::dvec4 p(header.origin[0] + static_cast<double>(key & 0x1fffff) * edge,
      header.origin[1] + static_cast<double>(key >> 21 & 0x1fffff) * edge,
      header.origin[2] + static_cast<double>(key >> 42) * edge, 1.0);
    p = octree.hasTransform() ? transform * p : p;
    outPoints->SetPoint(static_cast<vtkIdType>(i), p.x, p.y, p.z);
  }
  // A transform that mirrors turns quads inside out.
  const bool mirrored = glm::determinant(glm::dmat3(transform)) < 0.0;

  vtkNew<vtkIdTypeArray> connectivity;
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(this->Corners.size()));
  for (std::size_t i = 0; i < this->Corners.size(); ++i)
  {
    const std::size_t from = mirrored ? i / 4 * 4 + (3 - i % 4) : i;
    const auto found = std::lower_bound(points.begin(), points.end(), this->Corners[from]);
    connectivity->SetValue(static_cast<vtkIdType>(i), found - points.begin());
  }
  vtkNew<vtkCellArray> polys;
  polys->SetData(4, connectivity);
  mesh->SetPoints(outPoints);
  mesh->SetPolys(polys);
}
}
