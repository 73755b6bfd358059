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

class Gatherer
{
public:
  Gatherer(const Octree& octree, std::uint32_t most, ShortLists& lists)
    : Of(octree)
    , Longest(most)
    , Bricks(octree.brickBegin())
    , Lists(lists)
  {
  }

  /// The triangles of a node. Lists below a node with too many are written down.
  void gather(std::uint32_t index, Few& few)
  {
    assert(index < this->Of.header().nodeCount);
    if (index >= this->Bricks)
    {
      std::uint32_t count, inlineId;
      const std::uint32_t* list = this->Of.brickTriangles(index, count, inlineId);
      few.count = count <= this->Longest ? count : Few::TooMany;
      std::copy_n(list, std::min(count, this->Longest), few.ids);
      return;
    }
    const Node& node = this->Of.nodes()[index];
    const auto children = static_cast<std::uint32_t>(childCount(node));
    Few below[NodeCells];
    few.count = 0;
    for (std::uint32_t k = 0; k < children; ++k)
    {
      this->gather(node.first + k, below[k]);
      if (below[k].count == Few::TooMany)
      {
        few.count = Few::TooMany;
      }
      few.add(below[k].ids, few.count == Few::TooMany ? 0 : below[k].count, this->Longest);
    }
    if (few.count == Few::TooMany && node.first < this->Bricks)
    {
      for (std::uint32_t k = 0; k < children; ++k)
      {
        this->write(node.first + k, below[k]);
      }
    }
  }

  void write(std::uint32_t index, const Few& few)
  {
    if (few.count != Few::TooMany)
    {
      assert(few.count > 0 && std::is_sorted(few.ids, few.ids + few.count));
      this->Lists.begin[index] = static_cast<std::uint32_t>(this->Lists.words.size());
      this->Lists.words.push_back(few.count);
      this->Lists.words.insert(this->Lists.words.end(), few.ids, few.ids + few.count);
    }
  }

private:
  const Octree& Of;
  std::uint32_t Longest;
  std::uint32_t Bricks;
  ShortLists& Lists;
};
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
  Gatherer gatherer(octree, most, lists);
  Few all;
  gatherer.gather(0, all);
  gatherer.write(0, all);
  lists.words.shrink_to_fit();
  return lists;
}
}
