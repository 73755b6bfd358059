// Octrees of many small meshes at once, each on one thread: a loop inside a small build starts more
// threads than it has work for.
#ifndef svoSideBySide_h
#define svoSideBySide_h

#include "svoMeshOctree.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkPolyData;

namespace svo
{
/// Triangles up to which a mesh is small.
constexpr std::size_t SmallMesh = 1 << 14;

struct SideBySide
{
  vtkPolyData* mesh;
  MeshOctreeOptions options;
  Octree octree{};       // empty if the build failed
  std::string message{}; // as of buildMeshOctree()
};

/// Builds all of them, each on one thread; options.parallelFor and options.progress are not asked.
/// The meshes must not change meanwhile.
void buildSideBySide(std::vector<SideBySide>& builds);
}

#endif
