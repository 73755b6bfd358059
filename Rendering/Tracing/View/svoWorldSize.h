// Sizes of voxels and pixels in the world.
#ifndef svoWorldSize_h
#define svoWorldSize_h

#include "svoInstance.h"
#include "svoView.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
/// Longest edge, in the world, that an edge of local length 1 along an axis becomes.
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
  return worldScale(instance.localToWorld) * instance.body->octree.header().voxelSize;
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

/// Edge of a voxel of a level in the world.
inline double worldVoxel(const Instance& instance, int level)
{
  assert(level >= 0 && level <= instance.body->octree.level());
  return std::ldexp(worldVoxel(instance), instance.body->octree.level() - level);
}
}

#endif
