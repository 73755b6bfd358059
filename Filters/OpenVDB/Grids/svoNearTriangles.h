// How far points are from the nearest triangle of an octree, where it is known that it is not far.
#ifndef svoNearTriangles_h
#define svoNearTriangles_h

#include "svoMorton.h"
#include "svoOctree.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

namespace svo
{
/// The triangles around a block of 8x8x8 points. Coordinates are those of the octree's voxels,
/// whose centres are whole numbers.
class NearTriangles
{
public:
  /// `corner`: the first of the points. `reach`: how far they may be from a triangle.
  NearTriangles(const Octree& octree, const glm::ivec3& corner, double reach)
    : Tree(octree)
    , Low(glm::dvec3(corner) - 0.5 - reach)
    , High(glm::dvec3(corner) + 7.5 + reach)
  {
    this->collect(0, glm::ivec3(0), octree.rootBits(octree.level()));
  }

  /// The distance of a point from the nearest triangle that is nearer than `bound`; else the bound.
  /// distanceOf(triangle, point, bound) is a triangle's, or more than the bound.
  template <class DistanceOf>
  double distance(const glm::dvec3& point, double bound, const DistanceOf& distanceOf)
  {
    this->Near.clear();
    for (const Brick& brick : this->Bricks)
    {
      // A triangle may lie outside of the voxels that it touches, but what is nearest of it does
      // not: that is a point of it in a voxel of some brick.
      const glm::dvec3 low = glm::dvec3(brick.corner) - 0.5 - Grown,
                       high = low + (NodeEdge + 2.0 * Grown);
      const double distance =
        glm::length(glm::max(glm::max(low - point, point - high), glm::dvec3(0.0)));
      if (distance < bound)
      {
        this->Near.push_back({ brick.corner, brick.node, distance });
      }
    }
    std::sort(this->Near.begin(), this->Near.end(),
      [](const Brick& a, const Brick& b) { return a.distance < b.distance; });
    for (const Brick& brick : this->Near)
    {
      if (brick.distance >= bound)
      {
        break;
      }
      std::uint32_t count = 0, alone = 0;
      const std::uint32_t* ids = this->Tree.brickTriangles(brick.node, count, alone);
      for (std::uint32_t i = 0; i < count; ++i)
      {
        bound = std::min(bound, distanceOf(ids[i], point, bound));
      }
    }
    return bound;
  }

private:
  struct Brick
  {
    glm::ivec3 corner;
    std::uint32_t node;
    double distance;
  };
  static constexpr double Grown = 1.0 / 128.0; // voxels are grown, and vertices snapped

  /// `bits`: of a coordinate of the voxels in the node's block.
  void collect(std::uint32_t index, const glm::ivec3& corner, int bits)
  {
    const Node& node = this->Tree.nodes()[index];
    if (bits == NodeLevels)
    {
      this->Bricks.push_back({ corner, index, 0.0 });
      return;
    }
    const int edge = 1 << (bits - NodeLevels);
    std::uint32_t child = node.first;
    for (std::uint64_t mask = node.mask; mask != 0; mask &= mask - 1, ++child)
    {
      const glm::ivec3 at = corner + edge * cellOfIndex(lowestBit(mask));
      const glm::dvec3 low = glm::dvec3(at) - 0.5, high = low + static_cast<double>(edge);
      if (glm::all(glm::lessThanEqual(low, this->High)) &&
        glm::all(glm::lessThanEqual(this->Low, high)))
      {
        this->collect(child, at, bits - NodeLevels);
      }
    }
  }

  const Octree& Tree;
  const glm::dvec3 Low, High;
  std::vector<Brick> Bricks, Near;
};
}

#endif
