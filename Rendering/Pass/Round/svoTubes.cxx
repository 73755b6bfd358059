#include "svoTubes.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include <glm/gtc/type_ptr.hpp>

namespace svo
{
namespace
{
/// Calls visit(cell, count, points) for the cells of an array, the first of which is `cell`;
/// returns the next one's number.
template <class Visit>
vtkIdType eachCell(vtkCellArray* cells, vtkIdType cell, const Visit& visit)
{
  auto iterator = vtkSmartPointer<vtkCellArrayIterator>::Take(cells->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType count;
    const vtkIdType* points;
    iterator->GetCurrentCell(count, points);
    visit(cell++, count, points);
  }
  return cell;
}

/// Collects shapes of a mesh.
class Gathering
{
public:
  Gathering(vtkPolyData* mesh, const CellAlpha& alpha)
    : Mesh(mesh)
    , Alpha(alpha)
    , Rods(std::make_shared<RoundShapes>())
    , Balls(std::make_shared<RoundShapes>())
    , Taken(static_cast<std::size_t>(mesh->GetNumberOfPoints()), false)
  {
  }

  void addRod(vtkIdType cell, vtkIdType from, vtkIdType to)
  {
    const glm::dvec3 a = this->at(from), b = this->at(to);
    if (a == b || !isFinite(a) || !isFinite(b))
    {
      return;
    }
    const vtkIdType points[] = { from, to };
    if (!this->Alpha.of(cell, points, 2).opaque)
    {
      this->Translucent = true;
      return;
    }
    this->Rods->ends.push_back(a);
    this->Rods->ends.push_back(b);
  }

  void addEdge(vtkIdType cell, vtkIdType from, vtkIdType to)
  {
    this->Edges.push_back({ std::min(from, to), std::max(from, to), cell });
  }

  void addBall(vtkIdType cell, vtkIdType point)
  {
    if (this->Taken[static_cast<std::size_t>(point)] || !isFinite(this->at(point)))
    {
      return;
    }
    if (!this->Alpha.of(cell, &point, 1).opaque)
    {
      this->Translucent = true;
      return;
    }
    this->Taken[static_cast<std::size_t>(point)] = true;
    this->Balls->ends.push_back(this->at(point));
  }

  Tubes finish(vtkProperty* property)
  {
    const auto first = [](const Edge& a, const Edge& b)
    { return std::tie(a.from, a.to, a.cell) < std::tie(b.from, b.to, b.cell); };
    std::sort(this->Edges.begin(), this->Edges.end(), first);
    const auto same = [](const Edge& a, const Edge& b) { return a.from == b.from && a.to == b.to; };
    this->Edges.erase(std::unique(this->Edges.begin(), this->Edges.end(), same), this->Edges.end());
    for (const Edge& edge : this->Edges)
    {
      this->addRod(edge.cell, edge.from, edge.to);
    }
    Tubes result;
    result.rods = whole(this->Rods, RoundShapes::Shape::Rod, property->GetLineWidth());
    result.balls = whole(this->Balls, RoundShapes::Shape::Ball, property->GetPointSize());
    result.translucent = this->Translucent;
    return result;
  }

private:
  struct Edge
  {
    vtkIdType from, to, cell;
  };
  static bool isFinite(const glm::dvec3& p) { return std::isfinite(p.x + p.y + p.z); }
  static std::shared_ptr<RoundShapes> whole(
    const std::shared_ptr<RoundShapes>& shapes, RoundShapes::Shape shape, double pixels)
  {
    shapes->shape = shape;
    shapes->width = RoundShapes::Width::Pixels;
    shapes->radius = 0.5 * pixels;
    return shapes->ends.empty() ? nullptr : shapes;
  }
  glm::dvec3 at(vtkIdType point) const { return glm::make_vec3(this->Mesh->GetPoint(point)); }

  vtkPolyData* Mesh;
  const CellAlpha& Alpha;
  std::shared_ptr<RoundShapes> Rods, Balls;
  std::vector<bool> Taken; // points that have a ball
  std::vector<Edge> Edges;
  bool Translucent = false;
};
}

RoundLook roundLookOf(vtkProperty* property)
{
  RoundLook look;
  // Thinner ones are drawn as ordinary lines.
  const bool tubes = property->GetRenderLinesAsTubes() && property->GetLineWidth() > 1.0;
  const bool spheres = property->GetRenderPointsAsSpheres() && property->GetPointSize() > 0.0;
  const int representation = property->GetRepresentation();
  look.lines = tubes && representation != VTK_POINTS;
  look.edges = tubes && representation == VTK_WIREFRAME;
  look.points = spheres && (representation == VTK_POINTS || property->GetVertexVisibility());
  look.vertices = spheres;
  return look;
}

Tubes tubesOf(vtkPolyData* mesh, vtkProperty* property, const CellAlpha& alpha)
{
  const RoundLook look = roundLookOf(property);
  Gathering gathering(mesh, alpha);
  const auto balls = [&](vtkIdType cell, vtkIdType count, const vtkIdType* points)
  {
    for (vtkIdType i = 0; i < count; ++i)
    {
      gathering.addBall(cell, points[i]);
    }
  };
  vtkIdType cell = eachCell(mesh->GetVerts(), 0,
    [&](vtkIdType id, vtkIdType count, const vtkIdType* points)
    { balls(id, look.vertices ? count : 0, points); });
  cell = eachCell(mesh->GetLines(), cell,
    [&](vtkIdType id, vtkIdType count, const vtkIdType* points)
    {
      for (vtkIdType i = 0; look.lines && i + 1 < count; ++i)
      {
        gathering.addRod(id, points[i], points[i + 1]);
      }
      balls(id, look.points ? count : 0, points);
    });
  if (!look.edges && !look.points)
  {
    return gathering.finish(property);
  }
  cell = eachCell(mesh->GetPolys(), cell,
    [&](vtkIdType id, vtkIdType count, const vtkIdType* points)
    {
      for (vtkIdType i = 0; look.edges && i < count; ++i)
      {
        gathering.addEdge(id, points[i], points[(i + 1) % count]);
      }
      balls(id, look.points ? count : 0, points);
    });
  eachCell(mesh->GetStrips(), cell,
    [&](vtkIdType id, vtkIdType count, const vtkIdType* points)
    {
      for (vtkIdType i = 0; look.edges && i + 1 < count; ++i)
      {
        gathering.addEdge(id, points[i], points[i + 1]);
        if (i + 2 < count)
        {
          gathering.addEdge(id, points[i], points[i + 2]);
        }
      }
      balls(id, look.points ? count : 0, points);
    });
  return gathering.finish(property);
}
}
