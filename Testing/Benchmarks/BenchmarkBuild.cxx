// How long building takes: each mesh at levels 8, 10 and 12, on one thread and on two. Every octree
// that is timed is opened, compared between the executors, and probed at points of the mesh.
//
// Beside it Embree's and OpenVDB's builders, where they were found, on one thread.
//
//   BenchmarkBuild [--levels 8,10,12] [--repeat n] [--json file] [--a dragon.off] [--b sydney.md2]
//                  [mesh ...]
#include "svoBenchmarkMesh.h"
#include "svoBuild.h"
#include "svoBuildPeers.h"
#include "svoOctree.h"
#include "svoResults.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace
{
using svobench::Mesh;

svo::ParallelFor executor(int threads)
{
  if (threads == 1)
  {
    return svo::serialFor;
  }
  return [threads](std::size_t begin, std::size_t end, std::size_t grain,
           const std::function<void(std::size_t, std::size_t)>& body)
  {
    std::atomic<std::size_t> next{ begin };
    const auto work = [&]
    {
      for (std::size_t i = next.fetch_add(grain); i < end; i = next.fetch_add(grain))
      {
        body(i, std::min(i + grain, end));
      }
    };
    std::vector<std::thread> others;
    for (int i = 1; i < threads && end - begin > grain; ++i)
    {
      others.emplace_back(work);
    }
    work();
    for (std::thread& thread : others)
    {
      thread.join();
    }
  };
}

/// Points of the triangles must lie in occupied voxels.
bool isConservative(const Mesh& mesh, const svo::Octree& octree)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const svo::Header& h = octree.header();
  const glm::dvec3 origin(h.origin[0], h.origin[1], h.origin[2]);
  for (int i = 0; i < 50000; ++i)
  {
    const glm::uvec3& t = mesh.triangles[random() % mesh.triangles.size()];
    const double a = std::sqrt(unit(random));
    const double b = unit(random);
    const glm::dvec3 p = mesh.points[t.x] * (1.0 - a) + mesh.points[t.y] * (a * (1.0 - b)) +
      mesh.points[t.z] * (a * b);
    if (!octree.occupied(glm::ivec3(glm::floor((p - origin) / h.voxelSize)), octree.level()))
    {
      return false;
    }
  }
  return true;
}

double processorMs()
{
  return 1e3 * static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// The least processor time of `repeat` runs after one that warms up: nearest to what an idle
/// machine takes.
double leastProcessorMs(int repeat, const std::function<void()>& run)
{
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= repeat; ++i)
  {
    const double begin = processorMs();
    run();
    least = i == 0 ? least : std::min(least, processorMs() - begin);
  }
  return least;
}

void measurePeers(const Mesh& mesh, const svo::Header& octree, int repeat, svobench::Row row,
  svobench::Results& results)
{
  for (const auto& [name, build] : svobench::buildPeers(mesh, octree.voxelSize))
  {
    row["method"] = name;
    row["processorMs"] = leastProcessorMs(repeat, build);
    results.add(row);
  }
}

