#include "svoOctreeJobs.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <thread>

namespace svo
{
std::list<OctreeJobs::Job>::iterator OctreeJobs::find(const Key& key)
{
  return std::find_if(this->Jobs.begin(), this->Jobs.end(),
    [&key](const Job& job) { return job.key == key && !job.build.abandoned(); });
}

bool OctreeJobs::ask(const Key& key, vtkPolyData* mesh, const MeshOctreeOptions& options,
  bool mayBegin, Result& result)
{
  const auto job = this->find(key);
  if (job != this->Jobs.end())
  {
    job->asked = true;
    if (!job->build.done())
    {
      return false;
    }
    result = job->build.result();
    this->Jobs.erase(job);
    return true;
  }
  const auto atWork = std::count_if(
    this->Jobs.begin(), this->Jobs.end(), [](const Job& other) { return !other.build.done(); });
  if (mayBegin && atWork < MostAtWork)
  {
    this->Jobs.emplace_back(key, mesh, options);
  }
  return false;
}

void OctreeJobs::wait(
  const Key& key, vtkPolyData* mesh, const MeshOctreeOptions& options, Result& result)
{
  const auto job = this->find(key);
  if (job == this->Jobs.end())
  {
    result.status = buildMeshOctree(mesh, options, result.octree, result.message);
    return;
  }
  while (!job->build.done())
  {
    if (options.progress && !options.progress(job->build.progress()))
    {
      job->build.abandon();
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  result = job->build.result();
  this->Jobs.erase(job);
}

void OctreeJobs::endExecution()
{
  for (auto job = this->Jobs.begin(); job != this->Jobs.end();)
  {
    if (!job->asked)
    {
      job->build.abandon();
    }
    job->asked = false;
    job = job->build.abandoned() && job->build.done() ? this->Jobs.erase(job) : std::next(job);
  }
}

int OctreeJobs::count() const
{
  return static_cast<int>(std::count_if(
    this->Jobs.begin(), this->Jobs.end(), [](const Job& job) { return !job.build.abandoned(); }));
}
}
