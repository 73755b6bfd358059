#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTileOccluders.cxx"
#include <hwy/foreach_target.h>

#include "svoTileOccluders.h"

#include "svoLaneBits-inl.h"
#include "svoLocalView.h"

#include <algorithm>
#include <limits>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// The texels of a tile that are an instance's, and the least and the greatest of their depths.
std::uint64_t lanesOfCaster(const float* t, const std::uint32_t* instances, std::uint32_t instance,
  float& least, float& greatest)
{
  const Words words;
  const Floats floats;
  const auto wanted = hn::Set(words, instance);
  auto nearest = hn::Inf(floats), farthest = hn::Neg(nearest);
  std::uint64_t mask = 0;
  for (int i = 0; i < 64; i += width())
  {
    const auto mine = hn::Eq(hn::LoadU(words, instances + i), wanted);
    const auto depth = hn::LoadU(floats, t + i);
    const auto lanes = hn::RebindMask(floats, mine);
    nearest = hn::Min(nearest, hn::IfThenElse(lanes, depth, hn::Inf(floats)));
    farthest = hn::Max(farthest, hn::IfThenElse(lanes, depth, hn::Neg(hn::Inf(floats))));
    mask |= bitsOf(words, mine) << i;
  }
  least = hn::GetLane(hn::MinOfLanes(floats, nearest));
  greatest = hn::GetLane(hn::MaxOfLanes(floats, farthest));
  return mask;
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(lanesOfCaster);

namespace
{
TileOccluders occludersIn(const Hits& map, std::size_t tile)
{
  const DepthBuffer& depth = map.depth;
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  double nearest = Infinity, farthest = -Infinity;
  if (!depth.hit[tile])
  {
    return { static_cast<float>(Infinity), static_cast<float>(Infinity), NoInstance };
  }
  const float* t = depth.t.data() + 64 * tile;
  const std::uint32_t* instances = depth.instance.data() + 64 * tile;
  std::uint32_t caster = TileOccluders::Several;
  for (std::uint64_t left = ~std::uint64_t(0); left != 0;)
  {
    const std::uint32_t instance = instances[__builtin_ctzll(left)];
    float least, greatest;
    const std::uint64_t mine =
      HWY_DYNAMIC_DISPATCH(lanesOfCaster)(t, instances, instance, least, greatest);
    if (mine == ~std::uint64_t(0))
    {
      caster = instance;
    }
    if (instance != NoInstance)
    {
      nearest = std::min(nearest, map.base(instance) + static_cast<double>(least));
      farthest = std::max(farthest, map.base(instance) + static_cast<double>(greatest));
    }
    else
    {
      farthest = Infinity;
    }
    left &= ~mine;
  }
  return { -roundUp(-nearest), roundUp(farthest), caster };
}
}

void MapOccluders::find(const Hits& map, const ParallelFor& parallelFor)
{
  const std::size_t tiles = map.depth.tiles();
  this->Tiles.resize(tiles);
  forEach(parallelFor, tiles, 256,
    [&](std::size_t tile)
    {
      if (map.changedSince(tile, this->Of))
      {
        this->Tiles[tile] = occludersIn(map, tile);
      }
    });
  this->Of = map.version;
}

TileOccluders MapOccluders::in(const MapTiles& tiles, const TileGrid& grid) const
{
  constexpr int Most = 4; // tiles along an edge of a box
  if (!this->known() || !tiles.atMost(Most))
  {
    constexpr float Infinity = std::numeric_limits<float>::infinity();
    return { -Infinity, Infinity, TileOccluders::Several };
  }
  TileOccluders all = this->Tiles[grid.index(tiles.x0, tiles.y0)];
  for (int y = tiles.y0; y <= tiles.y1; ++y)
  {
    for (int x = tiles.x0; x <= tiles.x1; ++x)
    {
      const TileOccluders& tile = this->Tiles[grid.index(x, y)];
      all.nearest = std::min(all.nearest, tile.nearest);
      all.farthest = std::max(all.farthest, tile.farthest);
      all.caster = tile.caster == all.caster ? all.caster : TileOccluders::Several;
    }
  }
  return all;
}
}
#endif
