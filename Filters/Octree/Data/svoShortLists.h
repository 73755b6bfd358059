// The highest nodes of an octree that few triangles touch, with their triangles: where a tile of
// rays need not descend any further.
//
// A brick's list is short as long as the triangles are not much smaller than voxels. Mostly they
// are much larger: then many bricks have the same few triangles, and a node far above them has
// hardly more. Such a node settles all that is below it for 64 rays at once (svoIntersectTile.h).
#ifndef svoShortLists_h
#define svoShortLists_h

#include "vtkSVOOctreeModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
class Octree;

struct ShortLists
{
  /// Most triangles of a list. Longer ones test triangles that are not seen; shorter ones descend
  /// to more nodes, and name a triangle more often. With 16 views of 10^5 triangles take 30 %
  /// longer, with 128 lights of small triangles 10 %; ordinary meshes take the same with all three.
  static constexpr std::uint32_t Most = 64;
  /// A node that has no list: its children are to be looked at, or it lies below one that has.
  static constexpr std::uint32_t None = 0xffffffffu;

  /// For each node above the bricks: where its list begins in `words`, or None.
  std::vector<std::uint32_t> begin;
  /// Count, id, id, ... (ascending) of one list after the other.
  std::vector<std::uint32_t> words;

  std::size_t bytes() const { return 4 * (this->begin.size() + this->words.size()); }
};

/// The lists of an octree whose nodes have been checked, of up to `most` triangles, 1..Most.
VTKSVOOCTREE_EXPORT ShortLists makeShortLists(
  const Octree& octree, std::uint32_t most = ShortLists::Most);
}

#endif
