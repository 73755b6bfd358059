// Meshes that the benchmarks run on.
#include "svoBenchmarkMesh.h"

#include "loaders.h"
#include "meshes.h"
#include "svoMeshTriangles.h"

#include <cmath>
#include <cstdlib>

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
}
