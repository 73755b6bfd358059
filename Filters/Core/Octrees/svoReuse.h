// When things come again: what a full cache goes by.
#ifndef svoReuse_h
#define svoReuse_h

#include "vtkSVOCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace svo
{
/// A cache that lets go of what was used longest ago keeps nothing of an animation that is longer
/// than itself: what comes next has always just gone. So it is remembered how long each thing took
/// to come again, also of things that are gone, and what will be needed last goes first: of a
/// loop, what has just passed. What did not come when it was due is forgotten about, so that the
/// next file, or the next part of the animation, is not kept out for long. As long as nothing has
/// come again after it was let go, the least recently used goes first.
///
/// Time is counted in uses. Deterministic. Not thread-safe: a cache's own.
class VTKSVOCORE_EXPORT ReuseHistory
{
public:
  using Id = std::uint64_t;

  /// To be called when a thing comes, `kept` or to be made anew; not for what is still in use.
  void comes(Id id, bool kept);

  /// Puts ids into the order in which to let go of them. All must have come.
  void sortForGoing(std::vector<Id>& ids) const;

private:
  struct Thing
  {
    std::uint64_t last = 0;
    std::uint64_t interval = 0; // 0: it came once
  };
  struct Rank;
  Rank rankOf(Id id) const;
  void forget();

  static constexpr std::size_t Most = 1 << 16; // things that are remembered
  std::unordered_map<Id, Thing> Things;
  std::uint64_t Now = 0;
  std::uint64_t Loop = 0; // interval of what was missed last; 0: nothing was
};
}

#endif
