#include "svoVisibleInstances.h"

#include "svoLeafError.h"
#include "svoSeenObjects.h"

#include <algorithm>
#include <cassert>
#include <mutex>
#include <numeric>

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

/// What the tree knows of a view: `set.order` is all that may be seen.
void askTree(const LooseOctree& tree, const View& view, VisibleSet& set)
{
  std::uint32_t nodeAt[LooseOctree::MostDepth + 1]; // on the way to the one that is visited
  std::uint32_t current = SeenNode::None;
  eachSeen(
    tree, Frustum(view), VisitOrder::of(view),
    [&](const LooseNode& node)
    {
      current = node.depth > 0 ? nodeAt[node.depth - 1] : SeenNode::None;
      if (node.objects >= SeenNode::Fewest)
      {
        const std::uint32_t parent = current;
        current = static_cast<std::uint32_t>(set.nodes.size());
        set.nodes.push_back(
          { parent, seeCube(node.centre - node.half, 2.0 * node.half, glm::dmat4(1.0), view) });
      }
      nodeAt[node.depth] = current;
    },
    [&](std::uint32_t object)
    {
      set.order.push_back(object);
      set.nodeOf.push_back(current);
    });
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

void findVisible(const Scene& scene, const View& view, const Culling& culling,
  const std::function<bool(const Instance&)>& takesPart, const ParallelFor& parallelFor,
  VisibleSet& set)
{
  set.order.clear();
  set.nodes.clear();
  set.nodeOf.clear();
  if (culling.tree)
  {
    askTree(*culling.tree, view, set);
  }
  else
  {
    set.order.resize(scene.instances.size());
    std::iota(set.order.begin(), set.order.end(), 0u);
    set.nodeOf.assign(set.order.size(), SeenNode::None);
  }
  enum State : std::uint8_t
  {
    Unseen,
    Seen,
    Small
  };
  std::vector<std::uint8_t> states(scene.instances.size(), Unseen);
  std::vector<double> nearest(scene.instances.size());
  std::mutex mutex;
  set.largestSmall = 0.0;
  parallelFor(0, set.order.size(), 256,
    [&](std::size_t first, std::size_t last)
    {
      double largestSmall = 0.0;
      for (std::size_t k = first; k < last; ++k)
      {
        const std::uint32_t i = set.order[k];
        const Instance& instance = scene.instances[i];
        if (!instance.body->octree || instance.body->octree.empty() || !takesPart(instance))
        {
          continue;
        }
        const SeenCube cube = seeOctree(instance.body->octree, instance.localToWorld, view);
        if (cube.rect.empty())
        {
          continue;
        }
        // A pixel on each side is for rounding.
        const double width = std::max(cube.rect.x1 - cube.rect.x0 - 2, 1);
        const double height = std::max(cube.rect.y1 - cube.rect.y0 - 2, 1);
        const bool small = width * height < culling.leastPixels;
        states[i] = small ? Small : Seen;
        largestSmall = small ? std::max({ largestSmall, width, height }) : largestSmall;
        nearest[i] = cube.nearest;
      }
      if (largestSmall > 0.0)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        set.largestSmall = std::max(set.largestSmall, largestSmall);
      }
    });
  set.visible.clear();
  for (std::uint32_t i = 0; i < states.size(); ++i)
  {
    if (states[i] == Seen)
    {
      set.visible.push_back(i);
    }
  }
  set.small = static_cast<std::size_t>(std::count(states.begin(), states.end(), Small));
  std::size_t kept = 0;
  for (std::size_t k = 0; k < set.order.size(); ++k)
  {
    if (states[set.order[k]] == Seen)
    {
      set.order[kept] = set.order[k];
      set.nodeOf[kept++] = set.nodeOf[k];
    }
  }
  set.order.resize(kept);
  set.nodeOf.resize(kept);
  // Those of a node; without a tree, all.
  for (std::size_t first = 0, last; first < kept; first = last)
  {
    last = first + 1;
    while (last < kept && set.nodeOf[last] == set.nodeOf[first])
    {
      ++last;
    }
    std::stable_sort(set.order.begin() + static_cast<std::ptrdiff_t>(first),
      set.order.begin() + static_cast<std::ptrdiff_t>(last),
      [&](std::uint32_t a, std::uint32_t b) { return nearest[a] < nearest[b]; });
  }
}

VisibleInstance seenInstance(
  const Scene& scene, std::uint32_t index, const View& view, const LevelOf& levelOf, bool allTiles)
{
  const Instance& instance = scene.instances[index];
  const LocalView local = makeLocalView(instance.body->octree, instance.localToWorld, view);
  const bool ball = instance.body->ball && !allTiles;
  const bool tiles = ball || worthTiles(instance, local, view, allTiles);
  const int level =
    tiles ? instance.body->octree.level() : deepened(instance, levelOf(instance, local));
  const LeafGeometry geometry = tiles ? LeafGeometry::Triangle : instance.body->leafGeometry;
  return { index, instance.id, &instance.body->octree, local,
    makeProjection(instance.body->octree, instance.localToWorld, view, local.base),
    { instance.body->octree.id(), instance.localToWorld, geometry, level },
    tiles || endsFreely(instance, level), tiles, ball };
}
}
