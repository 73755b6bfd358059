#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoPyramidNodes.cxx"
#include <hwy/foreach_target.h>

#include "svoCounters.h"
#include "svoMorton.h"
#include "svoNode.h"
#include "svoPyramidNodes.h"
#include "svoPyramidSides.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

#include <hwy/highway.h>

#ifndef SVO_PYRAMID_NODES_ONCE
#define SVO_PYRAMID_NODES_ONCE
namespace svo
{
/// Lower corners of a node's 64 cells, for a node of edge 1, in the order of cellIndex().
struct CellOffsets
{
  alignas(64) float x[64], y[64], z[64];

  CellOffsets()
  {
    for (int i = 0; i < 64; ++i)
    {
      const glm::ivec3 cell = cellOfIndex(i);
      x[i] = 0.25f * static_cast<float>(cell.x);
      y[i] = 0.25f * static_cast<float>(cell.y);
      z[i] = 0.25f * static_cast<float>(cell.z);
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
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::ScalableTag<float>;
using F = hn::Vec<DF>;

/// Bit i: lane i.
template <class D, class M>
HWY_INLINE std::uint64_t laneBits(D d, M mask)
{
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  std::uint64_t bits;
  std::memcpy(&bits, bytes, 8);
  return bits;
}

/// What linear functions grow by from the lower corner of a node, for a node of edge 1.
struct ChildTables
{
  HWY_ALIGN float most[4][64]; // to the best corner of child i, of each side of the pyramid
  HWY_ALIGN float near[64];    // to the least t of child i
  float toCorner[5];           // from there to the child's lower corner; 4: of t
  float deep;                  // from the least to the greatest t of a child
};

HWY_INLINE void fillTable(
  const glm::dvec4& f, double start, const float* x, const float* y, const float* z, float* table)
{
  const DF df;
  const F fx = hn::Set(df, static_cast<float>(f.x));
  const F fy = hn::Set(df, static_cast<float>(f.y));
  const F fz = hn::Set(df, static_cast<float>(f.z));
  const F begin = hn::Set(df, static_cast<float>(start));
  for (std::size_t i = 0; i < 64; i += hn::Lanes(df))
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
  float value[5]; // of the sides and of t at its lower corner, rounding allowed for
};

bool findNodes(const Octree& octree, const CellOffsets& offsets, const TilePyramid& pyramid,
  float tMin, float tMax, std::size_t most, std::vector<TileNode>& nodes)
{
  assert(octree.surface() != nullptr && octree.shortLists().begin.size() == octree.brickBegin());
  const DF df;
  ChildTables tables;
  OpenNode open[64 * MaximumDepths];
  int count = 1;
  open[0].node = 0;
  open[0].size = 1.0f;
  double tSlack = 0.0;
  for (int k = 0; k < 5; ++k)
  {
    const glm::dvec4& f = k < 4 ? pyramid.side[k] : pyramid.t;
    const double corner = f.x + f.y + f.z + f.w; // octree coordinates begin at 1
    const double slack =
      RoundingSlack * (std::abs(f.x) + std::abs(f.y) + std::abs(f.z) + std::abs(corner));
    if (k < 4)
    {
      const double farthest = 0.25 * (std::max(f.x, 0.0) + std::max(f.y, 0.0) + std::max(f.z, 0.0));
      fillTable(f, farthest, offsets.x, offsets.y, offsets.z, tables.most[k]);
      tables.toCorner[k] = static_cast<float>(-farthest);
      open[0].value[k] = static_cast<float>(corner + slack);
    }
    else
    {
      const double least = 0.25 * (std::min(f.x, 0.0) + std::min(f.y, 0.0) + std::min(f.z, 0.0));
      const double farthest = 0.25 * (std::max(f.x, 0.0) + std::max(f.y, 0.0) + std::max(f.z, 0.0));
      fillTable(f, least, offsets.x, offsets.y, offsets.z, tables.near);
      tables.toCorner[4] = static_cast<float>(-least);
      tables.deep = static_cast<float>(farthest - least);
      open[0].value[4] = static_cast<float>(corner - slack);
      tSlack = slack;
    }
  }
  const float tFrom = static_cast<float>(tMin - 2.0 * tSlack);
  const Node* all = octree.nodes();
  const ShortLists& lists = octree.shortLists();
  const std::uint32_t bricks = octree.brickBegin();
  nodes.clear();
  if (bricks == 0 || lists.begin[0] != ShortLists::None)
  {
    nodes.push_back({ -std::numeric_limits<float>::infinity(), 0 });
    return true;
  }
  HWY_ALIGN float tNear[64];
  while (count > 0)
  {
    const OpenNode parent = open[--count];
    assert(parent.node < bricks && parent.size > 0.0f);
    SVO_COUNT(TileNodesOpened, 1);
    const Node& node = all[parent.node];
    const F size = hn::Set(df, parent.size);
    const F deep = hn::Set(df, parent.size * tables.deep);
    std::uint64_t inside = 0;
    for (std::size_t i = 0; i < 64; i += hn::Lanes(df))
    {
      const F near = hn::MulAdd(size, hn::Load(df, tables.near + i), hn::Set(df, parent.value[4]));
      hn::Store(near, df, tNear + i);
      auto in =
        hn::And(hn::Le(near, hn::Set(df, tMax)), hn::Ge(hn::Add(near, deep), hn::Set(df, tFrom)));
      for (int k = 0; k < 4; ++k)
      {
        const F best =
          hn::MulAdd(size, hn::Load(df, tables.most[k] + i), hn::Set(df, parent.value[k]));
        in = hn::And(in, hn::Ge(best, hn::Zero(df)));
      }
      inside |= laneBits(df, in) << i;
    }
    if (nodes.size() > most)
    {
      return false;
    }
    for (std::uint64_t left = inside & node.mask; left != 0; left &= left - 1)
    {
      const int i = lowestBit(left);
      const std::uint32_t index = child(node, i);
      assert(index < octree.header().nodeCount);
      if (index >= bricks || lists.begin[index] != ShortLists::None)
      {
        nodes.push_back({ tNear[i], index });
        continue;
      }
      assert(count < 64 * MaximumDepths);
      OpenNode& next = open[count++];
      next.node = index;
      next.size = 0.25f * parent.size;
      for (int k = 0; k < 4; ++k)
      {
        next.value[k] = parent.value[k] + parent.size * (tables.most[k][i] + tables.toCorner[k]);
      }
      next.value[4] = parent.value[4] + parent.size * (tables.near[i] + tables.toCorner[4]);
    }
  }
  return nodes.size() <= most;
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(findNodes);

namespace
{
/// findTileNodes() of a tile or of a group of them.
bool findInside(const Octree& octree, const TilePyramid& pyramid, float tMin, float tMax,
  std::size_t most, std::vector<TileNode>& nodes)
{
  static const CellOffsets offsets;
  nodes.clear();
  return !octree || octree.empty() ||
    HWY_DYNAMIC_DISPATCH(findNodes)(octree, offsets, pyramid, tMin, tMax, most, nodes);
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
  const bool all = findInside(octree, pyramid, tMin, tMax, most, nodes);
  sortByDepth(nodes);
  SVO_COUNT(TilesAccepted, nodes.empty() ? 0 : 1);
  SVO_COUNT(TilesRejected, nodes.empty() ? 1 : 0);
  return all;
}

bool findGroupNodes(const Octree& octree, const TilePyramid& pyramid, float tMin, float tMax,
  std::size_t most, std::vector<TileNode>& nodes)
{
  return findInside(octree, pyramid, tMin, tMax, most, nodes);
}
}
#endif
