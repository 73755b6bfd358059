// The octree level, or voxel size, that tells a mesh's triangles apart.
#ifndef svoMeshDetail_h
#define svoMeshDetail_h

#include "vtkSVOCoreModule.h"

class vtkPolyData;

namespace svo
{
/// The octree level from which on a brick has few triangles, but for one triangle in a hundred;
/// 4..MaximumLevel. Where leaves are triangles, or automatic, a deeper octree shows nothing more:
/// it only says more often which few triangles are there. MaximumLevel for meshes that have so many
/// triangles that there is little to gain. Sorts the triangles: costs less than a build. Does not
/// change the mesh.
VTKSVOCORE_EXPORT int detailLevel(vtkPolyData* mesh);

/// The same as the edge of a voxel, in the mesh's units; 0 where it is MaximumLevel.
VTKSVOCORE_EXPORT double detailVoxel(vtkPolyData* mesh);

/// The level, 1..maximum, of an octree around `bounds` (as VTK orders them) whose voxels are no
/// larger than `voxel`; the maximum for a voxel of 0.
VTKSVOCORE_EXPORT int levelOfVoxel(const double bounds[6], double voxel, int maximum);
}

#endif
