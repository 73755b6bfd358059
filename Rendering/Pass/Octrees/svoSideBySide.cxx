#include "svoSideBySide.h"

#include "svoSMPParallel.h"

namespace svo
{
void buildSideBySide(std::vector<SideBySide>& builds)
{
  smpParallelFor()(0, builds.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        SideBySide& build = builds[i];
        build.options.parallelFor = serialFor;
        build.options.progress = nullptr;
        buildMeshOctree(build.mesh, build.options, build.octree, build.message);
      }
    });
}
}
