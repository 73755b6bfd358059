// The triangles that a brick's list names, in octree coordinates.
#ifndef svoSurface_h
#define svoSurface_h

#include <cstddef>
#include <cstdint>
#include <vector>

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
}

#endif
