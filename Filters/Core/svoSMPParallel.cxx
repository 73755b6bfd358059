#include "svoSMPParallel.h"

#include "vtkSMPTools.h"

#include <atomic>
#include <cstdlib>
#include <cstring>

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
  const bool scoped = std::strcmp(vtkSMPTools::GetBackend(), "Sequential") == 0 &&
    std::getenv("VTK_SMP_BACKEND_IN_USE") == nullptr;
  if (!scoped && std::strcmp(vtkSMPTools::GetBackend(), "STDThread") != 0)
  {
    run();
    return;
  }
  // A scope changes global state, and plain threads have a flag that nobody guards: one at a time,
  // and whoever comes second goes on alone.
  static std::atomic<bool> busy{ false };
  if (busy.exchange(true))
  {
    body(begin, end);
    return;
  }
  struct Free
  {
    ~Free() { busy = false; }
  } free;
  if (scoped)
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ 0, "STDThread", false }, run);
  }
  else
  {
    run();
  }
}
}

ParallelFor smpParallelFor()
{
  return forOnVTKThreads;
}
}
