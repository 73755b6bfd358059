#include "svoPixelShader.h"

#include "svoLeafError.h"
#include "svoShownDepth.h"
#include "svoTileImage.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <atomic>

namespace svo
{
void PixelShader::prepare(const Scene& scene, const Hits& eye)
{
  this->Frames.clear();
  this->Smooth.clear();
  this->MapErrors.clear();
  this->RayErrors.clear();
  this->Frames.reserve(scene.instances.size());
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    const int level = eye.instances.level(static_cast<std::uint32_t>(i));
    const LeafGeometry geometry = eye.instances.leafGeometry(static_cast<std::uint32_t>(i));
    const bool placed = eye.instances.placed(static_cast<std::uint32_t>(i));
    const bool seen = !eye.instances.rect(static_cast<std::uint32_t>(i)).empty();
    this->Frames.push_back(seen ? SurfaceMatrices(instance) : SurfaceMatrices());
    this->Smooth.push_back(instance.body->octree && isSmooth(instance));
    this->MapErrors.push_back(
      instance.body->octree ? worldMapError(instance, geometry, level, placed) : 0.0);
    this->RayErrors.push_back(
      instance.body->octree ? worldLeafError(instance, geometry, level, placed) : 0.0);
  }
}

/// Finds those points that have to be asked for once more, at another place: light l reaches them
/// though their facets turn away from it, or they are dark and nearly do.
void PixelShader::findTerminator(
  std::size_t l, const Lit& lit, std::uint64_t reached, std::uint64_t dark, Scratch& scratch) const
{
  const TilePatch& patch = scratch.patch;
  const Light& light = *lit.lighting.lights[l].light;
  const Shadows& shadows = lit.shaded.dark;
  scratch.terminator.clear();
  if (!this->Smooth[patch.instance] || !shadows.knowsTerminator(l))
  {
    return;
  }
  const std::uint64_t asked = mayTurnAway(light, shadows.grazing(l), patch, reached, dark);
  if (asked == 0)
  {
    return;
  }
  SmoothTriangles triangles(this->Frames[patch.instance]);
  eachBit(asked,
    [&](int i)
    {
      TerminatorPoint at = atTerminator(triangles, light, shadows.grazing(l), dark >> i & 1,
        patch.point(i), patch.towards(i), patch.hits->primitive[i]);
      if (at.kind != TerminatorPoint::Kind::Plain)
      {
        at.pixel = i;
        if (scratch.noted && at.kind != TerminatorPoint::Kind::Hidden)
        {
          const glm::dvec3 reach(this->error(l, lit, patch.instance));
          scratch.noted->raysToLights.add(patch.position(i), reach);
          scratch.noted->raysToLights.add(at.point.position, reach);
          shadows.note(l, at, scratch.noted->raised);
        }
        scratch.terminator.push_back(at);
      }
    });
}

/// Shadows of light l on points that it reaches: what they leave of it.
void PixelShader::shadow(
  std::size_t l, const Lit& lit, std::uint64_t reached, Scratch& scratch) const
{
  const Shadows& shadows = lit.shaded.dark;
  const TilePatch& patch = scratch.patch;
  const double error = this->error(l, lit, patch.instance);
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
    if (scratch.noted && shadows.usesRays(l))
    {
      scratch.noted->raysToLights.add(
        patch.origin.position, (1.0 + 1e-6) * glm::dvec3(patch.extent) + error);
    }
    dark = shadows.dark(l, patch, error, reached, scratch.rays);
    eachBit(dark, [&](int i) { missed[i] = 1.0f; });
  }
  std::uint64_t changed = dark;
  this->findTerminator(l, lit, reached, dark, scratch);
  if (!scratch.terminator.empty())
  {
    shadows.darkness(l, patch, scratch.terminator, error, scratch.extents, missed, scratch.rays);
    for (const TerminatorPoint& at : scratch.terminator)
    {
      changed |= std::uint64_t(1) << at.pixel;
    }
  }
  if (shadows.dims(l))
  {
    shadows.dim(l, patch, error, scratch.extents, reached, missed, scratch.rays);
    changed |= reached;
  }
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
            light[0] = positive(scratch.colors.r[i]);
            light[1] = positive(scratch.colors.g[i]);
            light[2] = positive(scratch.colors.b[i]);
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

void PixelShader::shade(const ShadedScene& shaded, const ParallelFor& parallelFor, KeptTiles& kept,
  Frame& frame, FrameStatistics& statistics)
{
  const DepthBuffer& depth = shaded.eye.depth;
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
      const std::size_t index = kept.index(tileX, tileY);
      if (!kept.stale(index))
      {
        return;
      }
      KeptTiles::Tile& tile = kept[index];
      scratch.rays = 0;
      tile.raised.clear();
      tile.raysToLights = PointBox();
      scratch.noted = shaded.settings.frameCoherence ? &tile : nullptr;
      this->write(lit, hitsOfTile(depth, shaded.view, tileX, tileY), scratch, frame);
      if (scratch.rays > 0)
      {
        allRays.fetch_add(scratch.rays, std::memory_order_relaxed);
      }
    });
  statistics.shadowRays += allRays;
}
}
