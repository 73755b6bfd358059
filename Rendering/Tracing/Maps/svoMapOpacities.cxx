#include "svoMapOpacities.h"

#include "svoSurfaceAlpha.h"

#include <cstdint>
#include <vector>

namespace svo
{
void MapOpacities::find(
  const Scene& scene, const View& view, const Hits& map, bool all, const ParallelFor& parallelFor)
{
  const DepthBuffer& depth = map.depth;
  const std::uint64_t known = all ? 0 : this->Of;
  this->Of = map.version;
  this->Texels.resize(64 * depth.tiles());
  std::vector<SurfaceMatrices> matrices(scene.instances.size());
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    if (instance.castShadow && instance.mappedOpacity && instance.body->octree)
    {
      matrices[i] = SurfaceMatrices(instance);
    }
  }
  const auto opacityAt = [&](std::size_t tile, int i)
  {
    const std::uint32_t caster = depth.instance[64 * tile + i];
    if (caster == NoInstance)
    {
      return 0.0f;
    }
    const Instance& instance = scene.instances[caster];
    if (!instance.mappedOpacity)
    {
      return instance.opacity;
    }
    const double x = 8.0 * depth.grid.tileX(tile) + (i & 7) + 0.5;
    const double y = 8.0 * depth.grid.tileY(tile) + (i >> 3) + 0.5;
    const glm::dvec3 ray = view.rayDirection(x, y);
    const double t = map.base(caster) + static_cast<double>(depth.t[64 * tile + i]);
    return instance.opacity *
      surfaceAlpha(matrices[caster], view.rayOrigin(x, y) + t * ray, -glm::vec3(ray),
        depth.primitive[64 * tile + i]);
  };
  forEach(parallelFor, depth.tiles(), 64,
    [&](std::size_t tile)
    {
      for (int i = 0; depth.hit[tile] && map.changedSince(tile, known) && i < 64; ++i)
      {
        this->Texels[64 * tile + i] = opacityAt(tile, i);
      }
    });
}
}
