#include "svoStaleTiles.h"

#include <algorithm>
#include <cstddef>

namespace svo
{
void findStaleTiles(
  const Hits& eye, const std::vector<std::uint32_t>& instances, bool all, ShadedTiles& tiles)
{
  const DepthBuffer& depth = eye.depth;
  tiles.beginFrame(depth.grid.tilesX, depth.grid.tilesY, all);
  for (std::size_t tile = 0; tile < tiles.size(); ++tile)
  {
    tiles.setStale(tile, !all && eye.changedSince(tile, tiles.madeOf()));
  }
  // Where an instance is not seen it does not matter how it looks.
  for (const std::uint32_t instance : all ? std::vector<std::uint32_t>() : instances)
  {
    const PixelRect rect = eye.instances.rect(instance);
    for (int y = rect.y0 / 8; y < rect.y1 / 8; ++y)
    {
      for (int x = rect.x0 / 8; x < rect.x1 / 8; ++x)
      {
        const std::size_t tile = tiles.index(x, y);
        tiles.setStale(tile, !tiles.stale(tile) && depth.shows(x, y, instance));
      }
    }
  }
}

void findDarkenedTiles(const Scene& scene, const FrameChanges& changes, const Shadows& shadows,
  const std::vector<std::uint32_t>& hits, std::vector<CasterBox>& casters,
  const ParallelFor& parallelFor, ShadedTiles& tiles)
{
  const bool all = changes.all || !shadows.sameMaps();
  std::vector<CasterBox> boxes(2 * changes.instances.size()); // of those, before and now
  casters.resize(scene.instances.size());
  forEach(parallelFor, changes.instances.size(), 256,
    [&](std::size_t k)
    {
      const std::uint32_t i = changes.instances[k];
      boxes[2 * k] = casters[i];
      boxes[2 * k + 1] = casters[i] = CasterBox(scene.instances[i]);
    });
  const auto mayCross = [&](const Box& starts)
  {
    const auto anyOn = [&](const BoxWay& way)
    {
      return std::any_of(
        boxes.begin(), boxes.end(), [&](const CasterBox& box) { return box.mayMeet(way); });
    };
    const auto around = [&](const HemisphereRays* rays)
    { return rays && anyOn(rays->way(starts)); };
    return starts.known() && !boxes.empty() &&
      (around(shadows.occlusion()) || around(shadows.sky()) ||
        std::any_of(scene.lights.begin(), scene.lights.end(),
          [&](const Light& light)
          { return light.castShadow && anyOn(wayToLight(light, starts)); }));
  };
  forEach(parallelFor, hits.size(), 512,
    [&](std::size_t k)
    {
      if (tiles.stale(hits[k]))
      {
        return;
      }
      const ShadedTiles::Tile& tile = tiles[hits[k]];
      tiles.setStale(hits[k],
        all || shadows.changedSince(tile.looksUp, tiles.madeOf()) ||
          shadows.changedSince(tile.raised, tiles.madeOf()) || mayCross(tile.raysToLights));
    });
  tiles.setMadeOf(nextTileVersion());
}
}
