#include "svoRepresentative.h"

#include "svoNode.h"

#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace svo
{
namespace
{
double squaredDistanceToSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b)
{
  const glm::dvec3 ab = b - a;
  const double length2 = glm::dot(ab, ab);
  const double s = length2 > 0.0 ? glm::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
  const glm::dvec3 d = p - (a + s * ab);
  return glm::dot(d, d);
}

double squaredDistance(
  const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double area2 = glm::dot(n, n);
  if (area2 > 0.0 && glm::dot(glm::cross(b - a, p - a), n) >= 0.0 &&
    glm::dot(glm::cross(c - b, p - b), n) >= 0.0 && glm::dot(glm::cross(a - c, p - c), n) >= 0.0)
  {
    const double height = glm::dot(p - a, n);
    return height * height / area2;
  }
  return glm::min(squaredDistanceToSegment(p, a, b),
    glm::min(squaredDistanceToSegment(p, b, c), squaredDistanceToSegment(p, c, a)));
}
}

std::uint32_t firstTriangle(const Octree& octree, std::uint32_t node)
{
  while (node < octree.brickBegin())
  {
    node = octree.nodes()[node].first;
  }
  std::uint32_t count = 0;
  std::uint32_t inlineId = 0;
  return *octree.brickTriangles(node, count, inlineId);
}

std::uint32_t nearestTriangle(const Octree& octree, const OctreeCell& cell, int level)
{
  if (cell.node < octree.brickBegin())
  {
    // Below the first of the children that are the cell's.
    const Node& parent = octree.nodes()[cell.node];
    return firstTriangle(
      octree, parent.first + static_cast<std::uint32_t>(childrenBefore(parent, cell.firstBit)));
  }
  std::uint32_t count = 0;
  std::uint32_t inlineId = 0;
  const std::uint32_t* ids = octree.brickTriangles(cell.node, count, inlineId);
  const double edge = std::ldexp(1.0, -octree.rootBits(level)); // octree coordinates
  const glm::dvec3 centre = 1.0 + (glm::dvec3(cell.cell) + 0.5) * edge;
  const Surface& surface = *octree.surface();
  std::uint32_t best = ids[0];
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t k = 0; count > 1 && k < count; ++k)
  {
    const glm::uvec3& t = surface.triangles[ids[k]];
    const double distance =
      squaredDistance(centre, surface.points[t.x], surface.points[t.y], surface.points[t.z]);
    if (distance < least)
    {
      least = distance;
      best = ids[k];
    }
  }
  return best;
}
}
