#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTilePatch.cxx"
#include <hwy/foreach_target.h>

#include "svoTilePatch.h"

#include "svoLaneBits-inl.h"

#include <algorithm>
#include <cmath>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// Finds those of the hits that are of an instance and at most `reach` deeper or less deep than t,
/// and those on nodes, whatever they are of. Sets by how much all that are of the instance are, 0
/// elsewhere; returns the most of the former.
float findNear(const TileHits& hits, float t, float reach, TilePatch& patch)
{
  const Words words;
  const Integers integers;
  const Floats floats;
  const auto wanted = hn::Set(words, patch.instance);
  const auto from = hn::Set(floats, t), limit = hn::Set(floats, reach);
  auto farthest = hn::Zero(floats);
  std::uint64_t mask = 0, nodes = 0;
  for (int i = 0; i < TileHits::Most; i += width())
  {
    const auto mine = hn::RebindMask(floats, hn::Eq(hn::LoadU(words, hits.instance + i), wanted));
    const auto away = hn::IfThenElseZero(mine, hn::Sub(hn::LoadU(floats, hits.t + i), from));
    const auto near = hn::And(mine, hn::Le(hn::Abs(away), limit));
    farthest = hn::Max(farthest, hn::IfThenElseZero(near, hn::Abs(away)));
    const auto primitive = hn::BitCast(integers, hn::LoadU(words, hits.primitive + i));
    hn::Store(away, floats, patch.deeper + i);
    mask |= bitsOf(floats, near) << i;
    nodes |= bitsOf(integers, hn::Lt(primitive, hn::Zero(integers))) << i;
  }
  patch.mask = mask;
  patch.nodes = nodes;
  return hn::GetLane(hn::MaxOfLanes(floats, farthest));
}
static_assert(NodePrimitive == 1u << 31, "the sign of a primitive says that it is a node");

void place(const PointOrigin& from, TilePatch& p)
{
  const PointOrigin origin = from;
  for (int i = 0; i < TilePatch::Most; i += TilePatch::Step)
  {
    if (!p.has(i))
    {
      continue;
    }
    const float *x = p.hits->x + i, *y = p.hits->y + i;
    for (int k = 0; k < TilePatch::Step; ++k)
    {
      p.way.set(i + k, origin.wayTo(x[k], y[k], p.deeper[i + k]));
    }
  }
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(lanesOf);
HWY_EXPORT(findNear);
HWY_EXPORT(place);

namespace
{
/// The centres of a tile's pixels.
struct Centres
{
  alignas(64) float x[TileHits::Most], y[TileHits::Most];
  Centres()
  {
    for (int k = 0; k < TileHits::Most; ++k)
    {
      x[k] = static_cast<float>(k & 7) + 0.5f;
      y[k] = static_cast<float>(k >> 3) + 0.5f;
    }
  }
};

/// Asks for the memory of the tile after the next one, which is shaded soon: a tile is shaded
/// faster than memory that nobody has asked for arrives.
void prefetch(const TileHits& hits)
{
  constexpr int Line = 16; // words of a cache line
  for (int i = 2 * TileHits::Most; i < 3 * TileHits::Most; i += Line)
  {
    __builtin_prefetch(hits.instance + i);
    __builtin_prefetch(hits.t + i);
    __builtin_prefetch(hits.primitive + i);
  }
}
}

TileHits hitsOfTile(const DepthBuffer& depth, const View& view, int tileX, int tileY)
{
  assert(depth.grid.holds(tileX, tileY));
  static const Centres centres;
  const std::size_t begin = 64 * depth.grid.index(tileX, tileY);
  TileHits hits{ 8 * tileX, 8 * tileY, 0, centres.x, centres.y, depth.t.data() + begin,
    depth.instance.data() + begin, depth.primitive.data() + begin };
  prefetch(hits);
  hits.mask = ~HWY_DYNAMIC_DISPATCH(lanesOf)(hits.instance, NoInstance, TileHits::Most) &
    pixelsInside(view.width - hits.x0, view.height - hits.y0);
  return hits;
}

void takePatch(
  const View& view, const TileHits& hits, std::uint64_t left, double base, TilePatch& patch)
{
  assert((left & hits.mask) != 0 && (left & ~hits.mask) == 0);
  const int first = __builtin_ctzll(left);
  patch.view = &view;
  patch.hits = &hits;
  patch.instance = hits.instance[first];
  patch.base = base;
  patch.origin = PointOrigin(view, hits.x0, hits.y0, patch.t(first));
  const PointOrigin& o = patch.origin;
  const float shorter = std::min(glm::dot(o.alongX, o.alongX), glm::dot(o.alongY, o.alongY));
  const float width = std::sqrt(shorter / glm::dot(o.ray, o.ray)); // in linear depth
  const float farthest =
    HWY_DYNAMIC_DISPATCH(findNear)(hits, hits.t[first], TilePatch::Reach * width, patch);
  patch.mask = (patch.mask & left) | std::uint64_t(1) << first;
  patch.nodes &= patch.mask;
  patch.extent = patch.origin.extent(farthest);
  HWY_DYNAMIC_DISPATCH(place)(patch.origin, patch);
}
}
#endif
