// What a point of an octree of planes looks like that is between the middles of its voxels: its
// normal is interpolated, so that shading does not change from voxel to voxel.
#ifndef svoVoxelLook_h
#define svoVoxelLook_h

#include "svoOctree.h"
#include "vtkSVOTracingModule.h"

#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// The mean of the normals of the voxels around `at`, weighted trilinearly by where their middles
/// are, so that it is continuous over a smooth surface; local frame, unit. `own`: the normal of the
/// plane that was hit. Normals that are more than 60 degrees from it are of another side of an edge
/// or a sheet and do not count. `at`: octree coordinates.
VTKSVOTRACING_EXPORT glm::vec3 smoothNormal(
  const Octree& octree, const glm::dvec3& at, const glm::vec3& own);

/// Index in lists() of the plane of a voxel below a node: of occupied cells always the one whose
/// middle is nearest to `at`, octree coordinates, the first of those that are as near.
VTKSVOTRACING_EXPORT std::uint32_t nearestVoxel(
  const Octree& octree, std::uint32_t node, const glm::dvec3& at);
}

#endif
