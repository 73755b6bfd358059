// Meshes that the benchmarks run on.
#include "svoBenchmarkMesh.h"

#include "loaders.h"
#include "meshes.h"
#include "svoMeshDetail.h"
#include "svoMeshTriangles.h"

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"

#include <cmath>
#include <cstdlib>
#include <random>

namespace svobench
{
namespace
{
Mesh trianglesOf(vtkPolyData* data, const std::string& name)
{
  const svo::MeshTriangles triangles(data);
  const svo::TriangleMesh view = triangles.view();
  return { name, { view.points, view.points + view.pointCount },
    { view.triangles, view.triangles + view.triangleCount } };
}
}

bool readFile(const std::string& path, Mesh& mesh, std::string& error)
{
  const vtkSmartPointer<vtkPolyData> data = paper::readTriangles(path, 0, error);
  if (data)
  {
    mesh = trianglesOf(data, path.substr(path.find_last_of('/') + 1));
  }
  return data != nullptr;
}

bool readArgument(int argc, char** argv, int& i, std::vector<Mesh>& meshes, std::string& error)
{
  const std::string first = argv[i];
  if (first == "--ball")
  {
    const double triangles = i + 1 < argc ? std::atof(argv[++i]) : 0.0;
    if (!(triangles >= 16.0 && triangles <= 1e8))
    {
      error = "--ball needs a number of triangles.";
      return false;
    }
    meshes.push_back(bumpySphere(static_cast<unsigned>(std::lround(std::sqrt(triangles / 4.0)))));
    return true;
  }
  const bool paperObject = first == "--a" || first == "--b";
  if (paperObject && ++i == argc)
  {
    error = first + " needs a file.";
    return false;
  }
  const std::string path = argv[i];
  std::string name = path.substr(path.find_last_of('/') + 1);
  vtkSmartPointer<vtkPolyData> data;
  if (first == "--a")
  {
    data = paper::readObjectA(path, error);
    name = "object A";
  }
  else if (first == "--b")
  {
    std::vector<vtkSmartPointer<vtkPolyData>> poses;
    if (paper::readObjectB(path, 1, poses, error))
    {
      data = poses.front();
    }
    name = "object B, one pose";
  }
  else
  {
    data = paper::readTriangles(path, 0, error);
  }
  if (data)
  {
    meshes.push_back(trianglesOf(data, name));
  }
  return data != nullptr;
}

Mesh torus(unsigned rows, unsigned columns)
{
  constexpr double turn = 6.28318530717958647692;
  Mesh mesh;
  mesh.name = "torus";
  for (unsigned i = 0; i < rows; ++i)
  {
    for (unsigned j = 0; j < columns; ++j)
    {
      const double u = turn * i / rows, v = turn * j / columns;
      const double r = 1.0 + 0.4 * std::cos(v);
      mesh.points.push_back({ r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v) });
      const unsigned a = i * columns, b = (i + 1) % rows * columns, k = (j + 1) % columns;
      mesh.triangles.push_back({ a + j, b + j, b + k });
      mesh.triangles.push_back({ a + j, b + k, a + k });
    }
  }
  return mesh;
}

Mesh bumpySphere(unsigned slices)
{
  Mesh mesh;
  mesh.name = "bumpy sphere";
  const double pi = std::acos(-1.0);
  for (unsigned i = 0; i <= slices; ++i)
  {
    for (unsigned j = 0; j <= 2 * slices; ++j)
    {
      const double a = pi * i / slices;
      const double b = pi * j / slices;
      const double r = 1.0 + 0.1 * std::sin(9.0 * a) * std::cos(8.0 * b);
      mesh.points.push_back(
        r * glm::dvec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  }
  const unsigned row = 2 * slices + 1;
  for (unsigned i = 0; i < slices; ++i)
  {
    for (unsigned j = 0; j < 2 * slices; ++j)
    {
      const unsigned a = i * row + j;
      mesh.triangles.push_back({ a, a + row, a + 1 });
      mesh.triangles.push_back({ a + row, a + row + 1, a + 1 });
    }
  }
  return mesh;
}

Mesh ground()
{
  return { "ground, 2 triangles",
    { { 0.0, 0.0, 0.1 }, { 1.0, 0.0, 0.2 }, { 1.0, 1.0, 0.3 }, { 0.0, 1.0, 0.2 } },
    { { 0, 1, 2 }, { 0, 2, 3 } } };
}

Mesh city(unsigned houses)
{
  Mesh mesh{ "city", { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } },
    { { 0, 1, 2 }, { 0, 2, 3 } } };
  std::mt19937 random(1);
  const auto between = [&random](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(random); };
  for (unsigned house = 0; house < houses; ++house)
  {
    const glm::dvec3 size(between(0.003, 0.01), between(0.003, 0.01), between(0.005, 0.05));
    const glm::dvec3 low(between(0.0, 1.0 - size.x), between(0.0, 1.0 - size.y), 0.0);
    const auto first = static_cast<unsigned>(mesh.points.size());
    for (unsigned corner = 0; corner < 8; ++corner)
    {
      mesh.points.push_back(low + size * glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2));
    }
    for (const glm::uvec4& q :
      { glm::uvec4(0, 2, 3, 1), glm::uvec4(4, 5, 7, 6), glm::uvec4(0, 1, 5, 4),
        glm::uvec4(2, 6, 7, 3), glm::uvec4(0, 4, 6, 2), glm::uvec4(1, 3, 7, 5) })
    {
      mesh.triangles.push_back(first + glm::uvec3(q.x, q.y, q.z));
      mesh.triangles.push_back(first + glm::uvec3(q.x, q.z, q.w));
    }
  }
  return mesh;
}

vtkSmartPointer<vtkPolyData> polyData(const Mesh& mesh)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const glm::dvec3& p : mesh.points)
  {
    points->InsertNextPoint(&p.x);
  }
  vtkNew<vtkCellArray> cells;
  for (const glm::uvec3& t : mesh.triangles)
  {
    cells->InsertNextCell({ t.x, t.y, t.z });
  }
  result->SetPoints(points);
  result->SetPolys(cells);
  return result;
}

int detailLevel(const Mesh& mesh)
{
  return svo::detailLevel(polyData(mesh));
}
}
