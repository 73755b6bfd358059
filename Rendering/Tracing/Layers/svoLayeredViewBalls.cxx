// What LayeredView does for a tile of instances that are met as the balls that they stand for: no
// triangle of theirs is looked at.
#include "svoLayeredView.h"

#include <algorithm>

namespace svo
{
void LayeredView::gatherBalls(TileScratch& scratch) const
{
  std::sort(scratch.balls.begin(), scratch.balls.end(),
    [](const BallEntry& a, const BallEntry& b) { return a.base < b.base; });
  for (BallEntry& ball : scratch.balls)
  {
    const GroupWindow w = scratch.windowOf(ball.entry->local.pixels);
    for (int row = w.y0 / 8; row <= w.y1 / 8; ++row)
    {
      for (int column = w.x0 / 8; column <= w.x1 / 8; ++column)
      {
        ball.tiles |= 1u << (GroupTiles * row + column);
      }
    }
  }
}

void LayeredView::mergeBalls(
  int tileX, int tileY, bool onlyChanged, TileScratch& scratch, MergedTile& merged) const
{
  bool any = false;
  double deepest = scratch.balls.empty() ? 0.0 : this->deepest(merged);
  const int tile = GroupTiles * (tileY - scratch.groupY) + tileX - scratch.groupX;
  for (const BallEntry& ball : scratch.balls)
  {
    if (ball.base > deepest)
    {
      break;
    }
    if (!(ball.tiles >> tile & 1) || (onlyChanged && !this->Tiles.partChanged(ball.entry->index)))
    {
      continue;
    }
    const Entry& entry = *ball.entry;
    if (!any)
    {
      any = true;
      scratch.seenBalls.clear();
    }
    const double last =
      scratch.seenBalls.merge(*entry.octree, entry.local, tileX, tileY, entry.index);
    deepest = this->Cull.occlusion ? std::min(deepest, last) : deepest;
    const auto e = static_cast<std::size_t>(&entry - this->Instances.data());
    scratch.cullStates[e] |= Looked;
    scratch.rays[e] += 64;
  }
  if (!any)
  {
    return;
  }
  const TileBalls& seen = scratch.seenBalls;
  const bool first = !merged.any;
  for (int i = 0; i < 64; ++i)
  {
    const bool hit = seen.ball[i] != TileBalls::None;
    const auto instance = static_cast<std::uint32_t>(seen.ball[i]);
    const bool before = hit &&
      (first || merged.instance[i] == NoInstance ||
        this->inFront({ instance, 0, seen.depth[i], 0.0, 0.0 },
          { merged.instance[i], merged.primitive[i], this->Bases[merged.instance[i]] + merged.t[i],
            0.0, 0.0 }));
    if (first || before)
    {
      merged.t[i] = hit ? static_cast<float>(seen.t[i]) : 0.0f;
      merged.primitive[i] = hit ? 0 : NoPrimitive;
      merged.instance[i] = hit ? instance : NoInstance;
    }
    merged.any = merged.any || hit;
  }
}
}
