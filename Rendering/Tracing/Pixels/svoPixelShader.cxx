#include "svoPixelShader.h"

#include "svoHemisphereSums.h"
#include "svoShownDepth.h"
#include "svoSky.h"
#include "svoTileImage.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <atomic>

namespace svo
{
std::uint64_t PixelShader::Scratch::sampled(
  const LightImages& images, int plane, std::uint64_t reached) const
{
  std::uint64_t found = reached;
  if (this->pixels)
  {
    eachBit(reached,
      [&](int i)
      {
        const bool any = images.has(plane, this->pixels[i].x, this->pixels[i].y);
        found ^= std::uint64_t(!any) << i;
      });
  }
  return found;
}

/// Sets what shadows leave of light l, on points that it reaches.
void PixelShader::shadow(
  std::size_t l, const Lit& lit, std::uint64_t reached, Scratch& scratch) const
{
  const TilePatch& patch = scratch.patch;
  float* missed = scratch.missed;
  std::uint64_t changed = reached;
  const int plane = lit.images ? lit.images->sampled().ofLights[l] : SampledPlanes::None;
  std::uint64_t found = 0; // by samples
  if (plane != SampledPlanes::None)
  {
    std::fill_n(missed, TilePatch::Most, 0.0f);
    found = scratch.sampled(*lit.images, plane, reached);
  }
  if (plane == SampledPlanes::None || found != reached)
  {
    changed = found |
      this->Points.find(lit.shaded.shadows.of(l), *lit.lighting.lights[l].light,
        this->Points.query(reached & ~found, scratch), scratch);
  }
  eachBit(found, [&](int i) { missed[i] = scratch.mean(*lit.images, plane, i); });
  std::fill_n(scratch.light.share, TilePatch::Most, 1.0f);
  eachBit(changed, [&](int i) { scratch.light.share[i] = shareOfLight(missed[i], lit.remaining); });
  if (this->FindsEdges)
  {
    eachBit(patch.mask, [&](int i) { darken(scratch.darkness[i], l, missed[i]); });
  }
}

/// Colours the points of a patch.
void PixelShader::shadePatch(const Lit& lit, Scratch& scratch) const
{
  const Lighting& lighting = lit.lighting;
  TilePatch& patch = scratch.patch;
  const Instance& instance = lit.shaded.scene.instances[patch.instance];
  lookAtPatch(this->Points.matrices(patch.instance), patch, scratch.triangles);
  std::fill_n(scratch.darkness, TilePatch::Most, Darkness(0));
  const bool underSky = instance.material.lighting && lit.shaded.shadows.sky();
  const bool isLit = instance.material.lighting && (!lighting.lights.empty() || underSky);
  if (isLit && instance.receiveShadow && lit.shaded.shadows.filters())
  {
    eachBit(patch.mask,
      [&](int i)
      { scratch.extents[i] = lit.samples ? 0.5 * worldPixel(lit.shaded.view, patch.t(i)) : 0.0; });
  }
  for (std::size_t l = 0; isLit && l < lighting.lights.size(); ++l)
  {
    const std::uint64_t reached = arriveLight(lighting, l, instance.material, patch, scratch.light);
    if (instance.receiveShadow && lighting.lights[l].light->castShadow)
    {
      this->shadow(l, lit, reached, scratch);
    }
    else
    {
      std::fill_n(scratch.light.share, TilePatch::Most, 1.0f);
    }
    addLight(lighting.lights[l], patch, l == 0, scratch.light);
  }
  if (underSky)
  {
    if (lighting.lights.empty())
    {
      scratch.light.scattered = scratch.light.shining = {};
    }
    this->addSky(lit, scratch);
  }
  finishLight(instance.material, isLit, patch, scratch.light, scratch.colors);
  if (lit.shaded.shadows.occlusion() && instance.material.lighting && instance.receiveShadow)
  {
    this->occlude(lit, scratch);
  }
}

/// Ambient occlusion of the points of a patch.
void PixelShader::occlude(const Lit& lit, Scratch& scratch) const
{
  const TilePatch& patch = scratch.patch;
  alignas(64) float closed[TilePatch::Most] = {};
  if (lit.images)
  {
    const int plane = lit.images->sampled().ofOcclusion;
    eachBit(patch.mask, [&](int i) { closed[i] = scratch.mean(*lit.images, plane, i); });
  }
  else
  {
    SampleSums sums;
    sampleOcclusion(
      this->Points.query(patch.mask, scratch, &sums), *lit.shaded.shadows.occlusion(), sums);
    eachBit(patch.mask, [&](int i) { closed[i] = sums.mean(i); });
  }
  const auto strength = static_cast<float>(lit.shaded.settings.ambientOcclusionStrength);
  eachBit(patch.mask, [&](int i) { closed[i] *= strength; });
  closeOff(lit.shaded.scene.instances[patch.instance].material,
    lit.shaded.settings.ambientOcclusionOfAllLight, patch, closed, scratch.colors);
}

/// Adds what the points of a patch see of the sky, as diffuse light. Surfaces that receive no
/// shadows see all of it.
void PixelShader::addSky(const Lit& lit, Scratch& scratch) const
{
  const TilePatch& patch = scratch.patch;
  const Sky sky(lit.shaded.settings);
  glm::vec3 seen[TilePatch::Most];
  if (!lit.shaded.scene.instances[patch.instance].receiveShadow)
  {
    eachBit(patch.mask, [&](int i) { seen[i] = sky.over(patch.normal(i)); });
  }
  else if (lit.images)
  {
    const int plane = lit.images->sampled().ofSky;
    for (int c = 0; c < 3; ++c)
    {
      eachBit(patch.mask, [&](int i) { seen[i][c] = scratch.mean(*lit.images, plane + c, i); });
    }
  }
  else
  {
    SampleSums sums[3];
    sampleSky(this->Points.query(patch.mask, scratch, sums), *lit.shaded.shadows.sky(), sky, sums);
    eachBit(patch.mask,
      [&](int i) {
        seen[i] = { sums[0].mean(i), sums[1].mean(i), sums[2].mean(i) };
      });
  }
  if (lit.shaded.scene.instances[patch.instance].receiveShadow)
  {
    eachBit(patch.mask, [&](int i) { seen[i] *= sky.brightest(); });
  }
  PixelVectors& light = scratch.light.scattered;
  eachBit(patch.mask, [&](int i) { light.set(i, light(i) + seen[i]); });
}

/// Shades a tile's hits and writes its pixels, hits or not, all at once.
void PixelShader::write(const Lit& lit, const TileHits& hits, Scratch& scratch, Frame& frame)
{
  TileImage image(hits, frame);
  const FrameSettings& settings = lit.shaded.settings;
  const std::size_t corner = static_cast<std::size_t>(hits.y0) * frame.width + hits.x0;
  const auto pixelOf = [&](int i)
  { return corner + static_cast<std::size_t>(i >> 3) * frame.width + (i & 7); };
  this->shadePatches(lit, hits, scratch,
    [&]
    {
      const TilePatch& patch = scratch.patch;
      const Instance& instance = lit.shaded.scene.instances[patch.instance];
      image.put(
        patch, scratch.colors, shownOffset(instance, lit.shaded.view), instance.depthOffset.factor);
      if (settings.writeNormals)
      {
        eachBit(patch.mask,
          [&](int i)
          {
            const glm::vec3 normal = instance.material.lighting
              ? lit.lighting.rotation * patch.normal(i)
              : glm::vec3(0.0f);
            std::copy(&normal[0], &normal[0] + 3, frame.normals.data() + 3 * pixelOf(i));
          });
      }
      if (settings.writeSlopes)
      {
        // VTK's mappers write the depth of a pixel's centre where they add an offset to it.
        image.putSlopes(patch, instance.depthOffset.none());
      }
      if (settings.writeLight)
      {
        const auto positive = [](float v) { return v > 0.0f ? v : 0.0f; }; // NaN: no light
        eachBit(patch.mask,
          [&](int i)
          {
            float* light = frame.light.data() + 3 * pixelOf(i);
            light[0] = positive(scratch.colors.rgb.x[i]);
            light[1] = positive(scratch.colors.rgb.y[i]);
            light[2] = positive(scratch.colors.rgb.z[i]);
          });
      }
      if (this->FindsEdges)
      {
        Darkness* pixels =
          this->DarkPixels.data() + (hits.instance - lit.shaded.eye.depth.instance.data());
        eachBit(patch.mask, [&](int i) { pixels[i] = scratch.darkness[i]; });
      }
    });
  image.write();
}

void PixelShader::shade(const ShadedScene& shaded, const LightImages& sampled,
  const ParallelFor& parallelFor, ShadedTiles& kept, Frame& frame, FrameStatistics& statistics)
{
  const DepthBuffer& depth = shaded.eye.depth;
  Lit lit(shaded);
  lit.images = sampled.sampled().any() ? &sampled : nullptr;
  std::atomic<std::uint64_t> allRays{ 0 };
  this->FindsEdges = shaded.settings.antiAliasing;
  if (this->FindsEdges)
  {
    this->DarkPixels.resize(depth.instance.size());
  }
  shaded.tiles.each<Scratch>(parallelFor,
    [&](int tileX, int tileY, Scratch& scratch)
    {
      const std::size_t index = kept.index(tileX, tileY);
      if (!kept.shadedAnew(index))
      {
        return;
      }
      scratch.rays = 0;
      scratch.noted = shaded.settings.frameCoherence && kept.stale(index) ? &kept[index] : nullptr;
      this->write(lit, hitsOfTile(depth, shaded.view, tileX, tileY), scratch, frame);
      if (scratch.rays > 0)
      {
        allRays.fetch_add(scratch.rays, std::memory_order_relaxed);
      }
    });
  statistics.shadowRays += allRays;
}
}
