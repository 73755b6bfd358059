#include "svoLightSampler.h"

#include "svoHemisphereSums.h"
#include "svoLightShadow.h"
#include "svoSampleSums.h"
#include "svoTileLighting.h"
#include "svoTileLook.h"
#include "svoViewLights.h"

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace svo
{
namespace
{
struct SampleScratch : PatchShadows::Scratch
{
  SampleSums sums[3];
};

void sampleLight(std::size_t l, const ShadedScene& shaded, const Lighting& lighting,
  const PatchShadows& points, SampleScratch& scratch, LightImages& images)
{
  const TilePatch& patch = scratch.patch;
  const std::uint64_t reached =
    arriveLight(lighting, l, shaded.scene.instances[patch.instance].material, patch, scratch.light);
  points.find(shaded.shadows.of(l), *lighting.lights[l].light,
    points.query(reached, scratch, scratch.sums), scratch);
  images.put(images.sampled().ofLights[l], patch, reached, *scratch.sums);
}

/// The points of a patch.
void samplePatch(const ShadedScene& shaded, const Lighting& lighting, const PatchShadows& points,
  SampleScratch& scratch, LightImages& images)
{
  TilePatch& patch = scratch.patch;
  const SampledPlanes& planes = images.sampled();
  lookAtPatch(points.matrices(patch.instance), patch, scratch.triangles);
  images.put(patch);
  scratch.sums->first = images.firstSample();
  for (std::size_t l = 0; l < lighting.lights.size(); ++l)
  {
    if (planes.ofLights[l] != SampledPlanes::None)
    {
      sampleLight(l, shaded, lighting, points, scratch, images);
    }
  }
  const ShadowQuery all = points.query(patch.mask, scratch, scratch.sums);
  const bool around =
    planes.ofOcclusion != SampledPlanes::None || planes.ofSky != SampledPlanes::None;
  if (around && scratch.noted)
  {
    noteRayStarts(all, scratch.noted->raysToLights);
  }
  sampleAround(all, shaded.shadows, shaded.settings, images);
}
}

void sampleLights(const ShadedScene& shaded, const PatchShadows& points,
  const ParallelFor& parallelFor, ShadedTiles& kept, LightImages& images,
  FrameStatistics& statistics)
{
  const Lighting lighting(shaded.scene, shaded.view);
  std::atomic<std::uint64_t> allRays{ 0 };
  shaded.tiles.each<SampleScratch>(parallelFor,
    [&](int tileX, int tileY, SampleScratch& scratch)
    {
      const std::size_t index = kept.index(tileX, tileY);
      if (!kept.stale(index))
      {
        return;
      }
      scratch.rays = 0;
      scratch.noted = shaded.settings.frameCoherence ? &kept[index] : nullptr;
      if (images.firstSample() == 0)
      {
        images.startTile(tileX, tileY);
      }
      eachPatch(
        shaded.view, hitsOfTile(shaded.eye.depth, shaded.view, tileX, tileY),
        [&](std::uint32_t i)
        {
          const Instance& instance = shaded.scene.instances[i];
          return instance.receiveShadow && instance.material.lighting;
        },
        [&](std::uint32_t i) { return shaded.eye.base(i); }, scratch.patch,
        [&](const TilePatch&) { samplePatch(shaded, lighting, points, scratch, images); });
      allRays.fetch_add(scratch.rays, std::memory_order_relaxed);
    });
  statistics.shadowRays += allRays;
}
}
