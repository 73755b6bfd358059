#include "svoSMPParallel.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

namespace svo
{
namespace
{
using Body = std::function<void(std::size_t, std::size_t)>;

bool backendIs(const char* name)
{
  return std::strcmp(vtkSMPTools::GetBackend(), name) == 0;
}

/// Where VTK's backend is Sequential; the environment is read once, as VTK does it.
std::size_t threadsInsteadOfOne()
{
  static const std::size_t threads = []
  {
    const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
    if (std::getenv("VTK_SMP_BACKEND_IN_USE"))
    {
      return std::size_t(1); // somebody wants it so
    }
    const char* most = std::getenv("VTK_SMP_MAX_THREADS");
    const int asked = most ? std::atoi(most) : 0;
    return asked > 0 ? std::min<std::size_t>(asked, processors) : processors;
  }();
  return threads;
}

std::size_t plainThreads()
{
  return backendIs("Sequential")
    ? threadsInsteadOfOne()
    : static_cast<std::size_t>(std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads()));
}

/// The caller's thread and others take chunks until there are no more.
void forOnPlainThreads(
  std::size_t threads, std::size_t begin, std::size_t end, std::size_t grain, const Body& body)
{
  if (begin >= end)
  {
    return;
  }
  const std::size_t chunk = std::max<std::size_t>(grain, 1);
  const std::size_t chunks = (end - begin - 1) / chunk + 1;
  if (threads <= 1 || chunks == 1)
  {
    body(begin, end);
    return;
  }
  std::atomic<std::size_t> next{ 0 };
  const auto work = [&]
  {
    for (std::size_t i = next++; i < chunks; i = next++)
    {
      const std::size_t first = begin + i * chunk;
      body(first, i + 1 == chunks ? end : first + chunk);
    }
  };
  std::vector<std::future<void>> others; // waits for them whatever happens
  try
  {
    for (std::size_t k = 1; k < std::min(threads, chunks); ++k)
    {
      others.push_back(std::async(std::launch::async, work));
    }
  }
  catch (const std::system_error&)
  {
    // No more threads to be had: those that there are do it.
  }
  work();
  for (std::future<void>& other : others)
  {
    other.get();
  }
}

void forOnVTKThreads(std::size_t begin, std::size_t end, std::size_t grain, const Body& body)
{
  if (backendIs("Sequential") || backendIs("STDThread"))
  {
    forOnPlainThreads(plainThreads(), begin, end, grain, body);
  }
  else if (begin < end)
  {
    vtkSMPTools::For(static_cast<vtkIdType>(begin), static_cast<vtkIdType>(end),
      static_cast<vtkIdType>(grain),
      [&body](vtkIdType first, vtkIdType last)
      { body(static_cast<std::size_t>(first), static_cast<std::size_t>(last)); });
  }
}

void forInBackground(std::size_t begin, std::size_t end, std::size_t grain, const Body& body)
{
  forOnPlainThreads(plainThreads() - 1, begin, end, grain, body);
}
}

ParallelFor smpParallelFor()
{
  return forOnVTKThreads;
}

ParallelFor backgroundParallelFor()
{
  return forInBackground;
}
}
