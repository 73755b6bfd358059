// The memory that a build says it will need, against what it takes: this executable's operator new
// counts.
#include "svoBuildMeshes.h"

#include <cstdlib>
#include <new>

#include <gtest/gtest.h>
#include <malloc.h>

namespace
{
std::atomic<std::size_t> inUse{ 0 };
std::atomic<std::size_t> peak{ 0 };

void* counted(std::size_t size)
{
  void* p = std::malloc(size);
  if (p == nullptr)
  {
    throw std::bad_alloc();
  }
  const std::size_t now = inUse += malloc_usable_size(p);
  for (std::size_t old = peak; old < now && !peak.compare_exchange_weak(old, now);)
  {
  }
  return p;
}

void uncounted(void* p)
{
  if (p != nullptr)
  {
    inUse -= malloc_usable_size(p);
    std::free(p);
  }
}

/// Peak bytes of one build beyond what was there before.
std::size_t peakOf(const svotest::Mesh& mesh, int level)
{
  const std::size_t before = inUse;
  peak = before;
  const svo::BuildResult result = svotest::buildAt(mesh, level);
  EXPECT_EQ(result.status, svo::BuildStatus::Built) << result.message;
  return peak - before;
}
}

void* operator new(std::size_t size)
{
  return counted(size);
}
void* operator new[](std::size_t size)
{
  return counted(size);
}
void operator delete(void* p) noexcept
{
  uncounted(p);
}
void operator delete[](void* p) noexcept
{
  uncounted(p);
}
void operator delete(void* p, std::size_t) noexcept
{
  uncounted(p);
}
void operator delete[](void* p, std::size_t) noexcept
{
  uncounted(p);
}

TEST(BuildMemory, TheEstimateHoldsWithinAThirdForLargeBuilds)
{
  svotest::Mesh ground;
  ground.add({ 0.0, 0.0, 0.1 }, { 1.0, 0.0, 0.2 }, { 1.0, 1.0, 0.3 });
  ground.add({ 0.0, 0.0, 0.1 }, { 1.0, 1.0, 0.3 }, { 0.0, 1.0, 0.2 });
  struct Case
  {
    const char* name;
    svotest::Mesh mesh;
    int level;
  };
  const Case cases[] = {
    { "few large triangles", ground, 11 },
    { "a sphere, 2 bricks an edge", svotest::sphere(60), 9 },
    { "a bumpy sphere, a brick has several triangles", svotest::sphere(120, 0.2), 7 },
    { "triangles of all sizes, without neighbours", svotest::randomMesh(2, 600), 9 },
  };
  for (const auto& c : cases)
  {
    const auto estimate = static_cast<double>(svo::estimateBuildMemory(c.mesh.view(), c.level));
    const auto taken = static_cast<double>(peakOf(c.mesh, c.level));
    EXPECT_GT(taken, 3e6) << c.name << " is too small to tell";
    EXPECT_LT(taken, estimate * 4.0 / 3.0) << c.name;
    EXPECT_GT(taken, estimate * 2.0 / 3.0) << c.name;
  }
}

TEST(BuildMemory, NothingIsKeptButTheResult)
{
  const svotest::Mesh mesh = svotest::sphere(30);
  svotest::buildAt(mesh, 3); // tables
  const std::size_t before = inUse;
  const svo::BuildResult result = svotest::buildAt(mesh, 8);
  EXPECT_LT(inUse - before, result.size + 4096);
}

TEST(BuildMemory, ARefusedBuildTakesAlmostNothing)
{
  const svotest::Mesh mesh = svotest::sphere(30);
  svo::BuildOptions options;
  options.level = 14;
  options.memoryLimit = std::size_t(64) << 20;
  const std::size_t before = inUse;
  peak = before;
  EXPECT_EQ(svo::build(mesh.view(), options).status, svo::BuildStatus::TooLarge);
  EXPECT_LT(peak - before, std::size_t(1) << 20);
}
