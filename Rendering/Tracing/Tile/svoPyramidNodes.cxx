#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoPyramidNodes.cxx"
#include <hwy/foreach_target.h>

#include "svoCounters.h"
#include "svoGroupView.h"
#include "svoLaneBits-inl.h"
#include "svoMorton.h"
#include "svoNode.h"
#include "svoPyramidNodes.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <type_traits>

#include <hwy/highway.h>

#ifndef SVO_PYRAMID_NODES_ONCE
#define SVO_PYRAMID_NODES_ONCE
namespace svo
{
/// Lower corners of a node's cells, for a node of edge 1, in the order of cellIndex().
struct CellOffsets
{
  alignas(64) float x[NodeCells], y[NodeCells], z[NodeCells];

  CellOffsets()
  {
    for (int i = 0; i < NodeCells; ++i)
    {
      const glm::ivec3 cell = cellOfIndex(i);
      x[i] = static_cast<float>(cell.x) / NodeEdge;
      y[i] = static_cast<float>(cell.y) / NodeEdge;
      z[i] = static_cast<float>(cell.z) / NodeEdge;
    }
  }
};
}
#endif

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// What linear functions grow by from the lower corner of a node, for a node of edge 1.
struct ChildTables
{
  HWY_ALIGN float most[4][NodeCells]; // to the best corner of child i, of each side of the pyramid
  HWY_ALIGN float near[NodeCells];    // to the least t of child i
  HWY_ALIGN float
    least[NodeCells]; // to the least w of child i, in pixels' widths of the group's sides
  float toCorner[6];  // from there to the child's lower corner; 4: of t; 5: of w
  float deep;         // from the least to the greatest t of a child
};

HWY_INLINE void fillTable(
  const glm::dvec4& f, double start, const float* x, const float* y, const float* z, float* table)
{
  const DF df;
  const F fx = hn::Set(df, static_cast<float>(f.x));
  const F fy = hn::Set(df, static_cast<float>(f.y));
  const F fz = hn::Set(df, static_cast<float>(f.z));
  const F begin = hn::Set(df, static_cast<float>(start));
  for (std::size_t i = 0; i < NodeCells; i += hn::Lanes(df))
  {
    const F xy = hn::MulAdd(fx, hn::Load(df, x + i), hn::Mul(fy, hn::Load(df, y + i)));
    hn::Store(hn::Add(hn::MulAdd(fz, hn::Load(df, z + i), xy), begin), df, table + i);
  }
}

/// A node that is still to be opened.
struct OpenNode
{
  std::uint32_t node;
  float size;     // edge, octree coordinates
  float value[6]; // of the sides, t and w at its lower corner, rounding allowed for
};

/// The pixels of a group's window whose centres cells may cover: x0, x1, y0 and y1, a byte each.
/// `most`: the greatest values of the group's sides, which are w times the distance in pixels.
HWY_INLINE I pixelsOf(const F* most, F leastW, const GroupWindow& window, hn::Mask<DF>& any)
{
  // A pixel lies at x / w from one side and at Pixels - x / w from the other one.
  const DF df;
  const DI di;
  constexpr float Slack = 0.01f; // besides what the sides allow for
  const auto known = hn::Gt(leastW, hn::Zero(df));
  const F inverse = hn::Div(hn::Set(df, 1.0f), leastW);
  const F toLast = hn::Set(df, Slack - 0.5f);
  const F toFirst = hn::Set(df, GroupView::Pixels - 0.5f - Slack);
  const auto lastOf = [&](F greatest, float begin, float end)
  {
    const F pixel = hn::Floor(hn::MulAdd(greatest, inverse, toLast));
    const F last = hn::Set(df, end);
    return hn::IfThenElse(known, hn::Max(hn::Min(pixel, last), hn::Set(df, begin - 1.0f)), last);
  };
  const auto firstOf = [&](F greatest, float begin, float end)
  {
    const F pixel = hn::Ceil(hn::NegMulAdd(greatest, inverse, toFirst));
    const F first = hn::Set(df, begin);
    return hn::IfThenElse(known, hn::Min(hn::Max(pixel, first), hn::Set(df, end + 1.0f)), first);
  };
  const F x1 = lastOf(most[0], window.x0, window.x1), x0 = firstOf(most[1], window.x0, window.x1);
  const F y1 = lastOf(most[2], window.y0, window.y1), y0 = firstOf(most[3], window.y0, window.y1);
  any = hn::And(any, hn::And(hn::Le(x0, x1), hn::Le(y0, y1)));
  const auto byte = [&](F v, int k) { return hn::ShiftLeftSame(hn::ConvertTo(di, v), k); };
  return hn::Or(hn::Or(byte(x0, 0), byte(x1, 8)), hn::Or(byte(y0, 16), byte(y1, 24)));
}

