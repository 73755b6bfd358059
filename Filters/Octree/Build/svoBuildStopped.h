// What stops a build, and what is said of it.
#ifndef svoBuildStopped_h
#define svoBuildStopped_h

#include "svoBuild.h"

#include <new>
#include <string>

namespace svo
{
/// Thrown, and caught by runBuild(), where a build cannot be, or where progress asks to stop.
struct BuildStopped
{
  BuildStatus status;
  std::string message;
};

/// What stages(result) built, or why nothing was. `lacking`(): what is said of the level where
/// memory runs out.
template <typename Stages, typename Lacking>
BuildResult runBuild(const BuildOptions& options, const Stages& stages, const Lacking& lacking)
{
  BuildResult result;
  const std::string level = std::to_string(options.level);
  try
  {
    if (options.level < 1 || options.level > MaximumLevel)
    {
      throw BuildStopped{ BuildStatus::BadInput, "the level must be 1 to 20, and is " + level };
    }
    stages(result);
    result.status = BuildStatus::Built;
  }
  catch (const BuildStopped& stopped)
  {
    result.status = stopped.status;
    result.message = stopped.message;
  }
  catch (const std::bad_alloc&)
  {
    result.status = BuildStatus::TooLarge;
    result.message = "level " + level + lacking() + "; choose a lower level";
  }
  return result;
}
}

#endif
