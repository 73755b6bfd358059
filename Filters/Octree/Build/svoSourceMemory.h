// What an octree of a source will take, before it is built.
//
// Random descents (Knuth, Estimating the efficiency of backtrack programs, 1975): from a cell go to
// one of the children that the surface may pass through, each as likely as the others. The product
// of how many there were on the way is, on average, the number of cells of that level. Nothing is
// kept of them, and some hundred thousand cubes tell about an octree of billions.
#ifndef svoSourceMemory_h
#define svoSourceMemory_h

#include "svoExecutor.h"
#include "vtkSVOOctreeModule.h"

#include <functional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
/// Peak bytes of a build for each of its bricks and of its voxels.
struct SourceBytes
{
  double brick = 0.0;
  double voxel = 0.0;
};

class VTKSVOOCTREE_EXPORT SourceMemory
{
public:
  /// Whether the surface may pass through a cell of a level.
  using MayPass = std::function<bool(const glm::ivec3& cell, int level)>;

  /// `starts`: the cells of `startLevel` that the surface may pass through; all there are, but for
  /// what is beside the box. The same numbers for any executor. Takes `share` of the build.
  SourceMemory(const std::vector<glm::ivec3>& starts, int startLevel, int level,
    const MayPass& mayPass, const SourceBytes& bytes, double share, Executor& executor);

  /// Peak bytes of a build of a level up to that of the constructor. About a tenth off; too large
  /// where a source rules out voxels only at the end, but no more than about twice.
  double expected(int level) const;

  /// Why a level is too deep for `limit` bytes, and which one is not.
  std::string tooLarge(int level, double limit) const;

private:
  SourceBytes Bytes;
  std::vector<double> Cells; // of each level, about
};
}

#endif
