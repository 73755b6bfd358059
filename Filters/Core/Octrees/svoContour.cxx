#include "svoContour.h"

#include "svoBox.h"
#include "svoCellPlanes.h"
#include "svoContourQuads.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt32Array.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

namespace svo
{
namespace
{
/// Where the vertex of a cell is, in cells from its centre: on its plane, near its centre. In the
/// last cell before the border of a box: where its plane meets that.
class Vertices
{
public:
  Vertices(const Header& header, double edge, const Box& box)
  {
    const glm::dvec3 origin(header.origin[0], header.origin[1], header.origin[2]);
    this->Low = box.known() ? (box.low - origin) / edge : glm::dvec3(-1.0);
    this->High = box.known() ? (box.high - origin) / edge : glm::dvec3(1 << MaximumLevel);
    this->Inner[0] = glm::ivec3(glm::floor(this->Low + 0.5));
    this->Inner[1] = glm::ivec3(glm::ceil(this->High - 1.5));
  }

  glm::vec3 in(const glm::ivec3& cell, const CellPlane& plane) const
  {
    const glm::vec3 foot = plane.offset * plane.normal;
    const glm::vec3 beside = glm::abs(foot);
    const bool inner = glm::all(glm::lessThan(this->Inner[0], cell)) &&
      glm::all(glm::lessThan(cell, this->Inner[1]));
    return inner && std::max({ beside.x, beside.y, beside.z }) <= 0.5f
      ? foot
      : this->clampedIn(cell, plane);
  }

  /// The nearest place in the box.
  glm::vec3 inBox(const glm::ivec3& cell, const glm::vec3& x) const
  {
    const glm::dvec3 centre = glm::dvec3(cell) + 0.5;
    return glm::vec3(glm::clamp(centre + glm::dvec3(x), this->Low, this->High) - centre);
  }

private:
  glm::vec3 clampedIn(const glm::ivec3& cell, const CellPlane& plane) const
  {
    const glm::dvec3 centre = glm::dvec3(cell) + 0.5;
    const glm::vec3 low(glm::max(this->Low - centre, glm::dvec3(-0.5)));
    const glm::vec3 high(glm::min(this->High - centre, glm::dvec3(0.5)));
    glm::vec3 x(0.0f), free = plane.normal;
    bool atBorder = false;
    for (int a = 0; a < 3; ++a)
    {
      const bool first = centre[a] - 1.0 < this->Low[a], last = centre[a] + 1.0 > this->High[a];
      if (first || last)
      {
        atBorder = true;
        free[a] = 0.0f;
        x[a] = static_cast<float>((first ? this->Low : this->High)[a] - centre[a]);
      }
    }
    // A plane along the border does not end there; where it meets the border far beside the cell,
    // the surface need not get there.
    constexpr float Across = 0.5f, Beside = 1.0f;
    if (atBorder && glm::dot(free, free) > Across)
    {
      const glm::vec3 way = this->toPlane(plane, x, free);
      const glm::vec3 aside = glm::abs(way);
      if (std::max({ aside.x, aside.y, aside.z }) <= Beside)
      {
        return this->inBox(cell, x + way);
      }
    }
    x = glm::vec3(0.0f);
    constexpr int Rounds = 3; // towards what is both on the plane and in the cell
    for (int i = 0; i < Rounds; ++i)
    {
      x = glm::clamp(x + this->toPlane(plane, x, plane.normal), low, high);
    }
    return x;
  }

  static glm::vec3 toPlane(const CellPlane& plane, const glm::vec3& from, const glm::vec3& along)
  {
    return (plane.offset - glm::dot(plane.normal, from)) / glm::dot(along, along) * along;
  }

  glm::dvec3 Low, High; // in cells
  glm::ivec3 Inner[2];  // cells between these are not at the border
};

/// Whether a plane leaves more of its cell than a sliver on both sides.
bool dividesCell(const CellPlane& plane)
{
  constexpr float Sliver = 0.25f;
  const glm::vec3 n = glm::abs(plane.normal);
  return 0.5f * (n.x + n.y + n.z) - std::abs(plane.offset) > Sliver;
}

/// The part of a plane above and below one side of its cell, in cells from its centre,
/// counter-clockwise seen from where its normal points.
std::array<glm::vec3, 4> pieceOf(const CellPlane& plane)
{
  const glm::vec3 n = glm::abs(plane.normal);
  const int a = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  const int u = (a + 1) % 3, v = (a + 2) % 3;
  std::array<glm::vec3, 4> corners;
  for (int i = 0; i < 4; ++i)
  {
    const int k = plane.normal[a] < 0.0f ? 3 - i : i;
    glm::vec3& x = corners[static_cast<std::size_t>(i)];
    x[u] = k == 1 || k == 2 ? 0.5f : -0.5f;
    x[v] = k >= 2 ? 0.5f : -0.5f;
    x[a] =
      std::clamp((plane.offset - plane.normal[u] * x[u] - plane.normal[v] * x[v]) / plane.normal[a],
        -1.0f, 1.0f);
  }
  return corners;
}

/// From cells to the local coordinates.
struct ToLocal
{
  glm::dvec3 origin;
  double edge;
  bool transformed;
  glm::dmat4 transform;
  glm::mat3 normals;