/// Times one mesh at one level; false if a result is wrong.
bool measure(const Mesh& mesh, int level, int repeat, svobench::Results& results)
{
  svo::BuildResult reference;
  double median[2];
  double processor = 0.0; // of one thread, the least: nearest to what an idle machine takes
  for (const int threads : { 1, 2 })
  {
    svo::BuildOptions options;
    options.level = level;
    options.parallelFor = executor(threads);
    std::vector<double> times;
    std::vector<double> processorTimes;
    svo::BuildResult result;
    for (int i = 0; i <= repeat; ++i) // the first one warms up
    {
      result = {};
      const auto start = std::chrono::steady_clock::now();
      const double processorStart = processorMs();
      result = svo::build(mesh.view(), options);
      const std::chrono::duration<double, std::milli> time =
        std::chrono::steady_clock::now() - start;
      times.push_back(time.count());
      processorTimes.push_back(processorMs() - processorStart);
    }
    std::sort(times.begin() + 1, times.end());
    median[threads - 1] = times[1 + repeat / 2];
    if (result.status != svo::BuildStatus::Built)
    {
      std::printf("%s, level %d: %s\n", mesh.name.c_str(), level, result.message.c_str());
      return true; // refusing is an answer
    }
    if (threads == 1)
    {
      std::sort(processorTimes.begin() + 1, processorTimes.end());
      processor = processorTimes[1];
      reference = result;
    }
    else if (result.size != reference.size ||
      std::memcmp(result.data.get(), reference.data.get(), result.size) != 0)
    {
      std::printf("%s, level %d: two threads build other bytes\n", mesh.name.c_str(), level);
      return false;
    }
  }
  std::string error;
  const svo::Octree octree = svo::Octree::open(reference.data, reference.size, nullptr, error);
  if (!octree || !isConservative(mesh, octree))
  {
    std::printf("%s, level %d: wrong octree %s\n", mesh.name.c_str(), level, error.c_str());
    return false;
  }
  const svo::Header& h = octree.header();
  std::printf("%-26s %9zu %6d %9.1f %9.1f %9.1f %11llu %9.2f %9.2f %9.1f\n", mesh.name.c_str(),
    mesh.triangles.size(), level, median[0], processor, median[1],
    static_cast<unsigned long long>(h.voxelCount),
    static_cast<double>(h.nodeCount * sizeof(svo::Node)) / static_cast<double>(h.voxelCount),
    static_cast<double>(reference.size) / static_cast<double>(h.voxelCount),
    static_cast<double>(svo::estimateBuildMemory(mesh.view(), level)) / (1 << 20));
  svobench::Row row;
  row["experiment"] = "build";
  row["mesh"] = mesh.name;
  row["triangles"] = Json::UInt64(mesh.triangles.size());
  row["level"] = level;
  svobench::Row ours = row;
  ours["method"] = "octree";
  ours["processorMs"] = processor;
  ours["wallMs"] = median[0];
  ours["twoThreadsWallMs"] = median[1];
  ours["octreeMiB"] = static_cast<double>(reference.size) / (1 << 20);
  results.add(ours);
  measurePeers(mesh, h, repeat, row, results);
  return true;
}
}

int main(int argc, char** argv)
{
  std::vector<int> levels{ 8, 10, 12 };
  int repeat = 5;
  std::string json;
  std::vector<Mesh> meshes;
  for (int i = 1; i < argc; ++i)
  {
    if (std::strcmp(argv[i], "--levels") == 0 && i + 1 < argc)
    {
      levels.clear();
      std::istringstream list(argv[++i]);
      for (std::string level; std::getline(list, level, ',');)
      {
        levels.push_back(std::atoi(level.c_str()));
      }
    }
    else if (std::strcmp(argv[i], "--repeat") == 0 && i + 1 < argc)
    {
      repeat = std::max(std::atoi(argv[++i]), 1);
    }
    else if (std::strcmp(argv[i], "--json") == 0 && i + 1 < argc)
    {
      json = argv[++i];
    }
    else
    {
      std::string error;
      if (!svobench::readArgument(argc, argv, i, meshes, error))
      {
        std::fprintf(stderr, "BenchmarkBuild: %s\n", error.c_str());
        return 1;
      }
    }
  }
  if (meshes.empty())
  {
    meshes = { svobench::bumpySphere(24), svobench::bumpySphere(160), svobench::ground() };
  }
  std::printf("%-26s %9s %6s %9s %9s %11s %9s %9s %9s\n", "mesh", "triangles", "level", "ms, 1 thr",
    "ms, 2 thr", "voxels", "B/vox", "+ lists", "est. MiB");
  svobench::Results results({ "method", "processorMs" });
  bool good = true;
  for (const Mesh& mesh : meshes)
  {
    for (const int level : levels)
    {
      good = measure(mesh, level, repeat, results) && good;
    }
  }
  if (!json.empty() && !results.writeJson(json))
  {
    std::fprintf(stderr, "BenchmarkBuild: cannot write %s\n", json.c_str());
    good = false;
  }
  return good ? 0 : 1;
}
