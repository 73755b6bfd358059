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
/// What arrays of cubes have room for behind the last: a vector of any instruction set.
constexpr std::size_t RoomBehind = 16;

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
  float x, y, z;  // lower corner, octree coordinates minus 1
  float value[5]; // of the sides and of t at its lower corner, rounding allowed for
};

inline void sortByDepth(std::vector<TileNode>& nodes)
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
  open[0].x = open[0].y = open[0].z = 0.0f;
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
    nodes.push_back({ -std::numeric_limits<float>::infinity(), 0, 0.0f, 0.0f, 0.0f, 1.0f });
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
      const float x = parent.x + parent.size * offsets.x[i];
      const float y = parent.y + parent.size * offsets.y[i];
      const float z = parent.z + parent.size * offsets.z[i];
      if (index >= bricks || lists.begin[index] != ShortLists::None)
      {
        nodes.push_back({ tNear[i], index, x, y, z, 0.25f * parent.size });
        continue;
      }
      assert(count < 64 * MaximumDepths);
      OpenNode& next = open[count++];
      next.node = index;
      next.size = 0.25f * parent.size;
      next.x = x;
      next.y = y;
      next.z = z;
      for (int k = 0; k < 4; ++k)
      {
        next.value[k] = parent.value[k] + parent.size * (tables.most[k][i] + tables.toCorner[k]);
      }
      next.value[4] = parent.value[4] + parent.size * (tables.near[i] + tables.toCorner[4]);
    }
  }
  sortByDepth(nodes);
  return nodes.size() <= most;
}

/// Which of `count` cubes are inside: one bit each. The arrays have room for RoomBehind more.
void cubesInside(const TilePyramid& pyramid, const float* x, const float* y, const float* z,
  const float* size, std::size_t count, std::uint64_t* inside)
{
  const DF df;
  const PyramidSides sides(pyramid);
  assert(hn::Lanes(df) <= RoomBehind);
  for (std::size_t first = 0; first < count; first += 64)
  {
    std::uint64_t bits = 0;
    for (std::size_t i = first; i < std::min(first + 64, count); i += hn::Lanes(df))
    {
      const F vx = hn::LoadU(df, x + i);
      const F vy = hn::LoadU(df, y + i);
      const F vz = hn::LoadU(df, z + i);
      const F edge = hn::LoadU(df, size + i);
      auto in = hn::Eq(edge, edge);
      for (int k = 0; k < 4; ++k)
      {
        const float grows =
          std::max(sides.x[k], 0.0f) + std::max(sides.y[k], 0.0f) + std::max(sides.z[k], 0.0f);
        const F best = hn::MulAdd(hn::Set(df, sides.x[k]), vx,
          hn::MulAdd(hn::Set(df, sides.y[k]), vy,
            hn::MulAdd(hn::Set(df, sides.z[k]), vz,
              hn::MulAdd(hn::Set(df, grows), edge, hn::Set(df, sides.w[k])))));
        in = hn::And(in, hn::Ge(best, hn::Zero(df)));
      }
      bits |= laneBits(df, in) << (i - first);
    }
    inside[first / 64] = bits;
  }
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(findNodes);
HWY_EXPORT(cubesInside);

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

void countTile([[maybe_unused]] const std::vector<TileNode>& nodes)
{
  SVO_COUNT(TilesAccepted, nodes.empty() ? 0 : 1);
  SVO_COUNT(TilesRejected, nodes.empty() ? 1 : 0);
}
}

bool findTileNodes(const Octree& octree, const TilePyramid& pyramid, float tMin, float tMax,
  std::size_t most, std::vector<TileNode>& nodes)
{
  const bool all = findInside(octree, pyramid, tMin, tMax, most, nodes);
  countTile(nodes);
  return all;
}

bool TileGroup::find(
  const Octree& octree, const TilePyramid& pyramid, float tMin, float tMax, std::size_t most)
{
  if (!findInside(octree, pyramid, tMin, tMax, most, this->Nodes))
  {
    return false;
  }
  for (std::vector<float>* array : { &this->X, &this->Y, &this->Z, &this->Size })
  {
    array->assign(this->Nodes.size() + RoomBehind, 0.0f);
  }
  for (std::size_t i = 0; i < this->Nodes.size(); ++i)
  {
    this->X[i] = this->Nodes[i].x;
    this->Y[i] = this->Nodes[i].y;
    this->Z[i] = this->Nodes[i].z;
    this->Size[i] = this->Nodes[i].size;
  }
  return true;
}

void TileGroup::select(const TilePyramid& pyramid, std::vector<TileNode>& nodes) const
{
  nodes.clear();
  assert(this->X.empty() ? this->Nodes.empty() : this->X.size() == this->Nodes.size() + RoomBehind);
  constexpr std::size_t Chunk = 512;
  std::uint64_t inside[Chunk / 64];
  for (std::size_t first = 0; first < this->Nodes.size(); first += Chunk)
  {
    const std::size_t count = std::min(Chunk, this->Nodes.size() - first);
    HWY_DYNAMIC_DISPATCH(cubesInside)
    (pyramid, this->X.data() + first, this->Y.data() + first, this->Z.data() + first,
      this->Size.data() + first, count, inside);
    for (std::size_t k = 0; k < count; k += 64)
    {
      std::uint64_t bits = inside[k / 64];
      if (count - k < 64)
      {
        bits &= (std::uint64_t(1) << (count - k)) - 1;
      }
      for (; bits != 0; bits &= bits - 1)
      {
        nodes.push_back(this->Nodes[first + k + lowestBit(bits)]);
      }
    }
  }
  countTile(nodes);
}
}
#endif
