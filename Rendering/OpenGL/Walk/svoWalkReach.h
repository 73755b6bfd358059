// How svoOctreeWalk.glsl meets an instance's voxels.
#ifndef svoWalkReach_h
#define svoWalkReach_h

#include "svoInstance.h"

namespace svo
{
/// svoEnds::reach: how far an octree's planes are seen from their voxels' centres, voxels; below 0
/// where voxels are cubes.
inline double walkReach(const Instance& instance)
{
  const Body& body = *instance.body;
  return body.leafGeometry == LeafGeometry::Voxel ? -1.0 : 0.5 + body.octree.planeReach();
}
}

#endif
