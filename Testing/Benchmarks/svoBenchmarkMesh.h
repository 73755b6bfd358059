// Meshes that the benchmarks run on: OFF files and a torus.
#ifndef svoBenchmarkMesh_h
#define svoBenchmarkMesh_h

#include "svoBuild.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace svobench
{
struct Mesh
{
  std::string name;
  std::vector<glm::dvec3> points;
  std::vector<glm::uvec3> triangles;

  svo::TriangleMesh view() const
  {
    return { points.data(), points.size(), triangles.data(), triangles.size() };
  }
};

/// Polygons become fans. False if the file is no readable OFF mesh.
inline bool readOFF(const std::string& path, Mesh& mesh)
{
  std::ifstream file(path);
  std::stringstream text; // without comments
  for (std::string line; std::getline(file, line);)
  {
    text << line.substr(0, line.find('#')) << '\n';
  }
  std::string magic;
  std::size_t points = 0, faces = 0, edges = 0;
  text >> magic >> points >> faces >> edges;
  if (!text || magic != "OFF")
  {
    return false;
  }
  mesh.name = path.substr(path.find_last_of('/') + 1);
  mesh.points.resize(points);
  for (glm::dvec3& p : mesh.points)
  {
    text >> p.x >> p.y >> p.z;
  }
  for (std::size_t f = 0; f < faces && text; ++f)
  {
    std::string line;
    std::size_t corners = 0;
    text >> corners;
    std::vector<unsigned> ids;
    for (std::size_t k = 0; k < corners && text; ++k)
    {
      ids.push_back(0);
      text >> ids.back();
      if (ids.back() >= points)
      {
        return false;
      }
    }
    std::getline(text, line); // a face may have a colour
    for (std::size_t k = 2; k < ids.size(); ++k)
    {
      mesh.triangles.push_back({ ids[0], ids[k - 1], ids[k] });
    }
  }
  return static_cast<bool>(text) && !mesh.triangles.empty();
}

/// Radii 1 and 0.4; 2 rows columns triangles.
inline Mesh torus(unsigned rows, unsigned columns)
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
}

#endif
