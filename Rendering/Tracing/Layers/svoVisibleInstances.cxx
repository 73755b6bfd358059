#include "svoVisibleInstances.h"

#include "svoLeafError.h"

#include <algorithm>
#include <cassert>

namespace svo
{
namespace
{
/// Area of a triangle in the image, pixels, from which on tracing by tiles is quicker. Small meshes
/// are made ready in caches, triangles of large ones wait for memory; and where few tiles are
/// wanted much is made ready in vain. Measured for 20 000, 60 000 and 200 000 triangles, at as many
/// pixels a triangle as there are in views of 100 to 4000 objects.
double leastTrianglePixels(std::uint64_t triangles, bool allTiles)
{
  constexpr double Most = 0.5, MostAt = 200000.0;
  return std::clamp(static_cast<double>(triangles) * (Most / MostAt), allTiles ? 0.05 : 0.25, Most);
}
}

bool worthTiles(const Instance& instance, const LocalView& local, const View& view, bool allTiles)
{
  const Octree& octree = instance.body->octree;
  if (!traitsOf(instance.body->leafGeometry).exact() || !octree.surface() || local.stretched)
  {
    return false;
  }
  assert(!local.rect.empty() && octree.header().triangleCount > 0);
  const double pixel = worldPixel(view, local.base + 0.5 * local.tMax);
  const double voxel = worldVoxel(instance) / pixel;
  const Header& h = octree.header();
  const double voxels = static_cast<double>(h.voxelCount) / static_cast<double>(h.triangleCount);
  return voxels * voxel * voxel >= leastTrianglePixels(h.triangleCount, allTiles);
}

int deepened(const Instance& instance, int level)
{
  const bool exact =
    traitsOf(instance.body->leafGeometry).exact() && instance.body->octree.surface();
  return (exact || instance.body->octree.hasPlanes()) && !stopsAtNodes(instance, level)
    ? instance.body->octree.level()
    : level;
}

void findVisible(const Scene& scene, const View& view,
  const std::function<bool(const Instance&)>& takesPart, const ParallelFor& parallelFor,
  std::vector<std::uint32_t>& visible)
{
  constexpr std::size_t Together = 256; // instances, whose indices are found by one thread
  const std::size_t count = scene.instances.size();
  visible.resize(count);
  std::vector<std::size_t> found((count + Together - 1) / Together, 0);
  parallelFor(0, found.size(), 4,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t part = first; part < last; ++part)
      {
        std::uint32_t* next = visible.data() + part * Together;
        const std::size_t end = std::min(count, (part + 1) * Together);
        for (std::size_t i = part * Together; i < end; ++i)
        {
          const Instance& instance = scene.instances[i];
          if (instance.body->octree && !instance.body->octree.empty() && takesPart(instance) &&
            !seeOctree(instance.body->octree, instance.localToWorld, view).rect.empty())
          {
            *next++ = static_cast<std::uint32_t>(i);
          }
        }
        found[part] = static_cast<std::size_t>(next - visible.data()) - part * Together;
      }
    });
  auto end = visible.begin();
  for (std::size_t part = 0; part < found.size(); ++part)
  {
    const auto begin = visible.begin() + static_cast<std::ptrdiff_t>(part * Together);
    end = std::copy(begin, begin + static_cast<std::ptrdiff_t>(found[part]), end);
  }
  visible.erase(end, visible.end());
}

VisibleInstance seenInstance(
  const Scene& scene, std::uint32_t index, const View& view, const LevelOf& levelOf, bool allTiles)
{
  const Instance& instance = scene.instances[index];
  const LocalView local = makeLocalView(instance.body->octree, instance.localToWorld, view);
  const bool tiles = worthTiles(instance, local, view, allTiles);
  const int level =
    tiles ? instance.body->octree.level() : deepened(instance, levelOf(instance, local));
  const LeafGeometry geometry = tiles ? LeafGeometry::Triangle : instance.body->leafGeometry;
  return { index, instance.id, &instance.body->octree, local,
    makeProjection(instance.body->octree, instance.localToWorld, view, local.base),
    { instance.body->octree.id(), instance.localToWorld, geometry, level },
    tiles || endsFreely(instance, level), tiles };
}
}
