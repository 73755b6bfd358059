// The instances in a group of tiles that are met as the balls that they stand for: no triangle of
// theirs is looked at.
#ifndef svoGroupBalls_h
#define svoGroupBalls_h

#include "svoGroupOcclusion.h"
#include "svoHitOrder.h"
#include "svoTileBalls.h"
#include "svoTileGroup.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace svo
{
class GroupBalls
{
public:
  void clear() { this->Balls.clear(); }
  void add(const TracedInstance& entry, const TileGroup& group);
  /// After the last of a group.
  void sort();

  /// Merges what a tile sees of them, front to back; calls count(entry) for those that it looked
  /// at. Only those that `takesPart`, a function of entries.
  template <class TakesPart, class Count>
  void merge(const HitOrder& order, const GroupOcclusion& occlusion, const TileGroup& group,
    int tileX, int tileY, MergedTile& merged, TakesPart&& takesPart, Count&& count)
  {
    bool any = false;
    double deepest = this->Balls.empty() ? 0.0 : occlusion.deepest(merged);
    const int tile = TileGroup::Tiles * (tileY - group.y) + tileX - group.x;
    for (const Ball& ball : this->Balls)
    {
      if (ball.base > deepest)
      {
        break;
      }
      if (!(ball.tiles >> tile & 1) || !takesPart(*ball.entry))
      {
        continue;
      }
      if (!any)
      {
        any = true;
        this->Seen.clear();
      }
      const TracedInstance& entry = *ball.entry;
      const double last = this->Seen.merge(*entry.octree, entry.local, tileX, tileY, entry.index);
      // Balls are met in views that are not exact, where no depths are shifted: on() is the switch.
      deepest = occlusion.on() ? std::min(deepest, last) : deepest;
      count(entry);
    }
    if (any)
    {
      this->mergeSeen(order, merged);
    }
  }

private:
  struct Ball
  {
    const TracedInstance* entry;
    std::uint32_t tiles; // of the group, row by row, a bit for each that may see it
    double base;
  };
  void mergeSeen(const HitOrder& order, MergedTile& merged) const;

  std::vector<Ball> Balls; // front to back
  TileBalls Seen;          // of a tile
};
}

#endif
