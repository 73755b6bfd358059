// The order in which a full cache drops its entries: the one that will be used last goes first.
#ifndef svoReuse_h
#define svoReuse_h

#include "vtkSVOCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace svo
{
/// A cache that drops the least recently used entry keeps nothing of an animation that is longer
/// than the cache: the next pose has always just been dropped. So the history remembers how many
/// uses each entry took to come again, of dropped entries too, and the entry that will be used last
/// goes first (Belady, "A study of replacement algorithms for a virtual-storage computer", 1966,
/// with predicted uses): of a loop, the pose that has just passed. Overdue entries go before all
/// others, so that the next file, or the next part of the animation, is not kept out for long. As
/// long as no entry has come again after it was dropped, the least recently used one goes first.
///
/// Time is counted in uses. Deterministic. Not thread-safe: a cache's own.
class VTKSVOCORE_EXPORT ReuseHistory
{
public:
  using Id = std::uint64_t;

  /// To be called when an entry is used, `kept` or to be made anew; not while it is still in use.
  void comes(Id id, bool kept);

  /// Sorts ids into the order in which to drop them. All must have come.
  void sortForGoing(std::vector<Id>& ids) const;

private:
  struct Thing
  {
    std::uint64_t last = 0;
    std::uint64_t interval = 0; // 0: it came once
  };
  /// The smallest goes first: 0 overdue, 1 never seen again, 2 expected; the last use, or, of what
  /// is expected, the later the less; which it is.
  using Rank = std::tuple<int, std::uint64_t, Id>;
  Rank rankOf(Id id) const;
  void forget();

  static constexpr std::size_t Most = 1 << 16; // things that are remembered
  std::unordered_map<Id, Thing> Things;
  std::uint64_t Now = 0;
  std::uint64_t Loop = 0; // interval of the entry that was missed last; 0: none was
};
}

#endif
