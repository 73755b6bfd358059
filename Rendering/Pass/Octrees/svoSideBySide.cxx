#include "svoSideBySide.h"

#include "svoSMPParallel.h"

namespace svo
{
void buildSideBySide(std::vector<SideBySide>& builds)
{
  // Asking the system for each takes as long as a small build.
  const std::size_t available = availableMemory();
  forEach(smpParallelFor(), builds.size(), 1,
    [&](std::size_t i)
    {
      SideBySide& build = builds[i];
      build.options.parallelFor = serialFor;
      build.options.progress = nullptr;
      build.options.memoryLimit =
        build.options.memoryLimit != 0 ? build.options.memoryLimit : available;
      buildMeshOctree(build.mesh, build.options, build.octree, build.message);
    });
}
}
