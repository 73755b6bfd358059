// The error of a hit: how far a hit can lie from the surface that it stands for.
#ifndef svoLeafError_h
#define svoLeafError_h

#include "svoLeafTraits.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <cassert>

namespace svo
{
/// How far a cube, or what lies in it, can be from the surface that it stands for: the diagonal of
/// a voxel.
constexpr double CubeError = 1.75;

/// How far a mean plane of a node above the bricks can lie from it: half the diagonal of the three
/// cells in which the plane is met.
constexpr double MeanPlaneError = 2.6;

/// True if rays that stop at `level` meet mean planes of nodes: bricks are not reached.
inline bool stopsAtNodes(const Instance& instance, int level)
{
  assert(level >= 0 && level <= instance.body->octree.level());
  return level < instance.body->octree.brickLevel();
}

/// The error of a hit in voxels of the level that rays stop at. Cubes, and planes where a ray is
/// given the cube that refused it, are off by the diagonal of a voxel.
inline double leafError(const Instance& instance, LeafGeometry geometry, int level)
{
  const LeafTraits traits = traitsOf(geometry);
  if (!traits.fallsBack())
  {
    return CubeError;
  }
  if (stopsAtNodes(instance, level))
  {
    return MeanPlaneError;
  }
  // Of automatic leaves that holds where lists are short; see worldMapError() and ShadowRays.
  return traits.exact() && instance.body->octree.surface() ? 0.0 : CubeError;
}

/// The same in the world, and never less than what floats resolve in the octree's cube: where hits
/// are `placed` on the triangles in double (svoPlaceOnTriangles.h) only the triangles' points and
/// the hit's depth are floats, not the ray.
inline double worldLeafError(
  const Instance& instance, LeafGeometry geometry, int level, bool placed = false)
{
  return std::max(leafError(instance, geometry, level) * worldVoxel(instance, level),
    (placed ? 1.2e-7 : 1e-6) * worldVoxel(instance, 0));
}

/// True if all that rays meet that stop at `level` are triangles.
inline bool meetsTrianglesAlone(const Instance& instance, LeafGeometry geometry, int level)
{
  const LeafTraits traits = traitsOf(geometry);
  return traits.exact() && instance.body->octree.surface() && !stopsAtNodes(instance, level) &&
    instance.body->octree.longestList() <= traits.longestExact;
}

/// The error that the test against a shadow map allows for (LeafTraits::mapError), in the world. A
/// ray among planes needs all of their error. Where there are none, a stretched octree of few
/// levels has long voxels and exact hits all the same.
inline double worldMapError(
  const Instance& instance, LeafGeometry geometry, int level, bool placed = false)
{
  const double error = traitsOf(geometry).mapError;
  const bool planes = instance.body->octree.surface() || instance.body->octree.hasPlanes();
  return error > 0.0 && !stopsAtNodes(instance, level) && planes &&
      !meetsTrianglesAlone(instance, geometry, level)
    ? error * worldVoxel(instance, level)
    : worldLeafError(instance, geometry, level, placed);
}

/// True if the hit of a ray that stops at `level` does not depend on where the ray ends, so that it
/// may be cut short: all leaves but planes, whose rays fall back on a refused cell at their end. An
/// octree's own planes have no such end, but their nodes have.
inline bool endsFreely(const Instance& instance, int level)
{
  const LeafTraits traits = traitsOf(instance.body->leafGeometry);
  if (instance.body->octree.hasPlanes())
  {
    return !traits.fallsBack() || !stopsAtNodes(instance, level);
  }
  if (!traits.fallsBack() || !instance.body->octree.surface())
  {
    return true;
  }
  return meetsTrianglesAlone(instance, instance.body->leafGeometry, level);
}
}

#endif