/// Bits where bit i of `bits` is bit i ^ flip.
inline std::uint64_t flipped(std::uint64_t bits, int flip)
{
  constexpr std::uint64_t Even[6] = { 0x5555555555555555u, 0x3333333333333333u, 0x0f0f0f0f0f0f0f0fu,
    0x00ff00ff00ff00ffu, 0x0000ffff0000ffffu, 0x00000000ffffffffu };
  for (int k = 0; k < 3 * NodeLevels; ++k)
  {
    if (flip >> k & 1)
    {
      const int by = 1 << k;
      bits = (bits & Even[k]) << by | (bits >> by & Even[k]);
    }
  }
  return bits;
}

/// Found: TileNode or GroupNode.
template <class Found>
HWY_INLINE bool findNodes(const Octree& octree, const CellOffsets& offsets,
  const TilePyramid& pyramid, float tMin, float tMax, std::size_t most, const GroupWindow& window,
  std::vector<Found>& nodes)
{
  constexpr bool Group = std::is_same<Found, GroupNode>::value;
  assert(octree.surface() != nullptr && octree.shortLists().begin.size() == octree.brickBegin());
  const DF df;
  ChildTables tables;
  OpenNode open[NodeCells * MaximumDepths];
  int count = 1;
  open[0].node = 0;
  open[0].size = 1.0f;
  constexpr double Cell = 1.0 / NodeEdge;
  const auto lowest = [](const glm::dvec4& f)
  { return Cell * (std::min(f.x, 0.0) + std::min(f.y, 0.0) + std::min(f.z, 0.0)); };
  const auto highest = [](const glm::dvec4& f)
  { return Cell * (std::max(f.x, 0.0) + std::max(f.y, 0.0) + std::max(f.z, 0.0)); };
  // `start`: from a child's lower corner to where it is asked; rounding makes it `wider`, 1 or -1.
  const auto begin = [&](int k, const glm::dvec4& f, double start, double wider, float* table)
  {
    fillTable(f, start, offsets.x, offsets.y, offsets.z, table);
    tables.toCorner[k] = static_cast<float>(-start);
    open[0].value[k] = static_cast<float>(f.x + f.y + f.z + f.w + wider * roundingSlack(f));
  };
  for (int k = 0; k < 4; ++k)
  {
    begin(k, pyramid.side[k], highest(pyramid.side[k]), 1.0, tables.most[k]);
  }
  begin(4, pyramid.t, lowest(pyramid.t), -1.0, tables.near);
  tables.deep = static_cast<float>(highest(pyramid.t) - lowest(pyramid.t));
  if (Group)
  {
    const glm::dvec4 w = (pyramid.side[0] + pyramid.side[1]) / double(GroupView::Pixels);
    begin(5, w, lowest(w), -1.0, tables.least);
  }
  const float tFrom = static_cast<float>(tMin - 2.0 * roundingSlack(pyramid.t));
  const Node* all = octree.nodes();
  const ShortLists& lists = octree.shortLists();
  const std::uint32_t bricks = octree.brickBegin();
  nodes.clear();
  if (bricks == 0 || lists.begin[0] != ShortLists::None)
  {
    Found root{};
    root.tNear = -std::numeric_limits<float>::infinity();
    if constexpr (Group)
    {
      root.box = window;
    }
    nodes.push_back(root);
    return true;
  }
  // Nearer cells first, where all rays go the way of those in the middle.
  const auto last = [](double t) { return Group && t < 0.0 ? NodeEdge - 1 : 0; };
  const int flip = cellIndex(last(pyramid.t.x), last(pyramid.t.y), last(pyramid.t.z));
  HWY_ALIGN float tNear[NodeCells];
  HWY_ALIGN std::int32_t pixels[NodeCells];
  while (count > 0)
  {
    const OpenNode parent = open[--count];
    assert(parent.node < bricks && parent.size > 0.0f);
    SVO_COUNT(TileNodesOpened, 1);
    const Node& node = all[parent.node];
    const F size = hn::Set(df, parent.size);
    const F deep = hn::Set(df, parent.size * tables.deep);
    std::uint64_t inside = 0;
    for (std::size_t i = 0; i < NodeCells; i += hn::Lanes(df))
    {
      const F near = hn::MulAdd(size, hn::Load(df, tables.near + i), hn::Set(df, parent.value[4]));
      hn::Store(near, df, tNear + i);
      auto in =
        hn::And(hn::Le(near, hn::Set(df, tMax)), hn::Ge(hn::Add(near, deep), hn::Set(df, tFrom)));
      F best[4];
      for (int k = 0; k < 4; ++k)
      {
        best[k] = hn::MulAdd(size, hn::Load(df, tables.most[k] + i), hn::Set(df, parent.value[k]));
        in = hn::And(in, hn::Ge(best[k], hn::Zero(df)));
      }
      std::uint64_t bits = bitsOf(df, in) & node.mask >> i;
      if (Group && bits != 0)
      {
        const F w = hn::MulAdd(size, hn::Load(df, tables.least + i), hn::Set(df, parent.value[5]));
        hn::Store(pixelsOf(best, w, window, in), DI(), pixels + i);
        bits &= bitsOf(df, in);
      }
      inside |= bits << i;
    }
    if (nodes.size() > most)
    {
      return false;
    }
    int inner[NodeCells], inners = 0;
    for (std::uint64_t left = flipped(inside, flip); left != 0; left &= left - 1)
    {
      const int i = lowestBit(left) ^ flip;
      const std::uint32_t index = child(node, i);
      assert(index < octree.header().nodeCount);
      if (index < bricks && lists.begin[index] == ShortLists::None)
      {
        inner[inners++] = i;
        continue;
      }
      Found found{};
      found.tNear = tNear[i];
      found.node = index;
      if constexpr (Group)
      {
        __builtin_prefetch(all + index);
        const auto byte = [&](int k) { return static_cast<std::uint8_t>(pixels[i] >> 8 * k); };
        found.box = { byte(0), byte(1), byte(2), byte(3) };
      }
      nodes.push_back(found);
    }
    while (inners > 0)
    {
      const int i = inner[--inners];
      assert(count < NodeCells * MaximumDepths);
      OpenNode& next = open[count++];
      next.node = child(node, i);
      next.size = parent.size / NodeEdge;
      for (int k = 0; k < 4; ++k)
      {
        next.value[k] = parent.value[k] + parent.size * (tables.most[k][i] + tables.toCorner[k]);
      }
      next.value[4] = parent.value[4] + parent.size * (tables.near[i] + tables.toCorner[4]);
      if (Group)
      {
        next.value[5] = parent.value[5] + parent.size * (tables.least[i] + tables.toCorner[5]);
      }
    }
  }
  return nodes.size() <= most;
}

