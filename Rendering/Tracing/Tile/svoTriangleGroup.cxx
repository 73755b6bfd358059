// Lists of triangles are read front to back, a hundred triangles at a time. What is made ready may
// hide nodes that come later: where triangles are small, those are most of what lies behind a
// surface, and their triangles are never looked at.
#include "svoTriangleGroup.h"

#include "svoCrossingTriangle.h"

#include <algorithm>
#include <cassert>

namespace svo
{
namespace
{
/// Pixel i of a tile among those of the group.
int groupPixel(int column, int row, int i)
{
  return GroupView::Pixels * (8 * row + (i >> 3)) + 8 * column + (i & 7);
}
}

void TriangleGroup::Slots::makeRoom(std::size_t size)
{
  if (this->id.size() >= size)
  {
    return;
  }
  size += size / 2;
  for (auto* edge : { &this->ex, &this->ey, &this->ec })
  {
    for (std::vector<float>& array : *edge)
    {
      array.resize(size);
    }
  }
  for (auto* array : { &this->kx, &this->ky, &this->kc, &this->slack, &this->kNear, &this->kFar })
  {
    array->resize(size);
  }
  for (auto* array : { &this->tiles, &this->x0, &this->x1, &this->y0, &this->y1, &this->flags })
  {
    array->resize(size);
  }
  this->crossing.resize(size);
  this->id.resize(size);
  this->owner.resize(size);
}

bool TriangleGroup::add(const Octree& octree, const std::vector<GroupNode>& nodes,
  const GroupView& view, SmallTriangles small, std::uint32_t owner)
{
  assert(octree.surface() != nullptr);
  const Surface& surface = *octree.surface();
  assert(surface.triangles.size() < (1u << 29) && surface.points.size() < (1u << 29));
  this->Known.resize(std::max(this->Known.size(), surface.triangles.size() / 64 + 1), 0);
  this->Count = 0;
  std::size_t ready = 0;
  bool good = true;
  const auto readOn = [&](std::size_t fewest)
  {
    this->readLists(surface);
    if (this->Count - ready >= fewest)
    {
      good = this->makeReady(surface, view, small, owner, ready);
      ready = this->Count;
    }
    return good;
  };
  for (const GroupNode& node : nodes)
  {
    if (this->hides(node, view))
    {
      continue;
    }
    findList(octree, node.node, this->Lists[this->ListCount++]);
    // As soon as there are some, since they may hide what comes later.
    if (this->ListCount == ListsAtOnce && !readOn(TrianglesAtOnce))
    {
      break;
    }
  }
  good = good && readOn(1);
  for (std::size_t k = 0; k < this->Count; ++k)
  {
    this->Known[this->Ids[k] / 64] = 0;
  }
  return good;
}

bool TriangleGroup::hides(const GroupNode& node, const GroupView& view) const
{
  const float t = node.tNear - view.behind;
  const float w = view.wOfT[0] * t + view.wOfT[1];
  const float key = view.scale * (view.kOfT[0] * t + view.kOfT[1]) / w;
  return w > 0.0f && this->hides(node.box, key);
}

void TriangleGroup::findCover(std::size_t first)
{
  constexpr int Last = GroupView::Pixels - 1;
  constexpr float Corner = 0.5f * Last; // from the middle
  const Slots& s = this->Arrays;
  for (std::size_t slot = first; slot < s.count; ++slot)
  {
    if (s.x0[slot] > 0 || s.y0[slot] > 0 || s.x1[slot] < Last || s.y1[slot] < Last ||
      (s.flags[slot] & (Thin | Unsure | Clipped)) != 0)
    {
      continue;
    }
    bool inside = true;
    float key = -std::numeric_limits<float>::infinity();
    for (int corner = 0; corner < 4; ++corner)
    {
      const float x = corner & 1 ? Corner : -Corner, y = corner & 2 ? Corner : -Corner;
      for (std::size_t e = 0; e < 3; ++e)
      {
        inside = inside && s.ex[e][slot] * x + s.ey[e][slot] * y + s.ec[e][slot] > 2.0f;
      }
      key = std::max(key, s.kx[slot] * x + s.ky[slot] * y + s.kc[slot]);
    }
    if (inside)
    {
      this->Cover = std::min(this->Cover, key + 2.0f * s.slack[slot]);
    }
  }
}

void TriangleGroup::findList(const Octree& octree, std::uint32_t node, NodeList& list)
{
  const ShortLists& lists = octree.shortLists();
  list.counted = node < octree.brickBegin();
  if (list.counted)
  {
    assert(lists.begin[node] != ShortLists::None);
    list.ids = lists.words.data() + lists.begin[node] + 1;
  }
  else
  {
    list.ids = octree.brickTriangles(node, list.count, list.inlineId);
  }
  __builtin_prefetch(list.ids);
}

void TriangleGroup::readLists(const Surface& surface)
{
  constexpr std::size_t Room = 16; // behind the last, a vector of any instruction set
  std::size_t count = this->Count;
  for (std::size_t l = 0; l < this->ListCount; ++l)
  {
    const NodeList& node = this->Lists[l];
    const std::uint32_t* list = node.ids;
    const std::uint32_t listed = node.counted ? list[-1] : node.count;
    if (this->Ids.size() < count + listed + Room)
    {
      this->Ids.resize(2 * (count + listed + Room));
    }
    std::uint32_t* ids = this->Ids.data();
    std::uint64_t* known = this->Known.data();
    for (std::uint32_t k = 0; k < listed; ++k)
    {
      // Without a branch, which nobody could foretell.
      const std::uint32_t id = list[k];
      assert(id < surface.triangles.size());
      const std::uint64_t word = known[id / 64];
      known[id / 64] = word | std::uint64_t(1) << id % 64;
      __builtin_prefetch(&surface.triangles[id]);
      ids[count] = id;
      count += ~(word >> id % 64) & 1;
    }
  }
  this->ListCount = 0;
  this->Count = count;
}

bool TriangleGroup::makeReady(const Surface& surface, const GroupView& view, SmallTriangles small,
  std::uint32_t owner, std::size_t first)
{
  constexpr std::size_t Room = 16;
  std::fill_n(this->Ids.begin() + static_cast<std::ptrdiff_t>(this->Count), Room, 0u);
  Slots& slots = this->Arrays;
  const std::size_t before = slots.count;
  project(surface, this->Ids.data() + first, this->Count - first, view, owner, slots,
    small == SmallTriangles::AsPoints ? &this->Small.points() : nullptr);
  for (std::size_t k = 0; k < slots.crossingCount; ++k)
  {
    const auto id = static_cast<std::uint32_t>(slots.crossing[k]);
    if (!addCrossing(surface, id, view, owner, slots))
    {
      return false;
    }
  }
  this->findCover(before);
  this->Small.merge(owner);
  return true;
}

bool TriangleGroup::steep(int column, int row, int pixel, const NearestTriangles& found) const
{
  const std::int32_t slot = found.slot[pixel];
  assert(slot != NearestTriangles::None);
  return slot == NearestTriangles::Small
    ? (this->Small.triangle()[groupPixel(column, row, pixel)] & SeenPoints::Steep) != 0
    : (this->Arrays.flags[static_cast<std::size_t>(slot)] & Steep) != 0;
}

void TriangleGroup::findCandidates(
  int column, int row, std::uint64_t rays, NearestTriangles& found) const
{
  found.candidates.clear();
  if (rays == 0)
  {
    return;
  }
  for (const SeenTriangle& seen : found.seen)
  {
    if (seen.pixels & rays)
    {
      found.candidates.push_back(
        { this->triangle(seen.slot), this->owner(seen.slot), seen.pixels });
    }
  }
  const SeenPoints& points = this->Small.points();
  for (; rays != 0; rays &= rays - 1)
  {
    const int i = __builtin_ctzll(rays);
    for (std::int32_t k = this->Small.firstPoint(groupPixel(column, row, i));
         k != GroupPixels::NoPoint; k = this->Small.nextPoint(k))
    {
      found.candidates.push_back(
        { static_cast<std::uint32_t>(points.triangle[static_cast<std::size_t>(k)]) &
            ~SeenPoints::Steep,
          this->Small.ownerOf(k), std::uint64_t(1) << i });
    }
  }
}
}
