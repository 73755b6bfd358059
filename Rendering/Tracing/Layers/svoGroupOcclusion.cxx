#include "svoGroupOcclusion.h"

#include <algorithm>
#include <limits>

namespace svo
{
bool GroupOcclusion::hides(const PixelRect& rect, double depth) const
{
  // A view may count depths from elsewhere than where its rays meet.
  const double at = depth + this->Instances.fromEye();
  const bool parallel = this->Instances.view().parallel;
  return (parallel || at > 0.0) && this->Group.wants(rect) &&
    this->Triangles.hides(
      this->Group.windowOf(rect), static_cast<float>(this->Instances.keys().key(at, parallel)));
}

bool GroupOcclusion::hidesNode(std::uint32_t node)
{
  if (node == SeenNode::None)
  {
    return false;
  }
  std::uint64_t& known = this->Nodes[node];
  if (known / 2 != this->Asking)
  {
    const SeenNode& n = this->Instances.set().nodes[node];
    const double before =
      n.cube.nearest - this->slack(n.cube.nearest, n.cube.farthest - n.cube.nearest);
    const bool hidden = this->hidesNode(n.parent) || this->hides(n.cube.rect, before);
    known = 2 * this->Asking + hidden;
  }
  return known % 2 != 0;
}

bool GroupOcclusion::hides(const TracedInstance& entry)
{
  if (!this->On || this->Triangles.empty())
  {
    return false;
  }
  return this->hidesNode(this->Instances.nodeOf(this->Instances.indexOf(entry))) ||
    this->hides(entry.local.pixels, this->before(entry));
}

double GroupOcclusion::deepest(const MergedTile& merged) const
{
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  if (!merged.any || !this->On)
  {
    return Infinity;
  }
  double deepest = -Infinity;
  for (int i = 0; i < 64; ++i)
  {
    if (merged.instance[i] == NoInstance)
    {
      return Infinity;
    }
    deepest = std::max(deepest, this->Instances.base(merged.instance[i]) + merged.t[i]);
  }
  return deepest + this->Instances.largestError();
}
}
