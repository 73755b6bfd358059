// Runs the stages of a build: in parallel, in batches between which it reports and may be aborted.
// And what stops a build, of which BuildResult tells.
#ifndef svoExecutor_h
#define svoExecutor_h

#include "svoBuild.h"
#include "svoParallel.h"

#include <atomic>
#include <cstddef>
#include <functional>
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

class Executor
{
public:
  Executor(const ParallelFor& parallelFor, const std::function<bool(double)>& progress)
    : Parallel(parallelFor)
    , Progress(progress)
  {
  }

  /// Runs body(i) for each i of [0, count). A batch between two reports is as many items as cost
  /// about `batchCost`, which the caller chooses to be some ten milliseconds; `share` is the
  /// stage's part of the whole build. Memory that runs out on any thread is reported on this one.
  template <typename Cost, typename Body>
  void run(std::size_t count, std::size_t grain, double share, double batchCost, const Cost& cost,
    const Body& body)
  {
    this->runRanges(count, grain, share, batchCost, cost,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t i = first; i < last; ++i)
        {
          body(i);
        }
      });
  }

  /// The same by body(first, last), for ranges of items.
  template <typename Cost, typename Body>
  void runRanges(std::size_t count, std::size_t grain, double share, double batchCost,
    const Cost& cost, const Body& body)
  {
    const double begin = this->Done;
    for (std::size_t first = 0; first < count;)
    {
      std::size_t last = count;
      if (this->Progress)
      {
        double sum = 0.0;
        for (last = first; last < count && sum < batchCost; ++last)
        {
          sum += cost(last);
        }
      }
      this->batch(first, last, grain, body);
      first = last;
      this->Done = begin + share * static_cast<double>(first) / static_cast<double>(count);
      this->report();
    }
    this->Done = begin + share;
  }

  void report() const
  {
    if (this->Progress && !this->Progress(this->Done < 1.0 ? this->Done : 1.0))
    {
      throw BuildStopped{ BuildStatus::Aborted, "the build was aborted" };
    }
  }

private:
  template <typename Body>
  void batch(std::size_t first, std::size_t last, std::size_t grain, const Body& body)
  {
    std::atomic<bool> full{ false };
    this->Parallel(first, last, grain,
      [&](std::size_t from, std::size_t to)
      {
        try
        {
          body(from, to);
        }
        catch (const std::bad_alloc&)
        {
          full = true;
        }
      });
    if (full)
    {
      throw std::bad_alloc();
    }
  }

  const ParallelFor& Parallel;
  const std::function<bool(double)>& Progress;
  double Done = 0.0;
};
}

#endif
