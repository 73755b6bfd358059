// A mesh that owns its memory.
#ifndef svoTestMesh_h
#define svoTestMesh_h

#include "svoBuild.h"

#include <vector>

#include <glm/vec3.hpp>

namespace svotest
{
struct Mesh
{
  std::vector<glm::dvec3> points;
  std::vector<glm::uvec3> triangles;

  svo::TriangleMesh view() const
  {
    return { points.data(), points.size(), triangles.data(), triangles.size() };
  }
  void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
  {
    const auto n = static_cast<unsigned>(points.size());
    points.push_back(a);
    points.push_back(b);
    points.push_back(c);
    triangles.push_back({ n, n + 1, n + 2 });
  }
};
}

#endif
