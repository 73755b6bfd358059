// How long building takes: each mesh at levels 8, 10 and 12, on one thread and on two. Every octree
// that is timed is opened, compared between the executors, and probed at points of the mesh.
//
//   BenchmarkBuild [--levels 8,10,12] [--repeat n] [mesh.off ...]
#include "svoBuild.h"
#include "svoOctree.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace
{
struct Mesh
{
  std::string name;
  std::vector<glm::dvec3> points;
  std::vector<glm::uvec3> triangles;

  svo::TriangleMesh view() const
  {
    return { points.data(), points.size(), triangles.data(), triangles.size() };
  }
};

/// Polygons become fans. False if the file is no readable OFF mesh.
bool readOFF(const char* path, Mesh& mesh)
{
  std::ifstream file(path);
  std::stringstream text; // without comments
  for (std::string line; std::getline(file, line);)
  {
    text << line.substr(0, line.find('#')) << '\n';
  }
  std::string magic;
  std::size_t points = 0;
  std::size_t faces = 0;
  std::size_t edges = 0;
  text >> magic >> points >> faces >> edges;
  if (!text || magic != "OFF")
  {
    return false;
  }
  mesh.name = std::string(path).substr(std::string(path).find_last_of('/') + 1);
  mesh.points.resize(points);
  for (glm::dvec3& p : mesh.points)
  {
    text >> p.x >> p.y >> p.z;
  }
  std::string line;
  std::getline(text, line);
  for (std::size_t i = 0; i < faces && std::getline(text, line); ++i)
  {
    std::istringstream face(line);
    unsigned count = 0;
    unsigned first = 0;
    unsigned previous = 0;
    face >> count >> first >> previous;
    for (unsigned k = 2, id = 0; k < count && face >> id; ++k, previous = id)
    {
      if (std::max({ first, previous, id }) >= points)
      {
        return false;
      }
      mesh.triangles.push_back({ first, previous, id });
    }
  }
  return !mesh.triangles.empty();
}

Mesh bumpySphere(unsigned slices)
{
  Mesh mesh;
  mesh.name = "bumpy sphere";
  const double pi = std::acos(-1.0);
  for (unsigned i = 0; i <= slices; ++i)
  {
    for (unsigned j = 0; j <= 2 * slices; ++j)
    {
      const double a = pi * i / slices;
      const double b = pi * j / slices;
      const double r = 1.0 + 0.1 * std::sin(9.0 * a) * std::cos(8.0 * b);
      mesh.points.push_back(
        r * glm::dvec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  }
  const unsigned row = 2 * slices + 1;
  for (unsigned i = 0; i < slices; ++i)
  {
    for (unsigned j = 0; j < 2 * slices; ++j)
    {
      const unsigned a = i * row + j;
      mesh.triangles.push_back({ a, a + row, a + 1 });
      mesh.triangles.push_back({ a + row, a + row + 1, a + 1 });
    }
  }
  return mesh;
}

Mesh ground()
{
  return { "ground, 2 triangles",
    { { 0.0, 0.0, 0.1 }, { 1.0, 0.0, 0.2 }, { 1.0, 1.0, 0.3 }, { 0.0, 1.0, 0.2 } },
    { { 0, 1, 2 }, { 0, 2, 3 } } };
}

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

/// Times one mesh at one level; false if a result is wrong.
bool measure(const Mesh& mesh, int level, int repeat)
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
      const std::clock_t processorStart = std::clock();
      result = svo::build(mesh.view(), options);
      const std::chrono::duration<double, std::milli> time =
        std::chrono::steady_clock::now() - start;
      times.push_back(time.count());
      processorTimes.push_back(1e3 * static_cast<double>(std::clock() - processorStart) /
        static_cast<double>(CLOCKS_PER_SEC));
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
  return true;
}
}

int main(int argc, char** argv)
{
  std::vector<int> levels{ 8, 10, 12 };
  int repeat = 5;
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
    else
    {
      Mesh mesh;
      if (!readOFF(argv[i], mesh))
      {
        std::fprintf(stderr, "%s is no OFF mesh\n", argv[i]);
        return 1;
      }
      meshes.push_back(std::move(mesh));
    }
  }
  if (meshes.empty())
  {
    meshes = { bumpySphere(24), bumpySphere(160), ground() };
  }
  std::printf("%-26s %9s %6s %9s %9s %11s %9s %9s %9s\n", "mesh", "triangles", "level", "ms, 1 thr",
    "ms, 2 thr", "voxels", "B/vox", "+ lists", "est. MiB");
  bool good = true;
  for (const Mesh& mesh : meshes)
  {
    for (const int level : levels)
    {
      good = measure(mesh, level, repeat) && good;
    }
  }
  return good ? 0 : 1;
}
