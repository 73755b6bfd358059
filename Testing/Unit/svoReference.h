// The simplest possible octree, and the simplest walk through it. It is the oracle of the tests and
// the page that teaches the method: Documentation/Method.md goes through it line by line.
#ifndef svoReference_h
#define svoReference_h

#include "svoMorton.h"
#include "svoNode.h"
#include "svoOctree.h"

#include <algorithm>
#include <array>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

namespace svo
{
/// A cube of 2^level voxels along an edge, in units of a voxel: [0, 2^level)^3, level 1..20.
struct ReferenceOctree
{
  static constexpr int Empty = 0;
  static constexpr int Leaf = -1;

  /// A node is eight integers, one per octant (x + 2 y + 4 z): Empty, Leaf, or the index of the
  /// node that divides the octant further. Node 0 is the root.
  std::vector<std::array<int, 8>> nodes{ {} };
  int level = 1;
};

struct ReferenceHit
{
  bool hit = false;
  double t = 0.0;         // where the ray enters the voxel
  glm::ivec3 voxel{ -1 }; // the first one that it meets
};

namespace reference
{
inline int octantOf(const glm::ivec3& corner, int half)
{
  return int((corner.x & half) != 0) | int((corner.y & half) != 0) << 1 |
    int((corner.z & half) != 0) << 2;
}

/// Collects the voxels below node `index` of `depth`, whose block lies at `corner` (in blocks).
inline void collect(const Octree& octree, std::uint32_t index, int depth, const glm::ivec3& corner,
  std::vector<glm::ivec3>& voxels)
{
  const Node& node = octree.nodes()[index];
  std::uint32_t child = node.first;
  for (int i = 0; i < 64; ++i)
  {
    if (hasChild(node, i))
    {
      const glm::ivec3 cell = 4 * corner + cellOfIndex(i);
      if (depth + 1 == octree.depthCount())
      {
        voxels.push_back(cell);
      }
      else
      {
        collect(octree, child++, depth + 1, cell, voxels);
      }
    }
  }
}
}

inline ReferenceOctree makeReference(const std::vector<glm::ivec3>& voxels, int level)
{
  using reference::octantOf;
  ReferenceOctree octree;
  octree.level = level;
  for (const glm::ivec3& voxel : voxels)
  {
    int node = 0;
    for (int half = 1 << (level - 1); half > 1; half /= 2)
    {
      const int octant = octantOf(voxel, half);
      if (octree.nodes[node][octant] == ReferenceOctree::Empty)
      {
        octree.nodes[node][octant] = static_cast<int>(octree.nodes.size());
        octree.nodes.push_back({});
      }
      node = octree.nodes[node][octant];
    }
    octree.nodes[node][octantOf(voxel, 1)] = ReferenceOctree::Leaf;
  }
  return octree;
}

/// The octree's occupied cells at `level` (1..octree.level()) as voxels.
inline ReferenceOctree makeReference(const Octree& octree, int level)
{
  std::vector<glm::ivec3> voxels;
  reference::collect(octree, 0, 0, glm::ivec3(0), voxels);
  for (glm::ivec3& voxel : voxels)
  {
    voxel >>= octree.level() - level;
  }
  return makeReference(voxels, level);
}

/// The first voxel on the ray origin + t direction, tMin <= t <= tMax, which must be finite.
inline ReferenceHit intersect(const ReferenceOctree& octree, const glm::dvec3& origin,
  const glm::dvec3& direction, double tMin, double tMax)
{
  using reference::octantOf;
  const int edge = 1 << octree.level;
  for (int a = 0; a < 3; ++a) // clip the ray to the cube
  {
    if (direction[a] != 0.0)
    {
      const double t0 = (0.0 - origin[a]) / direction[a];
      const double t1 = (edge - origin[a]) / direction[a];
      tMin = std::max(tMin, std::min(t0, t1));
      tMax = std::min(tMax, std::max(t0, t1));
    }
    else if (origin[a] < 0.0 || origin[a] >= edge)
    {
      return {};
    }
  }
  if (!(tMin <= tMax))
  {
    return {};
  }

  double t = tMin;       // where the ray is
  int stack[20] = { 0 }; // the nodes around it, from the root
  int depth = 0;
  int half = edge / 2;  // edge of an octant of the node on top of the stack
  glm::ivec3 corner(0); // lower corner of the octant that the ray is in

  // A point on the middle plane belongs to the octant that the ray is about to enter.
  const auto inUpperHalf = [&](int a, int middle)
  {
    const double x = origin[a] + t * direction[a];
    return direction[a] < 0.0 ? x > middle : x >= middle;
  };
  const auto chooseOctant = [&]
  {
    for (int a = 0; a < 3; ++a)
    {
      corner[a] += inUpperHalf(a, corner[a] + half) ? half : 0;
    }
  };

  chooseOctant();
  for (;;)
  {
    const int child = octree.nodes[stack[depth]][octantOf(corner, half)];
    if (child == ReferenceOctree::Leaf)
    {
      return { true, t, corner };
    }
    if (child != ReferenceOctree::Empty) // PUSH: into the octant
    {
      stack[++depth] = child;
      half /= 2;
      chooseOctant();
      continue;
    }

    // ADVANCE: through the nearest face, or the nearest faces at an edge or a corner
    double tFace[3];
    double tExit = tMax;
    for (int a = 0; a < 3; ++a)
    {
      const int face = corner[a] + (direction[a] < 0.0 ? 0 : half);
      tFace[a] = direction[a] != 0.0 ? (face - origin[a]) / direction[a] : HUGE_VAL;
      tExit = std::min(tExit, tFace[a]);
    }
    const glm::ivec3 before = corner;
    for (int a = 0; a < 3; ++a)
    {
      if (tFace[a] <= tExit)
      {
        corner[a] += direction[a] < 0.0 ? -half : half;
      }
    }
    const bool outside = glm::any(glm::lessThan(corner, glm::ivec3(0))) ||
      glm::any(glm::greaterThanEqual(corner, glm::ivec3(edge)));
    if (corner == before || outside) // the ray has ended
    {
      return {};
    }
    t = std::max(t, tExit);

    // POP: up to the node that holds both octants
    for (glm::ivec3 change = before ^ corner;
         ((change.x | change.y | change.z) & ~(2 * half - 1)) != 0; half *= 2, --depth)
    {
    }
    corner &= ~(half - 1);
  }
}
}

#endif
