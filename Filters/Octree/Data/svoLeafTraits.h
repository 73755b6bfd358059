// What follows from a leaf geometry, in one table: whoever needs to know asks here.
#ifndef svoLeafTraits_h
#define svoLeafTraits_h

#include "svoLayout.h"

#include <cstdint>
#include <limits>

namespace svo
{
/// Longest list of triangles that automatic leaves go through. To look for a plane in every cell of
/// a brick takes as long as to test so many triangles once.
constexpr std::uint32_t ShortList = 64;

/// How a cell is met whose triangles are not gone through.
enum class CellShape
{
  Cube,
  Plane // the mean one, or a triangle's
};

struct LeafTraits
{
  const char* name;
  /// Bricks with lists of up to so many triangles are met exactly, triangle by triangle; fits in an
  /// int.
  std::uint32_t longestExact;
  CellShape shape; // of other cells
  /// How far beyond its own cell a hit may lie, in cells.
  double reach;
  /// What the test against a shadow map allows for, in voxels of the last level; 0: no less than
  /// the error of the leaves (svoLeafError.h). Of planes that is a voxel: few are further off, and
  /// their acne (1e-4 of the pixels of real meshes) is a smaller harm than contact shadows that
  /// begin three voxels late. Automatic leaves are planes where lists are long, and the triangles
  /// smaller than a voxel.
  double mapError;

  bool exact() const { return this->longestExact > 0; }
  /// A ray that finds nothing to its end is given the first cell that refused it; cells of other
  /// shapes have the hits of their rays inside.
  bool fallsBack() const { return this->shape == CellShape::Plane; }
};

/// In the order of LeafGeometry.
constexpr LeafTraits LeafTable[] = {
  { "Voxel", 0, CellShape::Cube, 0.0, 0.0 },
  { "Plane", 0, CellShape::Plane, 1.0, 1.0 },
  { "Triangle", std::numeric_limits<std::int32_t>::max(), CellShape::Plane, 1.0, 0.0 },
  { "Automatic", ShortList, CellShape::Plane, 1.0, 0.25 },
};
constexpr std::uint32_t LeafGeometries = sizeof(LeafTable) / sizeof(LeafTable[0]);

constexpr LeafTraits traitsOf(LeafGeometry geometry)
{
  return LeafTable[static_cast<std::uint32_t>(geometry)];
}
}

#endif
