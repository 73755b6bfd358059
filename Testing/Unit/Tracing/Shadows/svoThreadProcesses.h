// Threads in the place of processes.
#ifndef svoThreadProcesses_h
#define svoThreadProcesses_h

#include "svoProcesses.h"

#include <algorithm>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace svotest
{
/// A place where the threads of a group meet and exchange what they have.
class Meeting
{
public:
  explicit Meeting(int count)
    : Count(count)
  {
  }

  /// Everybody's bytes, when all have come.
  std::vector<std::vector<unsigned char>> exchange(int self, std::vector<unsigned char> own)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Given.resize(this->Count);
    this->Given[self] = std::move(own);
    const unsigned long round = this->Round;
    if (++this->Arrived == this->Count)
    {
      this->Taken = std::move(this->Given);
      this->Given.clear();
      this->Arrived = 0;
      ++this->Round;
      this->Changed.notify_all();
    }
    this->Changed.wait(lock, [&] { return this->Round != round; });
    return this->Taken;
  }

private:
  const int Count;
  std::mutex Mutex;
  std::condition_variable Changed;
  std::vector<std::vector<unsigned char>> Given, Taken;
  int Arrived = 0;
  unsigned long Round = 0;
};

class ThreadProcesses : public svo::Processes
{
public:
  ThreadProcesses(Meeting& meeting, int count, int self)
    : Place(meeting)
    , Count(count)
    , Self(self)
  {
  }
  int count() const override { return this->Count; }
  int self() const override { return this->Self; }

  void gather(const std::vector<unsigned char>& own, std::vector<unsigned char>& all,
    std::vector<std::size_t>& begins) override
  {
    all.clear();
    begins.assign(1, 0);
    for (const std::vector<unsigned char>& given : this->Place.exchange(this->Self, own))
    {
      all.insert(all.end(), given.begin(), given.end());
      begins.push_back(all.size());
    }
  }

  void minimum(std::vector<std::uint64_t>& values) override
  {
    std::vector<std::uint64_t> all;
    svo::gatherRecords(*this, values, all);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      values[i % values.size()] = std::min(values[i % values.size()], all[i]);
    }
  }

private:
  Meeting& Place;
  int Count, Self;
};

/// Runs body(processes) once in each of `count` processes.
inline void inProcesses(int count, const std::function<void(svo::Processes&)>& body)
{
  Meeting meeting(count);
  std::vector<std::thread> threads;
  for (int i = 0; i < count; ++i)
  {
    threads.emplace_back(
      [&, i]
      {
        ThreadProcesses processes(meeting, count, i);
        body(processes);
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}
}

#endif
