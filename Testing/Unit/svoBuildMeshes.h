// Meshes that own their memory, executors that cut ranges in odd ways, and what the builder's tests
// read off an octree.
#ifndef svoBuildMeshes_h
#define svoBuildMeshes_h

#include "svoBuild.h"
#include "svoMorton.h"
#include "svoOctree.h"
#include "svoTestMesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <thread>
#include <vector>

namespace svotest
{
inline Mesh sphere(int slices, double bumps = 0.0)
{
  Mesh m;
  const double pi = std::acos(-1.0);
  for (int i = 0; i <= slices; ++i)
  {
    for (int j = 0; j <= 2 * slices; ++j)
    {
      const double a = pi * i / slices;
      const double b = pi * j / slices;
      const double r = 1.0 + bumps * std::sin(9.0 * a) * std::cos(8.0 * b);
      m.points.push_back(
        r * glm::dvec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  }
  for (unsigned i = 0; i < unsigned(slices); ++i)
  {
    for (unsigned j = 0; j < unsigned(2 * slices); ++j)
    {
      const unsigned a = i * (2 * slices + 1) + j;
      const unsigned b = a + 2 * slices + 1;
      m.triangles.push_back({ a, b, a + 1 });
      m.triangles.push_back({ b, b + 1, a + 1 });
    }
  }
  return m;
}

/// Triangles of very different sizes; a third of them degenerate.
inline Mesh randomMesh(unsigned seed, int count)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto vector = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  Mesh m;
  for (int i = 0; i < count; ++i)
  {
    const double size = std::exp2(-6.0 * std::abs(unit(random)));
    const glm::dvec3 a = vector();
    glm::dvec3 b = a + size * vector();
    glm::dvec3 c = a + size * vector();
    switch (i % 9)
    {
      case 0: // a segment, but for rounding
        c = a + 0.37 * (b - a);
        break;
      case 1: // in a plane of the axes
        b.z = c.z = a.z;
        break;
      case 2: // a needle
        c = b + 1e-3 * vector();
        break;
      default:
        break;
    }
    m.add(a, b, c);
  }
  return m;
}

/// Runs pieces of changing sizes, out of order, on `threads` threads.
inline svo::ParallelFor raggedExecutor(int threads, unsigned seed)
{
  return [threads, seed](std::size_t begin, std::size_t end, std::size_t grain,
           const std::function<void(std::size_t, std::size_t)>& body)
  {
    std::mt19937 random(seed);
    std::vector<std::pair<std::size_t, std::size_t>> ranges;
    while (begin < end)
    {
      const std::size_t n = std::min(end - begin, 1 + random() % std::max<std::size_t>(grain, 1));
      ranges.push_back({ begin, begin + n });
      begin += n;
    }
    std::shuffle(ranges.begin(), ranges.end(), random);
    std::atomic<std::size_t> next{ 0 };
    std::vector<std::thread> pool;
    for (int i = 0; i < threads; ++i)
    {
      pool.emplace_back(
        [&]
        {
          for (std::size_t k = next++; k < ranges.size(); k = next++)
          {
            body(ranges[k].first, ranges[k].second);
          }
        });
    }
    for (std::thread& thread : pool)
    {
      thread.join();
    }
  };
}

inline svo::BuildResult buildAt(const Mesh& mesh, int level)
{
  svo::BuildOptions options;
  options.level = level;
  return svo::build(mesh.view(), options);
}

/// The opened octree; empty with `error` if any index in it is wrong.
inline svo::Octree openResult(const Mesh& mesh, const svo::BuildResult& result, std::string& error)
{
  if (!result.data)
  {
    error = result.message;
    return {};
  }
  const auto& header = *reinterpret_cast<const svo::Header*>(result.data.get());
  return svo::Octree::open(result.data, result.size,
    svo::makeSurface(
      mesh.view(), std::vector<std::uint32_t>(mesh.triangles.size()), header, svo::serialFor),
    error);
}

/// The brick nodes of an octree, with their places in voxels.
struct Brick
{
  glm::ivec3 corner;
  std::uint32_t node;
};

inline void collectBricks(const svo::Octree& octree, std::uint32_t node, const glm::ivec3& cell,
  int depth, std::vector<Brick>& bricks)
{
  if (depth + 1 == octree.depthCount())
  {
    bricks.push_back({ cell * 4, node });
    return;
  }
  std::uint32_t child = octree.nodes()[node].first;
  for (int i = 0; i < 64; ++i)
  {
    if (octree.nodes()[node].mask >> i & 1)
    {
      collectBricks(octree, child++, cell * 4 + svo::cellOfIndex(i), depth + 1, bricks);
    }
  }
}

inline std::vector<Brick> bricksOf(const svo::Octree& octree)
{
  std::vector<Brick> bricks;
  if (octree && !octree.empty())
  {
    collectBricks(octree, 0, glm::ivec3(0), 0, bricks);
  }
  return bricks;
}
}

#endif