  ToLocal(const Octree& octree, int level, bool turned)
    : origin(octree.header().origin[0], octree.header().origin[1], octree.header().origin[2])
    , edge(std::ldexp(octree.header().voxelSize, octree.level() - level))
    , transformed(octree.hasTransform())
    , transform(octree.transform())
    , normals(glm::transpose(glm::inverse(glm::dmat3(transform))) * (turned ? -1.0 : 1.0))
  {
  }
  glm::dvec3 point(const glm::ivec3& cell, const glm::vec3& inCell) const
  {
    const glm::dvec3 x = origin + edge * (glm::dvec3(cell) + 0.5 + glm::dvec3(inCell));
    return transformed ? glm::dvec3(transform * glm::dvec4(x, 1.0)) : x;
  }
  glm::vec3 normal(const glm::vec3& n) const
  {
    const glm::vec3 there = this->normals * n;
    return transformed ? glm::normalize(there) : there;
  }
  /// Whether floats tell points of the cube apart where it lies.
  bool floatsSuffice(int level) const
  {
    constexpr double Steps = 64.0; // in a cell
    const glm::dvec3 ends[2] = { this->point(glm::ivec3(0), glm::vec3(-0.5f)),
      this->point(glm::ivec3((1 << level) - 1), glm::vec3(0.5f)) };
    double largest = 0.0;
    for (const glm::dvec3& end : ends)
    {
      largest = std::max({ largest, std::abs(end.x), std::abs(end.y), std::abs(end.z) });
    }
    const glm::dmat3 axes(transform);
    const double smallest =
      edge * std::min({ glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]) });
    return largest * std::numeric_limits<float>::epsilon() * Steps < smallest &&
      smallest > std::numeric_limits<float>::min() * 1e6f;
  }
};

/// Writes points and normals of the cells of a block.
template <class Real>
void writeVertices(const CellPlanes& cells, std::size_t block, const Vertices& vertices,
  const ToLocal& toLocal, Real* points, float* normals)
{
  std::size_t i = cells.firsts[block];
  for (std::uint64_t mask = cells.masks[block]; mask != 0; mask &= mask - 1, ++i)
  {
    const glm::ivec3 cell = cells.cellAt(block, lowestBit(mask));
    const CellPlane& plane = cells.planes[i];
    const glm::dvec3 x = toLocal.point(cell, vertices.in(cell, plane));
    const glm::vec3 n = toLocal.normal(plane.normal);
    for (int a = 0; a < 3; ++a)
    {
      points[3 * i + a] = static_cast<Real>(x[a]);
      normals[3 * i + a] = n[a];
    }
  }
}

/// Cells that are part of no quad and get a piece of their plane, in their order.
std::vector<std::int32_t> lonelyCells(const CellPlanes& cells, const CellFlags& used)
{
  std::vector<std::int32_t> lonely;
  for (std::size_t i = 0; i < cells.count; ++i)
  {
    if (used[i].load(std::memory_order_relaxed) == 0 && dividesCell(cells.planes[i]))
    {
      lonely.push_back(static_cast<std::int32_t>(i));
    }
  }
  return lonely;
}

