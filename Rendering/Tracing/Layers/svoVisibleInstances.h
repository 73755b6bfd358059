// Which instances a view may see, and how their rays are traced: the cull in front of the layers.
#ifndef svoVisibleInstances_h
#define svoVisibleInstances_h

#include "svoCulling.h"
#include "svoLayerKey.h"
#include "svoLocalView.h"
#include "svoLooseOctree.h"
#include "svoParallel.h"
#include "svoProjection.h"
#include "svoScene.h"
#include "vtkSVOTracingModule.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace svo
{
/// True if an instance is to be traced tile by tile, to its triangles: those that its leaf geometry
/// leaves exact anyway, where that is quicker. Of levels the tiles know nothing: they are more
/// accurate than any. `allTiles`: false of lights' views, where few may be wanted.
VTKSVOTRACING_EXPORT bool worthTiles(
  const Instance& instance, const LocalView& local, const View& view, bool allTiles);

/// The level that rays of an instance really stop at: the last one where they would stop inside of
/// bricks whose triangles they test. They meet the same triangles, but pass bricks by that they
/// have nothing to look for in.
int deepened(const Instance& instance, int level);

/// An instance in a view.
struct VisibleInstance
{
  std::uint32_t index; // in Scene::instances
  std::uint64_t id;    // Instance::id
  const Octree* octree;
  LocalView local; // its rectangle is not empty
  Projection projection;
  LayerKey key;
  bool cuttable; // a ray's hit does not depend on where the ray ends; see endsFreely()
  bool tiles;    // see worthTiles()
  bool ball;     // met as the ball that it stands for, not by its triangles
};

/// The octree level that an instance's rays stop at.
using LevelOf = std::function<int(const Instance&, const LocalView&)>;

/// A node of the tree that a view may see, with several instances in it.
struct SeenNode
{
  static constexpr std::uint32_t None = ~0u;
  /// Instances below it from which on it is worth being asked about.
  static constexpr std::size_t Fewest = 8;

  std::uint32_t parent; // None at the top
  SeenCube cube;        // around all below it
};

/// The instances that a view sees.
struct VisibleSet
{
  std::vector<std::uint32_t> visible; // indices, in the scene's order
  /// The same, front to back by the nodes of the tree; without one, by their nearest corners.
  std::vector<std::uint32_t> order;
  std::vector<SeenNode> nodes;       // those above come first
  std::vector<std::uint32_t> nodeOf; // the lowest around an instance, in the order of `order`
  std::size_t small = 0;             // left out for Culling::leastPixels ...
  double largestSmall = 0.0;         // ... pixels, the longest edge of the rectangle of one
};

/// Finds the instances that `takesPart` and whose cubes lie in the view. All that a ray of the view
/// can hit is among them, but for those that are too small. `takesPart` is asked by several
/// threads.
VTKSVOTRACING_EXPORT void findVisible(const Scene& scene, const View& view, const Culling& culling,
  const std::function<bool(const Instance&)>& takesPart, const ParallelFor& parallelFor,
  VisibleSet& set);

/// One of these, as the view sees it. Its octree is borrowed from the scene. `allTiles`: see
/// worthTiles(); where it is false balls are met as such.
VTKSVOTRACING_EXPORT VisibleInstance seenInstance(
  const Scene& scene, std::uint32_t index, const View& view, const LevelOf& levelOf, bool allTiles);
}

#endif
