// What a group of tiles need not look at: nodes of the tree of instances, or instances, that its
// triangles hide.
#ifndef svoGroupOcclusion_h
#define svoGroupOcclusion_h

#include "svoHitOrder.h"
#include "svoTileGroup.h"
#include "svoTracedInstances.h"
#include "svoTriangleGroup.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace svo
{
class GroupOcclusion
{
public:
  /// `on`: Culling::occlusion; else nothing is hidden. The group and the triangles that hide are
  /// those of the moment.
  GroupOcclusion(const TracedInstances& instances, bool on, const TileGroup& group,
    const TriangleGroup& triangles)
    : Instances(instances)
    , Group(group)
    , Triangles(triangles)
    , On(on && !instances.shifted())
    , Nodes(instances.set().nodes.size())
  {
  }
  /// Forgets what other triangles hid. Until then some may only be added.
  void restart() { ++this->Asking; }

  /// True if all that an instance has in the window is hidden.
  bool hides(const TracedInstance& entry);

  /// Linear depth before which an instance has no hits.
  double before(const TracedInstance& entry) const
  {
    return entry.local.base - this->slack(entry.local.base, entry.local.tMax);
  }
  /// Linear depth beyond which nothing of a tile is seen; infinity if there is no such.
  double deepest(const MergedTile& merged) const;
  bool on() const { return this->On; }

private:
  /// True if all that lies in a rectangle of the image beyond a linear depth is hidden.
  bool hides(const PixelRect& rect, double depth) const;
  bool hidesNode(std::uint32_t node);
  /// How much nearer than its nearest corner a hit in what is `deep` from there on may be found,
  /// and by how much that of another instance may be off.
  double slack(double nearest, double deep) const
  {
    return 2e-3 * deep + 1e-5 * (std::abs(nearest) + std::abs(this->Instances.fromEye())) +
      this->Instances.largestError();
  }

  const TracedInstances& Instances;
  const TileGroup& Group;
  const TriangleGroup& Triangles;
  bool On;
  /// By index into VisibleSet::nodes: twice what `Asking` was when it was asked about, and 1 if it
  /// was hidden.
  std::vector<std::uint64_t> Nodes;
  std::uint64_t Asking = 0;
};
}

#endif
