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

struct LeafTraits
{
  /// Bricks with lists of up to so many triangles are met exactly, triangle by triangle; fits in an
  /// int.
  std::uint32_t longestExact;
  /// True if other cells are met at their mean plane, false if they are cubes.
  bool planes;
  /// How far beyond its own cell a hit may lie, in cells.
  double reach;
  /// What the test against a shadow map allows for, in voxels of the last level; 0: no less than
  /// the error of the leaves (svoLeafError.h). Of planes that is a voxel: few are further off, and
  /// their acne (1e-4 of the pixels of real meshes) is a smaller harm than contact shadows that
  /// begin three voxels late. Automatic leaves are planes where lists are long, and the triangles
  /// smaller than a voxel.
  double mapError;

  bool exact() const { return this->longestExact > 0; }
};

constexpr LeafTraits traitsOf(LeafGeometry geometry)
{
  constexpr std::uint32_t All = std::numeric_limits<std::int32_t>::max();
  constexpr LeafTraits Table[] = {
    { 0, false, 0.0, 0.0 },        // Voxel
    { 0, true, 1.0, 1.0 },         // Plane
    { All, true, 1.0, 0.0 },       // Triangle
    { ShortList, true, 1.0, 0.25 } // Automatic
  };
  return Table[static_cast<std::uint32_t>(geometry)];
}
}

#endif
