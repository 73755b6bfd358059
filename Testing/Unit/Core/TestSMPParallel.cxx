// The executors: every index once, from any thread, beside VTK's own loops.
#include "svoSMPParallel.h"

#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace
{
/// One test for each backend that VTK has here.
struct SMPParallel : ::testing::TestWithParam<const char*>
{
  std::string before = vtkSMPTools::GetBackend();

  void SetUp() override
  {
#ifdef __SANITIZE_THREAD__
    if (std::strcmp(GetParam(), "TBB") == 0)
    {
      GTEST_SKIP() << "ThreadSanitizer cannot see how TBB's threads hand over";
    }
#endif
    if (!vtkSMPTools::SetBackend(GetParam()))
    {
      GTEST_SKIP() << "VTK was built without";
    }
  }
  void TearDown() override
  {
    vtkSMPTools::SetBackend(before.c_str());
  }
};

void expectEachOnce(
  const svo::ParallelFor& parallelFor, std::size_t begin, std::size_t end, std::size_t grain)
{
  std::vector<int> counts(end + 1, 0); // each entry written by one thread
  parallelFor(begin, end, grain,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        ++counts[i];
      }
    });
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    ASSERT_EQ(counts[i], i >= begin && i < end ? 1 : 0) << i;
  }
}
}

TEST_P(SMPParallel, CoverTheRangeOnce)
{
  for (const svo::ParallelFor& parallelFor :
    { svo::smpParallelFor(), svo::backgroundParallelFor() })
  {
    expectEachOnce(parallelFor, 1, 100001, 1000);
    expectEachOnce(parallelFor, 5, 5, 1);
    expectEachOnce(parallelFor, 7, 8, 100);
    expectEachOnce(parallelFor, 0, 17, 1);
    expectEachOnce(parallelFor, 3, 1003, 10);
  }
}

TEST_P(SMPParallel, VTKsSettingsAreLeftAlone)
{
  const int threads = vtkSMPTools::GetEstimatedNumberOfThreads();
  for (const svo::ParallelFor& parallelFor :
    { svo::smpParallelFor(), svo::backgroundParallelFor() })
  {
    std::atomic<int> other{ 0 };
    parallelFor(0, 100, 1,
      [&](std::size_t, std::size_t)
      { other += std::strcmp(vtkSMPTools::GetBackend(), GetParam()) == 0 ? 0 : 1; });
    EXPECT_EQ(other, 0);
    EXPECT_STREQ(vtkSMPTools::GetBackend(), GetParam());
    EXPECT_EQ(vtkSMPTools::GetEstimatedNumberOfThreads(), threads);
  }
}

TEST_P(SMPParallel, ManyThreadsMayLoopBesideVTK)
{
  std::atomic<bool> stop{ false };
  std::vector<std::thread> loops;
  for (int k = 0; k < 3; ++k)
  {
    loops.emplace_back(
      [&stop, k]
      {
        const svo::ParallelFor parallelFor =
          k == 0 ? svo::smpParallelFor() : svo::backgroundParallelFor();
        while (!stop)
        {
          expectEachOnce(parallelFor, 0, 1000, 10);
        }
      });
  }
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(20000);
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    points->SetPoint(i, i, -i, 1.0);
  }
  for (int repeat = 0; repeat < 200; ++repeat)
  {
    points->Modified();
    points->ComputeBounds(); // one of VTK's loops
    ASSERT_EQ(points->GetBounds()[1], 19999.0);
  }
  stop = true;
  for (std::thread& loop : loops)
  {
    loop.join();
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, SMPParallel, ::testing::Values("Sequential", "STDThread", "TBB"),
  [](const auto& info) { return std::string(info.param); });

namespace
{
/// How many threads a loop ran on, the caller's among them.
std::size_t threadsOf(const svo::ParallelFor& parallelFor)
{
  std::mutex mutex;
  std::set<std::thread::id> seen;
  parallelFor(0, 1000, 1,
    [&](std::size_t, std::size_t)
    {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
      const std::lock_guard<std::mutex> lock(mutex);
      seen.insert(std::this_thread::get_id());
    });
  EXPECT_EQ(seen.count(std::this_thread::get_id()), 1u);
  return seen.size();
}
}

TEST(SMPParallelThreads, ThereAreAsManyAsVTKIsTold)
{
  const std::string before = vtkSMPTools::GetBackend();
  ASSERT_TRUE(vtkSMPTools::SetBackend("STDThread"));
  for (const int asked : { 1, 2, 5 })
  {
    vtkSMPTools::Initialize(asked);
    // Or what the machine has.
    const auto threads = static_cast<std::size_t>(vtkSMPTools::GetEstimatedNumberOfThreads());
    EXPECT_EQ(threadsOf(svo::smpParallelFor()), threads);
    EXPECT_EQ(threadsOf(svo::backgroundParallelFor()), std::max<std::size_t>(threads - 1, 1));
  }
  vtkSMPTools::Initialize();
  vtkSMPTools::SetBackend(before.c_str());
}

TEST(SMPParallelThreads, WhereVTKHasOneByDefaultThereIsOneForEachProcessor)
{
  if (std::getenv("VTK_SMP_BACKEND_IN_USE") || std::getenv("VTK_SMP_MAX_THREADS"))
  {
    GTEST_SKIP() << "the environment says something else";
  }
  const std::string before = vtkSMPTools::GetBackend();
  ASSERT_TRUE(vtkSMPTools::SetBackend("Sequential"));
  const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
  EXPECT_EQ(threadsOf(svo::smpParallelFor()), processors);
  EXPECT_EQ(threadsOf(svo::backgroundParallelFor()), std::max<std::size_t>(processors - 1, 1));
  vtkSMPTools::SetBackend(before.c_str());
}

TEST(SMPParallelThreads, WhatABodyThrowsReachesTheCaller)
{
  const std::string before = vtkSMPTools::GetBackend();
  ASSERT_TRUE(vtkSMPTools::SetBackend("STDThread"));
  EXPECT_THROW(svo::smpParallelFor()(0, 100, 1,
                 [](std::size_t first, std::size_t)
                 {
                   if (first == 57)
                   {
                     throw std::runtime_error("57");
                   }
                 }),
    std::runtime_error);
  vtkSMPTools::SetBackend(before.c_str());
}
