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
  const Octree& octree = instance.octree;
  if (!traitsOf(instance.leafGeometry).exact() || !octree.surface() || local.stretched)
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
  const bool exact = traitsOf(instance.leafGeometry).exact() && instance.octree.surface();
  return (exact || instance.octree.hasPlanes()) && !stopsAtNodes(instance, level)
    ? instance.octree.level()
    : level;
}

std::vector<VisibleInstance> findVisible(const Scene& scene, const View& view,
  const std::function<bool(const Instance&)>& takesPart, const LevelOf& levelOf, bool allTiles)
{
  std::vector<VisibleInstance> visible;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    if (!takesPart(instance) || !instance.octree || instance.octree.empty())
    {
      continue;
    }
    const LocalView local = makeLocalView(instance.octree, instance.localToWorld, view);
    if (!local.rect.empty())
    {
      const bool tiles = worthTiles(instance, local, view, allTiles);
      const int level =
        tiles ? instance.octree.level() : deepened(instance, levelOf(instance, local));
      const LeafGeometry geometry = tiles ? LeafGeometry::Triangle : instance.leafGeometry;
      visible.push_back({ i, instance.id, &instance.octree, local,
        makeProjection(instance.octree, instance.localToWorld, view, local.base),
        { instance.octree.id(), instance.localToWorld, geometry, level },
        tiles || endsFreely(instance, level), tiles });
    }
  }
  return visible;
}
}
