// The triangles that a brick's list names, in octree coordinates.
#ifndef svoSurface_h
#define svoSurface_h

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// Derived from the mesh, never stored. Points and triangles have capacity for one more (loads).
struct Surface
{
  std::vector<glm::vec3> points;     // octree coordinates, one per mesh point; shared vertices are
                                     // bit-identical, which is what makes edges watertight
  std::vector<glm::uvec3> triangles; // mesh point ids, in the mesh's winding
  std::vector<std::uint32_t> cells;  // mesh cell id of each triangle

  std::size_t bytes() const
  {
    return points.size() * sizeof(glm::vec3) + triangles.size() * sizeof(glm::uvec3) +
      cells.size() * sizeof(std::uint32_t);
  }
};

/// The plane of a triangle, octree coordinates.
struct TrianglePlane
{
  glm::dvec3 p{ 0.0 }, normal{ 0.0 }; // of any length, by the winding

  TrianglePlane() = default;
  TrianglePlane(const Surface& surface, std::uint32_t id)
  {
    assert(id < surface.triangles.size());
    const glm::uvec3 triangle = surface.triangles[id];
    p = glm::dvec3(surface.points[triangle.x]);
    normal = glm::cross(
      glm::dvec3(surface.points[triangle.y]) - p, glm::dvec3(surface.points[triangle.z]) - p);
  }
};
}

#endif
