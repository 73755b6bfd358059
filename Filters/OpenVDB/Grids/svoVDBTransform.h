// Where a grid's voxels lie, as matrices of GLM, and back.
//
// OpenVDB's voxel (i, j, k) is the cube of index space with its centre there: from i - 1/2 to i +
// 1/2.
#ifndef svoVDBTransform_h
#define svoVDBTransform_h

#include <glm/mat4x4.hpp>
#include <openvdb/math/Transform.h>

namespace svo
{
class Octree;

/// Index space -> world. False where the map is not affine, as that of a frustum.
bool indexToWorld(const openvdb::math::Transform& transform, glm::dmat4& matrix);

/// True if the matrix moves and scales by the same positive factor along all axes, and does nothing
/// else: then an octree needs no transform.
bool onlyMovesAndScales(const glm::dmat4& matrix);

/// True if the matrix leaves angles as they are: distances in it are a factor of those before.
bool keepsAngles(const glm::dmat4& matrix);

/// The transform of a grid whose voxel (i, j, k) is that of an octree: from the octree's voxels to
/// the local coordinates of the mesh that carries it.
openvdb::math::Transform::Ptr transformOf(const Octree& octree);
}

#endif
