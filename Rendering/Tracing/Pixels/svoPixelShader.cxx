#include "svoPixelShader.h"

#include "svoLeafError.h"
#include "svoShownDepth.h"
#include "svoTerminator.h"
#include "svoTileImage.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <atomic>

namespace svo
{
void PixelShader::prepare(const Scene& scene, const LayeredView& eye)
{
  this->Frames.clear();
  this->Smooth.clear();
  this->MapErrors.clear();
  this->RayErrors.clear();
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    const int level = eye.level(static_cast<std::uint32_t>(i));
    const LeafGeometry geometry = eye.leafGeometry(static_cast<std::uint32_t>(i));
    const bool placed = eye.placed(static_cast<std::uint32_t>(i));
    this->Frames.push_back(instance.octree ? SurfaceMatrices(instance) : SurfaceMatrices());
    this->Smooth.push_back(instance.octree && isSmooth(instance));
    this->MapErrors.push_back(
      instance.octree ? worldMapError(instance, geometry, level, placed) : 0.0);
    this->RayErrors.push_back(
      instance.octree ? worldLeafError(instance, geometry, level, placed) : 0.0);
  }
}

/// Calls each(i, point, at) for those points that have to be asked for once more, at another place:
/// light l reaches them though their facets turn away from it, or they are dark and nearly do.
template <class Each>
void PixelShader::eachTerminator(std::size_t l, const Lit& lit, std::uint64_t reached,
  std::uint64_t dark, Scratch& scratch, Each&& each) const
{
  const TilePatch& patch = scratch.patch;
  const Light& light = *lit.lighting.lights[l].light;
  const Shadows& shadows = lit.shaded.dark;
  if (!this->Smooth[patch.instance] || !shadows.knowsTerminator(l))
  {
    return;
  }
  const SurfaceMatrices& frame = this->Frames[patch.instance];
  eachBit(mayTurnAway(light, shadows.grazing(l), patch, reached, dark),
    [&](int i)
    {
      const SurfacePoint point = patch.point(i);
      const TerminatorPoint at = atTerminator(frame, light, shadows.grazing(l), dark >> i & 1,
        point, patch.towards(i), patch.hits->primitive[i]);
      if (at.kind != TerminatorPoint::Kind::Plain)
      {
        scratch.atTerminator = true;
        each(i, point, at);
      }
    });
}

/// Shadows of light l on points that it reaches: what they leave of it.
void PixelShader::shadow(
  std::size_t l, const Lit& lit, std::uint64_t reached, Scratch& scratch) const
{
  const Shadows& shadows = lit.shaded.dark;
  const TilePatch& patch = scratch.patch;
  const double error = (shadows.usesRays(l) ? this->RayErrors : this->MapErrors)[patch.instance];
  float* missed = scratch.missed;
  std::fill_n(missed, TilePatch::Most, 0.0f);
  std::uint64_t dark = 0;
  if (shadows.filters(l))
  {
    eachBit(patch.mask,
      [&](int i)
      { scratch.extents[i] = lit.samples ? 0.5 * worldPixel(lit.shaded.view, patch.t(i)) : 0.0; });
    shadows.darkness(l, patch, error, scratch.extents, reached, missed);
    eachBit(reached, [&](int i) { dark |= std::uint64_t(missed[i] > 0.0f) << i; });
  }
  else
  {
    dark = shadows.dark(l, patch, error, reached, scratch.rays);
    eachBit(dark, [&](int i) { missed[i] = 1.0f; });
  }
  std::uint64_t changed = dark;
  this->eachTerminator(l, lit, reached, dark, scratch,
    [&](int i, const SurfacePoint& point, const TerminatorPoint& at)
    {
      missed[i] = shadows.darkness(l, point, at, missed[i], error,
        shadows.filters(l) ? scratch.extents[i] : 0.0, scratch.rays);
      changed |= std::uint64_t(1) << i;
    });
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
  lookAtPatch(this->Frames[patch.instance], patch, scratch.triangles);
  std::fill_n(scratch.darkness, TilePatch::Most, Darkness(0));
  const bool isLit = instance.material.lighting && !lighting.lights.empty();
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
  finishLight(instance.material, isLit, patch, scratch.light, scratch.colors);
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
      image.put(patch, scratch.colors, shownOffset(instance, lit.shaded.view));
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
      if (settings.writeLight)
      {
        const auto positive = [](float v) { return v > 0.0f ? v : 0.0f; }; // NaN: no light
        eachBit(patch.mask,
          [&](int i)
          {
            float* light = frame.light.data() + 3 * pixelOf(i);
            light[0] = positive(scratch.colors.r[i]);
            light[1] = positive(scratch.colors.g[i]);
            light[2] = positive(scratch.colors.b[i]);
          });
      }
      if (this->FindsEdges)
      {
        Darkness* pixels =
          this->DarkPixels.data() + (hits.instance - lit.shaded.eye.depthBuffer().instance.data());
        eachBit(patch.mask, [&](int i) { pixels[i] = scratch.darkness[i]; });
      }
    });
  image.write();
}

void PixelShader::shade(const ShadedScene& shaded, const ParallelFor& parallelFor, KeptTiles& kept,
  Frame& frame, FrameStatistics& statistics)
{
  const DepthBuffer& depth = shaded.eye.depthBuffer();
  const Lit lit(shaded);
  std::atomic<std::uint64_t> allRays{ 0 };
  this->FindsEdges = shaded.settings.antiAliasing;
  if (this->FindsEdges)
  {
    this->DarkPixels.resize(depth.instance.size());
  }
  shaded.tiles.each<Scratch>(parallelFor,
    [&](int tileX, int tileY, Scratch& scratch)
    {
      KeptTiles::Tile& tile = kept.at(tileX, tileY);
      if (!tile.stale)
      {
        return;
      }
      scratch.rays = 0;
      scratch.atTerminator = false;
      this->write(lit, hitsOfTile(depth, shaded.view, tileX, tileY), scratch, frame);
      tile.atTerminator = scratch.atTerminator;
      if (scratch.rays > 0)
      {
        allRays.fetch_add(scratch.rays, std::memory_order_relaxed);
      }
    });
  statistics.shadowRays += allRays;
}
}
