#include "svoCounters.h"

#ifdef VTKSVO_COUNTERS
#include <atomic>

namespace svo
{
namespace
{
std::atomic<std::uint64_t> Values[CounterCount]{};
}

void count(Counter counter, std::uint64_t amount)
{
  Values[static_cast<std::size_t>(counter)].fetch_add(amount, std::memory_order_relaxed);
}

Counts takeCounts()
{
  Counts since{};
  for (std::size_t i = 0; i < CounterCount; ++i)
  {
    since[i] = Values[i].exchange(0, std::memory_order_relaxed);
  }
  return since;
}
}
#endif
