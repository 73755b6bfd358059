#include "performanceCores.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <future>
#include <queue>

namespace performance
{
namespace
{
double milliseconds()
{
  return std::chrono::duration<double, std::milli>(
    std::chrono::steady_clock::now().time_since_epoch())
    .count();
}

double makespan(const std::vector<double>& chunks, int cores, double launch)
{
  std::priority_queue<double, std::vector<double>, std::greater<>> idle; // from when on
  for (int core = 0; core < std::min<int>(cores, static_cast<int>(chunks.size())); ++core)
  {
    idle.push(core * launch);
  }
  double last = 0.0;
  for (const double chunk : chunks)
  {
    const double end = idle.top() + chunk;
    idle.pop();
    idle.push(end);
    last = std::max(last, end);
  }
  return last;
}
}

void RecordedLoops::begin()
{
  this->Loops.clear();
  this->Start = milliseconds();
}

double RecordedLoops::now() const
{
  return milliseconds() - this->Start;
}

svo::ParallelFor RecordedLoops::loops()
{
  return [this](std::size_t begin, std::size_t end, std::size_t grain,
           const std::function<void(std::size_t, std::size_t)>& body)
  {
    if (this->Inside || begin >= end)
    {
      if (begin < end)
      {
        body(begin, end);
      }
      return;
    }
    this->Inside = true;
    Loop loop{ this->now(), 0.0, {} };
    const std::size_t step = std::max<std::size_t>(grain, 1);
    for (std::size_t first = begin; first < end; first += std::min(step, end - first))
    {
      const double start = milliseconds();
      body(first, first + std::min(step, end - first));
      loop.chunks.push_back(milliseconds() - start);
    }
    loop.end = this->now();
    this->Loops.push_back(std::move(loop));
    this->Inside = false;
  };
}

double RecordedLoops::serial(double first, double last) const
{
  double result = last - first;
  for (const Loop& loop : this->Loops)
  {
    if (loop.begin >= first && loop.begin < last)
    {
      result -= loop.end - loop.begin;
    }
  }
  return result;
}

double RecordedLoops::time(double first, double last, int cores, double launch) const
{
  double result = this->serial(first, last);
  for (const Loop& loop : this->Loops)
  {
    if (loop.begin >= first && loop.begin < last)
    {
      result += makespan(loop.chunks, cores, launch);
    }
  }
  return result;
}

double RecordedLoops::launch()
{
  std::vector<double> times;
  for (int i = 0; i < 101; ++i)
  {
    const double start = milliseconds();
    const std::future<void> thread = std::async(std::launch::async, [] {});
    times.push_back(milliseconds() - start);
  }
  std::nth_element(times.begin(), times.begin() + 50, times.end());
  return times[50];
}
}
