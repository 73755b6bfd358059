#include "svoSMPParallel.h"

#include "vtkSMPTools.h"

#include <cstdlib>
#include <cstring>
#include <mutex>

namespace svo
{
namespace
{
void forOnVTKThreads(std::size_t begin, std::size_t end, std::size_t grain,
  const std::function<void(std::size_t, std::size_t)>& body)
{
  if (begin >= end)
  {
    return;
  }
  const auto range = [&body](vtkIdType first, vtkIdType last)
  { body(static_cast<std::size_t>(first), static_cast<std::size_t>(last)); };
  const auto run = [&]
  {
    vtkSMPTools::For(static_cast<vtkIdType>(begin), static_cast<vtkIdType>(end),
      static_cast<vtkIdType>(grain), range);
  };
  if (std::strcmp(vtkSMPTools::GetBackend(), "Sequential") != 0 ||
    std::getenv("VTK_SMP_BACKEND_IN_USE") != nullptr)
  {
    run();
    return;
  }
  // A scope changes global state: one at a time, and whoever comes second goes on alone.
  static std::mutex scope;
  std::unique_lock<std::mutex> lock(scope, std::try_to_lock);
  if (lock)
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ 0, "STDThread", false }, run);
  }
  else
  {
    body(begin, end);
  }
}
}

ParallelFor smpParallelFor()
{
  return forOnVTKThreads;
}
}
