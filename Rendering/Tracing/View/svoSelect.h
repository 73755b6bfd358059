// How deep an instance is traced in a view: no deeper than its pixels can show.
#ifndef svoSelect_h
#define svoSelect_h

#include "svoLocalView.h"
#include "svoScene.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
/// How long an edge of local length 1 along an axis is in the world, at most.
inline double worldScale(const glm::dmat4& localToWorld)
{
  double scale = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    scale = std::max(scale, glm::length(glm::dvec3(localToWorld[c])));
  }
  return scale;
}

/// Longest edge of a voxel of the octree's last level, in the world.
inline double worldVoxel(const Instance& instance)
{
  return worldScale(instance.localToWorld) * instance.octree.header().voxelSize;
}

/// Edge of the smaller side of a pixel, in the world, at linear depth t.
inline double worldPixel(const View& view, double t)
{
  return std::min(glm::length(view.originX + t * view.directionX),
    glm::length(view.originY + t * view.directionY));
}

/// Edge of the wider side.
inline double widerWorldPixel(const View& view, double t)
{
  return std::max(glm::length(view.originX + t * view.directionX),
    glm::length(view.originY + t * view.directionY));
}

/// The coarsest octree level whose voxels, seen at the nearest point of the octree's cube, are at
/// most `pixelError` pixels long, or Instance::pixelError where the instance has its own; the
/// octree's last level if none is, or if the error is 0.
inline int selectLevel(
  const Instance& instance, const LocalView& local, const View& view, double pixelError)
{
  const int last = instance.octree.level();
  if (instance.pixelError >= 0.0)
  {
    pixelError = instance.pixelError;
  }
  const double allowed = pixelError * worldPixel(view, local.base);
  double voxel = worldVoxel(instance);
  if (!(pixelError > 0.0) || !(allowed > 0.0) || !(voxel > 0.0))
  {
    return last;
  }
  int level = last;
  while (level > 1 && 2.0 * voxel <= allowed)
  {
    voxel *= 2.0;
    --level;
  }
  return level;
}

/// Edge of a voxel of a level in the world.
inline double worldVoxel(const Instance& instance, int level)
{
  return std::ldexp(worldVoxel(instance), instance.octree.level() - level);
}

/// How far a cube can lie from the surface that it stands for: the diagonal of a voxel.
constexpr double CubeError = 1.75;

/// How far a hit can lie from the surface that it stands for, in voxels of the level that rays stop
/// at: cubes, and planes where a ray is given the cube that refused it, by the diagonal of a voxel;
/// mean planes by half the diagonal of the three cells in which they are met.
inline double leafError(const Instance& instance, LeafGeometry geometry, int level)
{
  constexpr double MeanPlane = 2.6;
  if (geometry == LeafGeometry::Voxel)
  {
    return CubeError;
  }
  if (level < instance.octree.level() - 2)
  {
    return MeanPlane;
  }
  if (geometry == LeafGeometry::Plane || !instance.octree.surface())
  {
    return CubeError;
  }
  return 0.0; // of automatic leaves, where lists are short; see worldMapError() and ShadowRays
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

/// What the test against a shadow map allows for, in the world. Of plane leaves that is a voxel:
/// few are further off, and their acne (1e-4 of the pixels of real meshes) is a smaller harm than
/// contact shadows that begin three voxels late. Automatic leaves are planes where lists are long,
/// and the triangles smaller than a voxel. A ray among planes needs all of their error.
inline double worldMapError(
  const Instance& instance, LeafGeometry geometry, int level, bool placed = false)
{
  constexpr double Plane = 1.0;
  constexpr double Automatic = 0.25;
  if (level < instance.octree.level() - 2 || !instance.octree.surface())
  {
    return worldLeafError(instance, geometry, level, placed);
  }
  return geometry == LeafGeometry::Plane  ? Plane * worldVoxel(instance, level)
    : geometry == LeafGeometry::Automatic ? Automatic * worldVoxel(instance, level)
                                          : worldLeafError(instance, geometry, level, placed);
}
}

#endif
