// What BenchmarkTrace measures: times, checks, and rows of them.
#ifndef svoTraceReport_h
#define svoTraceReport_h

#include "svoResults.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

namespace svobench
{
/// Median of the thread's own processor time.
template <class F>
double medianSeconds(int repeat, F&& run)
{
  const auto now = []
  {
    std::timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  run(); // warm up
  std::vector<double> times(repeat);
  for (double& t : times)
  {
    const double begin = now();
    run();
    t = now() - begin;
  }
  std::nth_element(times.begin(), times.begin() + repeat / 2, times.end());
  return times[repeat / 2];
}

class TraceReport
{
public:
  /// The file is written at the end; none if there is no path.
  TraceReport(const std::string& instructionSet, const std::string& path)
    : Set(instructionSet)
    , Path(path)
    , Rows({ "camera", "kernel", "raysPerSecond" })
  {
  }
  ~TraceReport()
  {
    if (!this->Path.empty())
    {
      this->Rows.writeJson(this->Path);
    }
  }
  TraceReport(const TraceReport&) = delete;
  void operator=(const TraceReport&) = delete;

  const std::string& instructionSet() const { return this->Set; }

  void add(const std::string& mesh, std::size_t triangles, int level, const std::string& camera,
    const std::string& kernel, double raysPerSecond)
  {
    Row row;
    row["experiment"] = "rays";
    row["mesh"] = mesh;
    row["triangles"] = Json::UInt64(triangles);
    row["level"] = level;
    row["camera"] = camera;
    row["kernel"] = kernel;
    row["instructionSet"] = this->Set;
    row["raysPerSecond"] = raysPerSecond;
    this->Rows.add(row);
  }
  /// Complains if more than `limit` of `rays` differ.
  void check(const char* what, std::size_t different, std::size_t rays, double limit)
  {
    if (static_cast<double>(different) > limit * static_cast<double>(rays))
    {
      std::printf("    FAILED: %s: %zu of %zu rays differ\n", what, different, rays);
      this->Good = false;
    }
  }
  bool good() const { return this->Good; }

private:
  std::string Set;
  std::string Path;
  Results Rows;
  bool Good = true;
};
}

#endif
