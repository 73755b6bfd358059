// The triangles of a patch: what their points need to know of them, computed once for each and
// looked up by the points, however many pixels a triangle has.
#ifndef svoTileTriangles_h
#define svoTileTriangles_h

#include "svoSurfacePoint.h"
#include "svoTilePatch.h"

#include <cstdint>

namespace svo
{
struct TileTriangles
{
  static constexpr int Most = TilePatch::Most;
  /// Numbers of a triangle; of vectors the first of their components.
  enum Column
  {
    Facet,              // unit, the side that it winds to; world
    Normal = Facet + 3, // of all its points, unit; world
    V = Normal + 3,     // affineWeights() of points
    AlongV = V + 1,
    W = AlongV + 3,
    AlongW = W + 1,
    Normals = AlongW + 3,     // of the corners, to a factor; world
    Colors = Normals + 9,     // of the corners; where all points have one, of the first
    Coordinates = Colors + 9, // of the corners, two numbers each
    Columns = Coordinates + 6
  };

  int count;                            // different ones
  Primitive primitive[Most];            // of each
  std::uint64_t lanes[Most];            // of the patch, that show it
  alignas(64) std::int32_t which[Most]; // by pixel
  alignas(64) float column[Columns][Most];
  /// Triangles whose points cannot be computed in vectors: they, or their normals, are too small or
  /// too large to be made unit vectors in single precision.
  std::uint64_t oddLanes;
  /// What is interpolated; triangles of one instance differ in `smooth` only, as some have the
  /// same normal at all corners.
  bool smooth, textured, coloredByPoints, coloredByCells;
  bool ownNormals; // those of points are not those of facets

  bool needsWeights() const { return smooth || textured || coloredByPoints; }
  bool hasColor() const { return textured || coloredByPoints || coloredByCells; }
};

/// The triangles of those points of a patch that are in `lanes`, which are no nodes.
void findTriangles(const SurfaceMatrices& matrices, const TilePatch& patch, std::uint64_t lanes,
  TileTriangles& triangles);
}

#endif
