#include "svoGroupBalls.h"

#include <algorithm>

namespace svo
{
void GroupBalls::add(const TracedInstance& entry, const TileGroup& group)
{
  Ball ball{ &entry, 0, entry.local.base };
  const GroupWindow w = group.windowOf(entry.local.pixels);
  for (int row = w.y0 / 8; row <= w.y1 / 8; ++row)
  {
    for (int column = w.x0 / 8; column <= w.x1 / 8; ++column)
    {
      ball.tiles |= 1u << (TileGroup::Tiles * row + column);
    }
  }
  this->Balls.push_back(ball);
}

void GroupBalls::sort()
{
  std::sort(this->Balls.begin(), this->Balls.end(),
    [](const Ball& a, const Ball& b) { return a.base < b.base; });
}

void GroupBalls::mergeSeen(const HitOrder& order, MergedTile& merged) const
{
  const TileBalls& seen = this->Seen;
  const bool first = !merged.any;
  for (int i = 0; i < 64; ++i)
  {
    const bool hit = seen.ball[i] != TileBalls::None;
    const auto instance = static_cast<std::uint32_t>(seen.ball[i]);
    const bool before = hit &&
      (first || merged.instance[i] == NoInstance ||
        order.inFront({ instance, 0, seen.depth[i], 0.0, 0.0 },
          { merged.instance[i], merged.primitive[i],
            order.linearDepth(merged.instance[i], merged.t[i]), 0.0, 0.0 }));
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
