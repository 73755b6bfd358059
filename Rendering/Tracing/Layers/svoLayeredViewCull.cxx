// What LayeredView does not look at: tiles that nobody asks for, and nodes of the tree of
// instances, or instances, that others hide.
#include "svoLayeredView.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace svo
{
bool LayeredView::findWindow(std::size_t group, TileScratch& scratch) const
{
  scratch.groupX = GroupTiles * this->Groups.x(group);
  scratch.groupY = GroupTiles * this->Groups.y(group);
  int x0 = GroupTiles, y0 = GroupTiles, x1 = -1, y1 = -1;
  for (int y = 0; y < std::min(GroupTiles, this->Merged.tilesY - scratch.groupY); ++y)
  {
    for (int x = 0; x < std::min(GroupTiles, this->Merged.tilesX - scratch.groupX); ++x)
    {
      const std::size_t tile =
        static_cast<std::size_t>(scratch.groupY + y) * this->Merged.tilesX + scratch.groupX + x;
      if (this->Tiles.isMerged(tile))
      {
        x0 = std::min(x0, x);
        y0 = std::min(y0, y);
        x1 = std::max(x1, x);
        y1 = y;
      }
    }
  }
  const auto pixel = [](int tile) { return static_cast<std::uint8_t>(8 * tile); };
  const auto last = [](int tile) { return static_cast<std::uint8_t>(8 * tile + 7); };
  scratch.window = { pixel(x0), last(x1), pixel(y0), last(y1) };
  return x1 >= 0;
}

bool LayeredView::hides(const TileScratch& scratch, const PixelRect& rect, double depth) const
{
  // As PixelFunctions::key(); a view may count depths from elsewhere than where its rays meet.
  const double at = depth + this->FromEye;
  double key = at - this->Keys.far;
  if (!this->Seen.parallel)
  {
    if (!(at > 0.0))
    {
      return false;
    }
    key = (this->Keys.deep ? -this->Keys.far : key) * this->Keys.far / at;
  }
  return scratch.wants(rect) &&
    scratch.found.group.hides(scratch.windowOf(rect), static_cast<float>(key));
}

bool LayeredView::hidesNode(std::uint32_t node, TileScratch& scratch) const
{
  if (node == SeenNode::None)
  {
    return false;
  }
  std::uint64_t& known = scratch.nodes[node];
  if (known / 2 != scratch.asking)
  {
    const SeenNode& n = this->Visible.nodes[node];
    const double before =
      n.cube.nearest - this->slack(n.cube.nearest, n.cube.farthest - n.cube.nearest);
    const bool hidden =
      this->hidesNode(n.parent, scratch) || this->hides(scratch, n.cube.rect, before);
    known = 2 * scratch.asking + hidden;
  }
  return known % 2 != 0;
}

bool LayeredView::isHidden(const Entry& entry, TileScratch& scratch) const
{
  if (!this->Cull.occlusion || this->Shifted || scratch.found.group.empty())
  {
    return false;
  }
  const auto e = static_cast<std::size_t>(&entry - this->Instances.data());
  return this->hidesNode(this->NodeOf[e], scratch) ||
    this->hides(scratch, entry.local.pixels, this->before(entry));
}

double LayeredView::deepest(const MergedTile& merged) const
{
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  if (!merged.any || !this->Cull.occlusion || this->Shifted)
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
    deepest = std::max(deepest, this->Bases[merged.instance[i]] + merged.t[i]);
  }
  return deepest + this->LargestError;
}
}
