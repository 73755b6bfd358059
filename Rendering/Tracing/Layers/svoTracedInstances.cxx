#include "svoTracedInstances.h"

#include "svoLeafError.h"
#include "svoPlaceOnTriangles.h"

#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>

namespace svo
{
void TracedInstances::find(const Scene& scene, const View& view, const Culling& culling,
  const std::function<bool(const Instance&)>& takesPart, const LevelOf& levelOf,
  const ParallelFor& parallelFor)
{
  this->assign(scene, this->Exact);
  this->EntryOf.assign(scene.instances.size(), 0);
  this->Seen = view;
  findVisible(scene, view, culling, takesPart, parallelFor, this->Visible);
  const std::vector<std::uint32_t>& visible = this->Visible.visible;
  this->Entries.resize(visible.size()); // what others have allocated is of use to these
  forEach(parallelFor, visible.size(), 64,
    [&](std::size_t e) { this->place(scene, levelOf, visible[e], e); });
  this->Order.resize(visible.size());
  this->NodeOf.resize(visible.size());
  for (std::size_t k = 0; k < visible.size(); ++k)
  {
    this->Order[k] = this->EntryOf[this->Visible.order[k]];
    this->NodeOf[this->Order[k]] = this->Visible.nodeOf[k];
  }
  this->FromEye = view.parallel
    ? 0.0
    : glm::dot(view.originX, view.directionX) / glm::dot(view.directionX, view.directionX);
  this->LargestError = 0.0;
  for (const TracedInstance& entry : this->Entries)
  {
    this->LargestError = std::max(this->LargestError, this->error(entry.index));
  }
  this->Keys = this->keyBase();
  this->compareOffsets();
}

void TracedInstances::place(
  const Scene& scene, const LevelOf& levelOf, std::uint32_t index, std::size_t e)
{
  this->EntryOf[index] = static_cast<std::uint32_t>(e);
  TracedInstance& entry = this->Entries[e];
  static_cast<VisibleInstance&>(entry) =
    seenInstance(scene, index, this->Seen, levelOf, this->Exact);
  const Instance& instance = scene.instances[index];
  double error = 0.0;
  entry.points = instance.body->points;
  entry.refinement = this->refinementOf(instance, entry, error);
  this->setSeen(index,
    { entry.local.base, error, entry.key.level, entry.key.leafGeometry, this->Exact && entry.tiles,
      entry.local.rect });
  entry.layer = nullptr;
  entry.intervals.tNear.clear();
  if (entry.tiles && !entry.ball)
  {
    entry.functions = PixelFunctions(entry.local, this->Seen);
    entry.sizes = RaySizes(entry.local, this->Seen);
  }
}

DepthRefinement TracedInstances::refinementOf(
  const Instance& instance, const VisibleInstance& visible, double& error) const
{
  const Octree& octree = instance.body->octree;
  const LeafTraits traits = traitsOf(visible.key.leafGeometry);
  if (!this->Exact || traits.shape == CellShape::Cube || !octree.surface() ||
    !instance.body->points || instance.body->points.count != octree.surface()->points.size())
  {
    return DepthRefinement::Never;
  }
  const int level = visible.key.level;
  const bool nodes = stopsAtNodes(instance, level);
  error = edgeOnReach(visible.local);
  if (visible.tiles || meetsTrianglesAlone(instance, visible.key.leafGeometry, level))
  {
    return DepthRefinement::OnTriangle;
  }
  error = std::max(error, (nodes ? MeanPlaneError : CubeError) * worldVoxel(instance, level));
  return DepthRefinement::Traced;
}

KeyBase TracedInstances::keyBase() const
{
  const double infinity = std::numeric_limits<double>::infinity();
  double nearest = infinity, farthest = -infinity;
  for (const TracedInstance& entry : this->Entries)
  {
    if (entry.tiles && !entry.ball && entry.functions.valid)
    {
      const double begin = this->Seen.parallel ? entry.local.base : entry.functions.wBase;
      nearest = std::min(nearest, begin);
      farthest = std::max(farthest, begin + entry.local.tMax);
    }
  }
  if (nearest > farthest)
  {
    return {};
  }
  // Floats, so that they can be handed on without loss.
  return this->Seen.parallel ? KeyBase{ static_cast<float>(0.5 * (nearest + farthest)), false }
                             : KeyBase{ static_cast<float>(farthest), farthest > 2.0 * nearest };
}

void TracedInstances::compareOffsets()
{
  const bool compared = this->Exact && this->Entries.size() > 1;
  this->Sloped = compared &&
    std::any_of(this->Entries.begin(), this->Entries.end(),
      [this](const TracedInstance& entry) { return this->offset(entry.index).factor != 0.0f; });
  this->Shifted = this->Sloped ||
    (compared &&
      std::any_of(this->Entries.begin(), this->Entries.end(),
        [this](const TracedInstance& entry)
        { return this->offset(entry.index) != this->offset(this->Entries[0].index); }));
}
}
