// Runs the stages of a build: in parallel, in batches between which it reports and may be aborted.
#ifndef svoExecutor_h
#define svoExecutor_h

#include "svoBuildStopped.h"
#include "svoParallel.h"

#include <atomic>
#include <cstddef>
#include <functional>
#include <new>

namespace svo
{
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
