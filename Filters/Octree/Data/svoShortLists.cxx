#include "svoShortLists.h"

#include "svoNode.h"
#include "svoOctree.h"

#include <algorithm>
#include <cassert>

namespace svo
{
namespace
{
/// A list that is still being made, in ascending order; `count` of TooMany: too long.
struct Few
{
  static constexpr std::uint32_t TooMany = ShortLists::Most + 1;
  std::uint32_t count = 0;
  std::uint32_t ids[ShortLists::Most];

  void add(const std::uint32_t* list, std::uint32_t n, std::uint32_t most)
  {
    if (this->count == n && std::equal(list, list + n, this->ids)) // as in most bricks
    {
      return;
    }
    for (std::uint32_t k = 0; k < n && this->count < TooMany; ++k)
    {
      std::uint32_t* end = this->ids + this->count;
      std::uint32_t* place = std::lower_bound(this->ids, end, list[k]);
      if (place != end && *place == list[k])
      {
        continue;
      }
      if (this->count == most)
      {
        this->count = TooMany;
        return;
      }
      std::copy_backward(place, end, end + 1);
      *place = list[k];
      ++this->count;
    }
  }
};

void writeList(std::uint32_t index, const Few& few, ShortLists& lists)
{
  if (few.count != Few::TooMany)
  {
    assert(few.count > 0 && std::is_sorted(few.ids, few.ids + few.count));
    lists.begin[index] = static_cast<std::uint32_t>(lists.words.size());
    lists.words.push_back(few.count);
    lists.words.insert(lists.words.end(), few.ids, few.ids + few.count);
  }
}

/// The triangles of a node. Lists below a node with too many are written down.
void gather(
  const Octree& octree, std::uint32_t most, std::uint32_t index, Few& few, ShortLists& lists)
{
  assert(index < octree.header().nodeCount);
  if (index >= octree.brickBegin())
  {
    std::uint32_t count, inlineId;
    const std::uint32_t* list = octree.brickTriangles(index, count, inlineId);
    few.count = count <= most ? count : Few::TooMany;
    std::copy_n(list, std::min(count, most), few.ids);
    return;
  }
  const Node& node = octree.nodes()[index];
  const auto children = static_cast<std::uint32_t>(childCount(node));
  Few below[NodeCells];
  few.count = 0;
  for (std::uint32_t k = 0; k < children; ++k)
  {
    gather(octree, most, node.first + k, below[k], lists);
    if (below[k].count == Few::TooMany)
    {
      few.count = Few::TooMany;
    }
    few.add(below[k].ids, few.count == Few::TooMany ? 0 : below[k].count, most);
  }
  if (few.count == Few::TooMany && node.first < octree.brickBegin())
  {
    for (std::uint32_t k = 0; k < children; ++k)
    {
      writeList(node.first + k, below[k], lists);
    }
  }
}
}

ShortLists makeShortLists(const Octree& octree, std::uint32_t most)
{
  ShortLists lists;
  const std::uint32_t bricks = octree.brickBegin();
  lists.begin.assign(bricks, ShortLists::None);
  if (octree.empty() || bricks == 0)
  {
    return lists;
  }
  assert(most >= 1 && most <= ShortLists::Most);
  Few all;
  gather(octree, most, 0, all, lists);
  writeList(0, all, lists);
  lists.words.shrink_to_fit();
  return lists;
}
}
