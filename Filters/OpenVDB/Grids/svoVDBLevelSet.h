// The surface of an octree as a grid: a narrow band of distances.
//
// OpenVDB's mesh conversion measures them, from the mesh's own triangles, in double precision,
// where the octree has triangles; else from what the leaves look like: planes cut off at the faces
// of their voxels, or the faces of voxels.
#ifndef svoVDBLevelSet_h
#define svoVDBLevelSet_h

#include "vtkSVOOpenVDBModule.h"

#include <functional>
#include <string>

#include <openvdb/openvdb.h>

class vtkPolyData;

namespace svo
{
class Octree;

constexpr char LevelSetName[] = "surface";

/// The level set, negative inside; null if it was aborted, or with a `message` that says why there
/// is none. With a grid the message is a warning. `mesh`: carries the octree. `halfWidth`: of the
/// band, in voxels, at least 1. `progress` is called on the calling thread with 0..1, and aborts by
/// returning false.
VTKSVOOPENVDB_EXPORT openvdb::FloatGrid::Ptr levelSetOf(const Octree& octree, vtkPolyData* mesh,
  double halfWidth, const std::function<bool(double)>& progress, std::string& message);
}

#endif
