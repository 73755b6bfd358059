#include "svoSeenFaces.h"

#include "svoMeshOctree.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace svo
{
namespace
{
/// Which polygons of a mesh OpenGL takes for front faces.
std::vector<bool> frontFaces(vtkPolyData* mesh, const glm::dmat4& localToWorld, const View& eye)
{
  const glm::dmat4 toLocal = glm::inverse(localToWorld);
  const glm::dvec3 viewer = eye.parallel ? glm::dvec3(toLocal * glm::dvec4(-eye.axis, 0.0))
                                         : glm::dvec3(toLocal * glm::dvec4(eye.eye, 1.0));
  const double side =
    (glm::determinant(glm::dmat3(localToWorld)) < 0.0) != eye.mirrored ? -1.0 : 1.0;
  const vtkIdType points = mesh->GetNumberOfPoints();
  const auto at = [mesh](vtkIdType point)
  {
    glm::dvec3 p;
    mesh->GetPoint(point, &p.x);
    return p;
  };
  vtkCellArray* polys = mesh->GetPolys();
  std::vector<bool> front(static_cast<std::size_t>(polys->GetNumberOfCells()), false);
  vtkNew<vtkIdList> ids;
  for (std::size_t i = 0; i < front.size(); ++i)
  {
    polys->GetCellAtId(static_cast<vtkIdType>(i), ids);
    const vtkIdType* id = ids->GetPointer(0);
    const vtkIdType count = ids->GetNumberOfIds();
    if (count < 3 || std::any_of(id, id + count, [&](vtkIdType p) { return p < 0 || p >= points; }))
    {
      continue;
    }
    const glm::dvec3 first = at(id[0]);
    glm::dvec3 normal(0.0);
    for (vtkIdType k = 1; k + 1 < count; ++k)
    {
      normal += glm::cross(at(id[k]) - first, at(id[k + 1]) - first);
    }
    front[i] = side * glm::dot(normal, eye.parallel ? viewer : viewer - first) > 0.0;
  }
  return front;
}
}

vtkPolyData* seenFacesOf(vtkPolyData* mesh, vtkActor* actor, const glm::dmat4& localToWorld,
  const View& eye, SeenFaces& faces, KeepAlive& kept)
{
  if (carriesPlanes(mesh))
  {
    return mesh;
  }
  FacesLeft& entry = faces.of(
    { mesh, actor }, mesh->GetMTime(), kept, [](FacesLeft& changed) { changed.made = nullptr; });
  std::vector<bool> culled = frontFaces(mesh, localToWorld, eye);
  if (std::find(culled.begin(), culled.end(), true) == culled.end())
  {
    return mesh;
  }
  const bool strips = mesh->GetNumberOfStrips() > 0;
  if (!strips && std::find(culled.begin(), culled.end(), false) == culled.end())
  {
    return nullptr;
  }
  if (entry.made && entry.culled == culled)
  {
    return entry.made;
  }
  vtkNew<vtkCellArray> polys;
  vtkNew<vtkIdList> ids;
  for (std::size_t i = 0; i < culled.size(); ++i)
  {
    mesh->GetPolys()->GetCellAtId(static_cast<vtkIdType>(i), ids);
    culled[i] ? polys->InsertNextCell({ 0, 0, 0 }) : polys->InsertNextCell(ids);
  }
  entry.made = vtkSmartPointer<vtkPolyData>::New();
  entry.made->SetPoints(mesh->GetPoints());
  entry.made->SetVerts(mesh->GetVerts());
  entry.made->SetLines(mesh->GetLines());
  entry.made->SetPolys(polys);
  entry.made->SetStrips(mesh->GetStrips());
  entry.culled = std::move(culled);
  return entry.made;
}
}
