// The plane of a voxel from values at the centres of the voxels around it: of a level set.
//
// The field is trilinear between the centres, and the voxel is occupied where it takes the
// surface's value in the voxel, faces included: nothing is missed. The plane is that of the
// differences of neighbours; it lies where the field is 0 along them from the voxel's centre.
#ifndef svoLevelSetPlane_h
#define svoLevelSetPlane_h

#include "svoSource.h"
#include "vtkSVOOctreeModule.h"

namespace svo
{
/// Values less the surface's at the centres of the 3x3x3 voxels around one, x fastest.
struct VTKSVOOCTREE_EXPORT VoxelValues
{
  static constexpr int Count = 27;
  double at[Count];

  /// Of a neighbour, -1..1 along each axis.
  double& operator()(int x, int y, int z) { return at[(z + 1) * 9 + (y + 1) * 3 + x + 1]; }
  double operator()(int x, int y, int z) const { return at[(z + 1) * 9 + (y + 1) * 3 + x + 1]; }

  /// Whether the surface passes the voxel in the middle. False where a value is not finite.
  VTKSVOOCTREE_EXPORT bool passed() const;
};

/// Whether the surface passes the voxel in the middle, and then as which plane: the normal towards
/// larger values, the offset in voxels. Where differences cancel, as around a single voxel, it
/// looks upwards.
VTKSVOOCTREE_EXPORT bool levelSetPlane(const VoxelValues& values, SourcePlane& plane);
}

#endif
