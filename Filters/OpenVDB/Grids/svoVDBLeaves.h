// The leaves of an octree as a grid: a mask of its voxels.
#ifndef svoVDBLeaves_h
#define svoVDBLeaves_h

#include "vtkSVOOpenVDBModule.h"

#include <openvdb/openvdb.h>

namespace svo
{
class Octree;

constexpr char LeavesName[] = "leaves";

/// A grid of bools, active and true in the leaves: OpenVDB's Python module knows no others that are
/// masks. Voxel (i, j, k) of the grid is that of the octree; where 8^3 of them or more are full
/// they are tiles. The transform is the octree's, and the metadata say what it was made of.
VTKSVOOPENVDB_EXPORT openvdb::BoolGrid::Ptr leavesOf(const Octree& octree);

/// What both of an octree's grids have in common: transform, level, source, creator.
void describe(const Octree& octree, openvdb::GridBase& grid);
}

#endif
