// How many cells of each level an octree of a source will have, about, before it is built.
//
// Random descents (Knuth, Estimating the efficiency of backtrack programs, 1975): from a cell go to
// one of the children that the surface may pass through, each as likely as the others. The product
// of how many there were on the way is, on average, the number of cells of that level. Nothing is
// kept of them, and some hundred thousand cubes tell about an octree of billions.
#ifndef svoExpectedCells_h
#define svoExpectedCells_h

#include "svoExecutor.h"
#include "vtkSVOOctreeModule.h"

#include <functional>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
/// How many cells of each level 0..level the surface may pass through, about. A tenth off; too many
/// where a source rules out voxels only at the end, but no more than about twice. `starts`: the
/// cells of `startLevel`; all there are, but for what is beside the box. `mayPass`: whether the
/// surface may pass through a cell of a level. The same numbers for any executor. Takes `share` of
/// the build.
VTKSVOOCTREE_EXPORT std::vector<double> expectedCells(const std::vector<glm::ivec3>& starts,
  int startLevel, int level, const std::function<bool(const glm::ivec3& cell, int level)>& mayPass,
  double share, Executor& executor);
}

#endif