/// Points and quads of pieces: a cell's vertex becomes the first corner, the others lie behind all
/// vertices.
template <class Real>
void writePieces(const CellPlanes& cells, const std::vector<std::int32_t>& lonely,
  const Vertices& vertices, const ToLocal& toLocal, Real* points, float* normals,
  std::vector<Quad>& quads)
{
  std::size_t next = cells.count;
  for (const std::int32_t index : lonely)
  {
    const auto after =
      std::upper_bound(cells.firsts.begin(), cells.firsts.end(), static_cast<std::uint32_t>(index));
    const auto block = static_cast<std::size_t>(after - cells.firsts.begin() - 1);
    std::uint64_t mask = cells.masks[block];
    for (std::uint32_t i = cells.firsts[block]; i < static_cast<std::uint32_t>(index); ++i)
    {
      mask &= mask - 1;
    }
    const glm::ivec3 cell = cells.cellAt(block, lowestBit(mask));
    const CellPlane& plane = cells.planes[static_cast<std::size_t>(index)];
    const glm::vec3 n = toLocal.normal(plane.normal);
    const std::array<glm::vec3, 4> corners = pieceOf(plane);
    Quad quad;
    for (std::size_t k = 0; k < 4; ++k)
    {
      const std::size_t at = k == 0 ? static_cast<std::size_t>(index) : next++;
      const glm::dvec3 x = toLocal.point(cell, vertices.inBox(cell, corners[k]));
      for (int a = 0; a < 3; ++a)
      {
        points[3 * at + a] = static_cast<Real>(x[a]);
        normals[3 * at + a] = n[a];
      }
      quad[k] = static_cast<std::int32_t>(at);
    }
    quads.push_back(quad);
  }
}

template <class Real, class Array>
vtkSmartPointer<vtkPoints> pointsOf(CellPlanes& cells, const BuildOptions& built,
  const ToLocal& toLocal, std::vector<std::vector<Quad>>& quads, vtkFloatArray* normals)
{
  const Vertices vertices(cells.octree.header(), toLocal.edge, { built.modelLow, built.modelHigh });
  vtkNew<Array> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(cells.count));
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(static_cast<vtkIdType>(cells.count));
  forEach(built.parallelFor, cells.blocks.size(), 128,
    [&](std::size_t b)
    {
      cells.readPlanes(b);
      writeVertices<Real>(
        cells, b, vertices, toLocal, coordinates->GetPointer(0), normals->GetPointer(0));
    });

  const CellFlags used(new std::atomic<unsigned char>[cells.count]());
  quads = quadsOf(cells, built.parallelFor, used);
  const std::vector<std::int32_t> lonely = lonelyCells(cells, used);
  const vtkIdType all = static_cast<vtkIdType>(cells.count + 3 * lonely.size());
  coordinates->Resize(all);
  coordinates->SetNumberOfTuples(all);
  normals->Resize(all);
  normals->SetNumberOfTuples(all);
  quads.emplace_back();
  writePieces<Real>(cells, lonely, vertices, toLocal, coordinates->GetPointer(0),
    normals->GetPointer(0), quads.back());
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(coordinates);
  return points;
}

vtkSmartPointer<vtkCellArray> cellArrayOf(
  const std::vector<std::vector<Quad>>& quads, bool reversed, const ParallelFor& parallelFor)
{
  std::vector<std::size_t> begins(quads.size() + 1, 0);
  for (std::size_t c = 0; c < quads.size(); ++c)
  {
    begins[c + 1] = begins[c] + quads[c].size();
  }
  vtkNew<vtkTypeInt32Array> connectivity;
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(4 * begins.back()));
  forEach(parallelFor, quads.size(), 1,
    [&](std::size_t c)
    {
      std::int32_t* to = connectivity->GetPointer(0) + 4 * begins[c];
      for (const Quad& quad : quads[c])
      {
        for (std::size_t k = 0; k < 4; ++k)
        {
          *to++ = quad[reversed ? 3 - k : k];
        }
      }
    });
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(4, connectivity);
  return cells;
}
}

void makeContour(
  const Octree& octree, int level, const BuildOptions& built, bool turned, vtkPolyData* mesh)
{
  assert(octree.hasPlanes());
  mesh->Initialize();
  if (octree.empty())
  {
    return;
  }
  CellPlanes cells(octree, level, built.parallelFor);
  const ToLocal toLocal(octree, level, turned);
  std::vector<std::vector<Quad>> quads;
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  mesh->SetPoints(toLocal.floatsSuffice(level)
      ? pointsOf<float, vtkFloatArray>(cells, built, toLocal, quads, normals)
      : pointsOf<double, vtkDoubleArray>(cells, built, toLocal, quads, normals));
  // A transform that mirrors turns quads inside out.
  const bool mirrored = glm::determinant(glm::dmat3(toLocal.transform)) < 0.0;
  mesh->SetPolys(cellArrayOf(quads, mirrored != turned, built.parallelFor));
  mesh->GetPointData()->SetNormals(normals);
}
}
