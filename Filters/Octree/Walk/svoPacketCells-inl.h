// The representative triangles of cells where rays have arrived.
//
// They are looked up in what is kept of earlier rays, cell by cell: what little there is to do is
// scattered loads. What is not known yet is found side by side, and kept.
#if defined(SVO_PACKET_CELLS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_PACKET_CELLS_INL
#undef SVO_PACKET_CELLS_INL
#else
#define SVO_PACKET_CELLS_INL
#endif

#include "svoIntersectBlock.h"
#include "svoPacketLeaf-inl.h"
#include "svoPacketWalk-inl.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

#if SVO_PACKET_LEAVES
HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// Cells in bricks where rays of a block have arrived, in any order.
struct ArrivedCells
{
  // Compressed stores may write a whole vector, of 16 lanes at most.
  static constexpr int Most = RayBlock::Size + 16;
  int count = 0;
  HWY_ALIGN std::int32_t ray[Most];
  HWY_ALIGN float t[Most];
  HWY_ALIGN std::int32_t node[Most];
  HWY_ALIGN std::int32_t before[Most]; // voxels before this one in the brick
  HWY_ALIGN std::int32_t x[Most];
  HWY_ALIGN std::int32_t y[Most];
  HWY_ALIGN std::int32_t z[Most];
};

/// Notes the cells where the lanes of `arrived` are.
HWY_INLINE void note(const Packet& p, Lanes arrived, ArrivedCells& cells)
{
  const LaneCompressor lanes(arrived);
  const int n = cells.count;
  cells.count += static_cast<int>(lanes.size());
  assert(cells.count <= RayBlock::Size);
  lanes.store(p.ray, cells.ray + n);
  lanes.store(p.t, cells.t + n);
  lanes.store(p.node, cells.node + n);
  lanes.store(p.below, cells.before + n);
  lanes.store(p.atX(), cells.x + n);
  lanes.store(p.atY(), cells.y + n);
  lanes.store(p.atZ(), cells.z + n);
}

/// Finds the places in their lists of a vector of cells at `at`, of which there are `count`.
HWY_INLINE void findPlaces(const WalkTarget& target, const ArrivedCells& cells,
  const std::int32_t* at, int count, std::int32_t* places)
{
  const DI di;
  const Lanes lanes = hn::Lt(hn::Iota(di, 0), hn::Set(di, count));
  const I index = hn::IfThenElseZero(lanes, hn::LoadU(di, at));
  const auto of = [&](const std::int32_t* from) { return gather(di, from, index); };
  const Lists lists = findLists(target, of(cells.node), lanes);
  hn::Store(representatives(target, of(cells.x), of(cells.y), of(cells.z), lists), di, places);
}

/// Writes the representative triangle of each cell to found[ray - first].
HWY_INLINE void representatives(const LeafQuery& query, const WalkTarget& target,
  const ArrivedCells& cells, int first, Primitive* found)
{
  const Node* nodes = query.octree.nodes();
  const std::uint32_t* lists = query.octree.lists();
  const int n = static_cast<int>(hn::Lanes(DI()));
  // The loads miss the nearest caches, and each list is known only after its node: all are sent for
  // before the first is waited for.
  std::size_t voxels[RayBlock::Size];
  for (int i = 0; target.kept && i < cells.count; ++i)
  {
    const auto brick = static_cast<std::uint32_t>(cells.node[i]);
    voxels[i] = target.kept->voxel(brick, cells.before[i]);
    target.kept->prefetch(voxels[i]);
    __builtin_prefetch(lists + (nodes[brick].first & ~InlineTriangle));
  }
  HWY_ALIGN std::int32_t unknown[ArrivedCells::Most];
  int unknowns = 0;
  for (int i = 0; i < cells.count; ++i)
  {
    const auto brick = static_cast<std::uint32_t>(cells.node[i]);
    const std::uint32_t reference = nodes[brick].first;
    if (reference & InlineTriangle)
    {
      found[cells.ray[i] - first] = reference & ~InlineTriangle;
      continue;
    }
    const int place = target.kept ? target.kept->place(voxels[i]) : -1;
    if (place < 0)
    {
      unknown[unknowns++] = i;
      continue;
    }
    found[cells.ray[i] - first] = lists[reference + 1 + static_cast<std::uint32_t>(place)];
  }
  for (int begin = 0; begin < unknowns; begin += n)
  {
    HWY_ALIGN std::int32_t places[16];
    const int count = std::min(n, unknowns - begin);
    findPlaces(target, cells, unknown + begin, count, places);
    for (int k = 0; k < count; ++k)
    {
      const int i = unknown[begin + k];
      const auto brick = static_cast<std::uint32_t>(cells.node[i]);
      found[cells.ray[i] - first] =
        lists[nodes[brick].first + 1 + static_cast<std::uint32_t>(places[k])];
      if (target.kept)
      {
        target.kept->keep(voxels[i], places[k]);
      }
    }
  }
}
}
}
HWY_AFTER_NAMESPACE();
#endif

#endif