bool findInTile(const Octree& octree, const CellOffsets& offsets, const TilePyramid& pyramid,
  float tMin, float tMax, std::size_t most, std::vector<TileNode>& nodes)
{
  return findNodes(octree, offsets, pyramid, tMin, tMax, most, {}, nodes);
}

bool findInGroup(const Octree& octree, const CellOffsets& offsets, const TilePyramid& pyramid,
  float tMin, float tMax, std::size_t most, const GroupWindow& window,
  std::vector<GroupNode>& nodes)
{
  return findNodes(octree, offsets, pyramid, tMin, tMax, most, window, nodes);
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(findInTile);
HWY_EXPORT(findInGroup);

namespace
{
const CellOffsets& cellOffsets()
{
  static const CellOffsets offsets;
  return offsets;
}

void sortByDepth(std::vector<TileNode>& nodes)
{
  const auto nearer = [](const TileNode& a, const TileNode& b) { return a.tNear < b.tNear; };
  constexpr std::size_t Few = 48;
  if (nodes.size() > Few)
  {
    std::sort(nodes.begin(), nodes.end(), nearer);
    return;
  }
  for (std::size_t i = 1; i < nodes.size(); ++i)
  {
    const TileNode node = nodes[i];
    std::size_t k = i;
    for (; k > 0 && nearer(node, nodes[k - 1]); --k)
    {
      nodes[k] = nodes[k - 1];
    }
    nodes[k] = node;
  }
}

}

bool findTileNodes(const Octree& octree, const TilePyramid& pyramid, float tMin, float tMax,
  std::size_t most, std::vector<TileNode>& nodes)
{
  nodes.clear();
  const bool all = !octree || octree.empty() ||
    HWY_DYNAMIC_DISPATCH(findInTile)(octree, cellOffsets(), pyramid, tMin, tMax, most, nodes);
  sortByDepth(nodes);
  SVO_COUNT(TilesAccepted, nodes.empty() ? 0 : 1);
  SVO_COUNT(TilesRejected, nodes.empty() ? 1 : 0);
  return all;
}

bool findGroupNodes(const Octree& octree, const TilePyramid& pyramid, float tMin, float tMax,
  std::size_t most, std::vector<GroupNode>& nodes, const GroupWindow& window)
{
  assert(window.x1 < GroupView::Pixels && window.y1 < GroupView::Pixels);
  nodes.clear();
  return !octree || octree.empty() ||
    HWY_DYNAMIC_DISPATCH(findInGroup)(
      octree, cellOffsets(), pyramid, tMin, tMax, most, window, nodes);
}
}
#endif
