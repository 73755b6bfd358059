// Flat convex polygons of thousands of points, cut otherwise than by a fan.
#ifndef svoLargePolygon_h
#define svoLargePolygon_h

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
/// Polygons with more points than this are worth a look. A fan's triangles all reach from the rim
/// to the first point, so an octree notes each of them in all the bricks on its way: the cost of a
/// fan grows with its points times the bricks across. Cut in halves, again and again, most
/// triangles are as short as the polygon's edges.
constexpr std::size_t LargePolygon = 8192;

/// True if all triangles of the fan and of the halves lie in one plane and have one winding. They
/// cover the same points then: those that the polygon's outline goes around. Only what point data
/// look like inside of the polygon depends on the cut.
bool canBeHalved(const glm::dvec3* points, const std::vector<std::uint32_t>& polygon);

/// Calls visit(i, k, j), indices into the polygon in its own winding, for each triangle of the part
/// between two of its points.
template <typename Visit>
void halve(std::size_t first, std::size_t last, const Visit& visit)
{
  if (last - first < 2)
  {
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  visit(first, middle, last);
  halve(first, middle, visit);
  halve(middle, last, visit);
}
}

#endif
