// What others build of a mesh, where they were found: Embree its hierarchy of boxes, OpenVDB its
// narrow band of distances.
#ifndef svoBuildPeers_h
#define svoBuildPeers_h

#include "svoBenchmarkMesh.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace svobench
{
/// What they are called, and builders that use one thread. OpenVDB's voxels have the edge `voxel`.
/// What a builder needs to copy of a mesh it copies, as ours does when an octree is opened.
std::vector<std::pair<std::string, std::function<void()>>> buildPeers(
  const Mesh& mesh, double voxel);
}

#endif
