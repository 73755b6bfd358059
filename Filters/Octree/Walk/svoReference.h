// The simplest possible octree, and the simplest walk through it. It is the oracle of the tests and
// the page that teaches the method: Documentation/Method.md goes through it line by line.
#ifndef svoReference_h
#define svoReference_h

#include "svoOctree.h"
#include "vtkSVOOctreeModule.h"

#include <array>
#include <vector>

#include <glm/vec3.hpp>

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

VTKSVOOCTREE_EXPORT ReferenceOctree makeReference(const std::vector<glm::ivec3>& voxels, int level);

/// The octree's occupied cells at `level` (1..octree.level()) as voxels.
VTKSVOOCTREE_EXPORT ReferenceOctree makeReference(const Octree& octree, int level);

/// The first voxel on the ray origin + t direction, tMin <= t <= tMax, which must be finite.
VTKSVOOCTREE_EXPORT ReferenceHit intersect(const ReferenceOctree& octree, const glm::dvec3& origin,
  const glm::dvec3& direction, double tMin, double tMax);
}

#endif
