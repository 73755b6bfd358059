#include "svoCounters.h"

#ifdef VTKSVO_COUNTERS
#include <algorithm>
#include <atomic>
#include <mutex>
#include <vector>

namespace svo
{
namespace
{
class ThreadCounts;

/// All threads that count. Never destroyed: threads may end after everything else.
struct Registry
{
  std::mutex mutex;
  std::vector<const ThreadCounts*> running;
  Counts ended{}; // by threads that are no more
  Counts taken{}; // by takeCounts()

  static Registry& get()
  {
    static Registry* const registry = new Registry;
    return *registry;
  }
};

/// The counts of one thread. Only it writes them, so that adding needs no locked instruction.
class ThreadCounts
{
public:
  ThreadCounts()
  {
    Registry& registry = Registry::get();
    const std::lock_guard<std::mutex> lock(registry.mutex);
    registry.running.push_back(this);
  }
  ~ThreadCounts()
  {
    Registry& registry = Registry::get();
    const std::lock_guard<std::mutex> lock(registry.mutex);
    this->addTo(registry.ended);
    registry.running.erase(std::find(registry.running.begin(), registry.running.end(), this));
  }
  ThreadCounts(const ThreadCounts&) = delete;
  ThreadCounts& operator=(const ThreadCounts&) = delete;

  void add(Counter counter, std::uint64_t amount)
  {
    std::atomic<std::uint64_t>& value = this->Values[static_cast<std::size_t>(counter)];
    value.store(value.load(std::memory_order_relaxed) + amount, std::memory_order_relaxed);
  }
  void addTo(Counts& sum) const
  {
    for (std::size_t i = 0; i < CounterCount; ++i)
    {
      sum[i] += this->Values[i].load(std::memory_order_relaxed);
    }
  }

private:
  std::atomic<std::uint64_t> Values[CounterCount]{};
};
}

void count(Counter counter, std::uint64_t amount)
{
  thread_local ThreadCounts counts;
  counts.add(counter, amount);
}

Counts takeCounts()
{
  Registry& registry = Registry::get();
  const std::lock_guard<std::mutex> lock(registry.mutex);
  Counts sum = registry.ended;
  for (const ThreadCounts* counts : registry.running)
  {
    counts->addTo(sum);
  }
  Counts since{};
  for (std::size_t i = 0; i < CounterCount; ++i)
  {
    since[i] = sum[i] - registry.taken[i];
  }
  registry.taken = sum;
  return since;
}
}
#endif
