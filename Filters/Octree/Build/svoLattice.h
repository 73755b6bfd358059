// The fixed lattice that vertices are snapped to: 1/256 voxel. Every decision of the builder after
// the snapping is exact integer arithmetic on it.
#ifndef svoLattice_h
#define svoLattice_h

#include "svoBuild.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace svo
{
constexpr int LatticeBits = 8;
constexpr std::int32_t LatticeUnits = 1 << LatticeBits; // in a voxel

/// Coordinates beyond this are treated like infinite ones: products with them would overflow.
constexpr double LargestCoordinate = 1e290;

/// Nor is a cube smaller than this: the inverse of a voxel's edge must stay finite.
constexpr double SmallestEdge = 1e-250;

inline bool usable(const glm::dvec3& p)
{
  // A comparison with NaN is false.
  return std::abs(p.x) <= LargestCoordinate && std::abs(p.y) <= LargestCoordinate &&
    std::abs(p.z) <= LargestCoordinate;
}

inline bool usable(const TriangleMesh& mesh, const glm::uvec3& t)
{
  return usable(mesh.points[t.x]) && usable(mesh.points[t.y]) && usable(mesh.points[t.z]);
}

/// local coordinates -> lattice. A snapped vertex is at most half a unit away on each axis, so with
/// voxels grown by a whole unit nothing of the true triangle is outside them.
struct Lattice
{
  glm::dvec3 origin;
  double unitsPerLength;
  std::int32_t last; // largest coordinate that is used: the cube is [0, last + 1]

  Lattice(const Cube& cube, int level)
    : origin(cube.origin)
    , unitsPerLength(std::ldexp(1.0 / cube.edge, level + LatticeBits))
    , last((1 << (level + LatticeBits)) - 1)
  {
    assert(level >= 1 && level <= MaximumLevel);
    assert(cube.edge > 0.0 && std::isfinite(this->unitsPerLength));
  }

  /// Not snapped, in lattice units.
  glm::dvec3 place(const glm::dvec3& p) const { return (p - this->origin) * this->unitsPerLength; }

  /// The nearest lattice point of a place.
  glm::ivec3 snap(const glm::dvec3& q) const
  {
    assert(std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z));
    // Positive, so that the conversion rounds down.
    const double top = this->last;
    return { static_cast<std::int32_t>(std::clamp(q.x + 0.5, 1.0, top)),
      static_cast<std::int32_t>(std::clamp(q.y + 0.5, 1.0, top)),
      static_cast<std::int32_t>(std::clamp(q.z + 0.5, 1.0, top)) };
  }
};
}

#endif
