// The scenes' objects as the renderer wants them: one mapper a pose, each with its octree.
#ifndef PaperScenes_objects_h
#define PaperScenes_objects_h

#include "meshes.h"

#include <vtkPolyDataMapper.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <string>
#include <vector>

namespace paper
{
struct Object
{
  /// One mapper for each pose; its input carries the pose's octree.
  std::vector<vtkSmartPointer<vtkPolyDataMapper>> poses;
  vtkIdType trianglesShown = 0;    ///< of one pose
  vtkIdType trianglesInMemory = 0; ///< of all poses
  double buildSeconds = 0;         ///< all octrees
  double octreeMebibytes = 0;      ///< all octrees
  vtkIdType voxels = 0;            ///< all octrees
};

struct Objects
{
  Object a;
  Object b;
  Object ground;
};

/**
 * Builds every octree at @a level (voxels an edge = 2^level). @a progress is told the share done, 0
 * to 1. False, and one sentence in @a error, if a mesh has no octree.
 */
bool buildOctrees(const Meshes& meshes, int level, const std::function<void(double)>& progress,
  Objects& objects, std::string& error);
}

#endif
