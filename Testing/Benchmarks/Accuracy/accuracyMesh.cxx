#include "accuracyMesh.h"

#include "svoMeshTriangles.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>

#include <array>
#include <limits>
#include <map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace accuracy
{
namespace
{
constexpr double Turn = 6.28318530717958647692;
}

void normalise(Mesh& mesh, int up)
{
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  for (glm::dvec3& p : mesh.points)
  {
    p = up == 2 ? p : up == 1 ? glm::dvec3(p.x, -p.z, p.y) : glm::dvec3(p.y, p.z, p.x);
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 size = high - low;
  const double longest = std::max({ size.x, size.y, size.z });
  const glm::dvec3 foot(0.5 * (low.x + high.x), 0.5 * (low.y + high.y), low.z);
  for (glm::dvec3& p : mesh.points)
  {
    p = glm::dvec3(glm::vec3((p - foot) / longest));
  }
}

bool isClosed(const Mesh& mesh)
{
  std::map<std::array<double, 3>, unsigned> ids;
  std::vector<unsigned> welded;
  for (const glm::dvec3& p : mesh.points)
  {
    welded.push_back(
      ids.try_emplace({ p.x, p.y, p.z }, static_cast<unsigned>(ids.size())).first->second);
  }
  std::map<std::pair<unsigned, unsigned>, unsigned> edges;
  for (const glm::uvec3& t : mesh.triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      ++edges[std::minmax(welded[t[i]], welded[t[(i + 1) % 3]])];
    }
  }
  for (const auto& edge : edges)
  {
    if (edge.second % 2 != 0)
    {
      return false;
    }
  }
  return true;
}

Mesh knot()
{
  // A tube around a trefoil, thicker and thinner along the way.
  constexpr unsigned Rows = 320, Columns = 48;
  const auto centre = [](double u)
  {
    return glm::dvec3(std::sin(u) + 2.0 * std::sin(2.0 * u), std::cos(u) - 2.0 * std::cos(2.0 * u),
      -std::sin(3.0 * u));
  };
  Mesh mesh;
  mesh.name = "knot";
  for (unsigned i = 0; i < Rows; ++i)
  {
    const double u = Turn * i / Rows;
    const glm::dvec3 along = glm::normalize(centre(u + 1e-4) - centre(u - 1e-4));
    const glm::dvec3 side = glm::normalize(glm::cross(along, glm::dvec3(0.0, 0.0, 1.0)));
    const glm::dvec3 other = glm::cross(along, side);
    for (unsigned j = 0; j < Columns; ++j)
    {
      const double v = Turn * j / Columns;
      const double r = 0.55 + 0.06 * std::sin(16.0 * u) * std::cos(3.0 * v);
      mesh.points.push_back(centre(u) + r * (std::cos(v) * side + std::sin(v) * other));
      const unsigned a = i * Columns, b = (i + 1) % Rows * Columns, k = (j + 1) % Columns;
      mesh.triangles.push_back({ a + j, b + j, b + k });
      mesh.triangles.push_back({ a + j, b + k, a + k });
    }
  }
  normalise(mesh, 1); // on its edge
  return mesh;
}

Mesh ellipsoid(unsigned rows, unsigned columns)
{
  Mesh mesh;
  mesh.name = "ellipsoid";
  const auto point = [](double u, double v)
  {
    return glm::dvec3(glm::vec3(
      0.5 * std::sin(v) * std::cos(u), 0.4 * std::sin(v) * std::sin(u), 0.3 + 0.3 * std::cos(v)));
  };
  mesh.points.push_back(point(0.0, 0.0));
  for (unsigned i = 1; i < rows; ++i)
  {
    for (unsigned j = 0; j < columns; ++j)
    {
      mesh.points.push_back(point(Turn * j / columns, 0.5 * Turn * i / rows));
    }
  }
  mesh.points.push_back(point(0.0, 0.5 * Turn));
  const unsigned last = static_cast<unsigned>(mesh.points.size()) - 1;
  for (unsigned j = 0; j < columns; ++j)
  {
    const unsigned k = (j + 1) % columns;
    mesh.triangles.push_back({ 0, 1 + j, 1 + k });
    mesh.triangles.push_back({ last, last - columns + k, last - columns + j });
    for (unsigned i = 0; i + 2 < rows; ++i)
    {
      const unsigned a = 1 + i * columns, b = a + columns;
      mesh.triangles.push_back({ a + j, b + j, b + k });
      mesh.triangles.push_back({ a + j, b + k, a + k });
    }
  }
  return mesh;
}

Mesh box(const glm::dvec3& low, const glm::dvec3& high)
{
  Mesh mesh;
  mesh.name = "box";
  for (int i = 0; i < 8; ++i)
  {
    mesh.points.push_back(
      { i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z });
  }
  mesh.triangles = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 }, { 1, 5, 4 },
    { 2, 6, 3 }, { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
  return mesh;
}

Mesh ground(double half)
{
  Mesh mesh;
  mesh.name = "ground";
  mesh.points = { { -half, -half, 0 }, { half, -half, 0 }, { half, half, 0 }, { -half, half, 0 } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  return mesh;
}

vtkSmartPointer<vtkPolyData> toPolyData(const Mesh& mesh)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (const glm::dvec3& p : mesh.points)
  {
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  auto polygons = vtkSmartPointer<vtkCellArray>::New();
  for (const glm::uvec3& t : mesh.triangles)
  {
    const vtkIdType ids[3] = { t.x, t.y, t.z };
    polygons->InsertNextCell(3, ids);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(polygons);
  return data;
}

Mesh fromPolyData(vtkPolyData* data, const std::string& name)
{
  const svo::MeshTriangles cut(data);
  const svo::TriangleMesh view = cut.view();
  Mesh mesh;
  mesh.name = name;
  mesh.points.assign(view.points, view.points + view.pointCount);
  mesh.triangles.assign(view.triangles, view.triangles + view.triangleCount);
  return mesh;
}
}
