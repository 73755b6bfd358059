// What a point of an octree of planes looks like that is between the middles of its voxels: its
// normal and its colour are interpolated, so that the look does not change from voxel to voxel.
#ifndef svoVoxelLook_h
#define svoVoxelLook_h

#include "svoOctree.h"
#include "vtkSVOTracingModule.h"

#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// The voxels around a point that say what it looks like.
struct VoxelsAround
{
  int count = 0;
  std::uint32_t planes[8]; // indices in lists()
  glm::vec3 normals[8];    // of the planes; local coordinates, unit
  float shares[8];         // 0..1, of the cube of a voxel around the point
};

/// Weighted trilinearly by where their middles are, so that means are continuous over a smooth
/// surface. `own`: the normal of the plane that was hit. Voxels whose normals are more than 60
/// degrees from it are of another side of an edge or a sheet and do not count. `at`: octree
/// coordinates.
VTKSVOTRACING_EXPORT VoxelsAround voxelsAround(
  const Octree& octree, const glm::dvec3& at, const glm::vec3& own);

/// The mean of their normals, unit; `own` if there is none.
VTKSVOTRACING_EXPORT glm::vec3 smoothNormal(const VoxelsAround& around, const glm::vec3& own);

/// The mean of what colorOf(plane) says of them; `own` where there are none.
template <class ColorOf>
glm::vec3 smoothColor(const VoxelsAround& around, const glm::vec3& own, const ColorOf& colorOf)
{
  glm::vec3 sum(0.0f);
  float all = 0.0f;
  for (int i = 0; i < around.count; ++i)
  {
    sum += around.shares[i] * colorOf(around.planes[i]);
    all += around.shares[i];
  }
  return all > 1e-6f ? sum / all : own;
}

/// Index in lists() of the plane of a voxel below a node: of occupied cells always the one whose
/// middle is nearest to `at`, octree coordinates, the first of those that are as near.
VTKSVOTRACING_EXPORT std::uint32_t nearestVoxel(
  const Octree& octree, std::uint32_t node, const glm::dvec3& at);
}

#endif
