#include "svoPixelShader.h"

#include "svoLeafError.h"
#include "svoShownDepth.h"
#include "svoSkyGradient.h"
#include "svoTileImage.h"
#include "svoTileShadows.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <atomic>

namespace svo
{
void PixelShader::prepare(const Scene& scene, const Hits& eye)
{
  this->Frames.clear();
  this->Smooth.clear();
  this->Errors.clear();
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
    this->Errors.push_back(instance.body->octree
        ? PointErrors{ worldMapError(instance, geometry, level, placed),
            worldLeafError(instance, geometry, level, placed) }
        : PointErrors());
  }
}

/// Finds those points that have to be asked for once more, at another place: the light reaches them
/// though their facets turn away from it, or they are dark and nearly do.
void PixelShader::findTerminator(const LightShadow& shadow, const Light& light,
  const ShadowQuery& query, std::uint64_t dark, Scratch& scratch) const
{
  const TilePatch& patch = query.patch;
  scratch.terminator.clear();
  if (!this->Smooth[patch.instance] || !shadow.knowsTerminator())
  {
    return;
  }
  const double grazing = shadow.grazing();
  const std::uint64_t asked = mayTurnAway(light, grazing, patch, query.asked, dark);
  if (asked == 0)
  {
    return;
  }
  SmoothTriangles triangles(this->Frames[patch.instance]);
  eachBit(asked,
    [&](int i)
    {
      TerminatorPoint at = atTerminator(triangles, light, grazing, dark >> i & 1, patch.point(i),
        patch.towards(i), patch.hits->primitive[i]);
      if (at.kind != TerminatorPoint::Kind::Plain)
      {
        at.pixel = i;
        if (scratch.noted && at.kind != TerminatorPoint::Kind::Hidden)
        {
          shadow.noteTerminator(query, at, scratch.noted->raysToLights, scratch.noted->raised);
        }
        scratch.terminator.push_back(at);
      }
    });
}

/// Shadows of light l on points that it reaches: what they leave of it.
void PixelShader::shadow(
  std::size_t l, const Lit& lit, std::uint64_t reached, Scratch& scratch) const
{
  const LightShadow& shadow = lit.shaded.dark.of(l);
  const TilePatch& patch = scratch.patch;
  const ShadowQuery query{ patch, this->Errors[patch.instance], scratch.extents, reached,
    scratch.rays };
  float* missed = scratch.missed;
  if (scratch.noted)
  {
    shadow.noteRays(query, scratch.noted->raysToLights);
  }
  const std::uint64_t dark = shadow.test(query, missed);
  std::uint64_t changed = dark;
  this->findTerminator(shadow, *lit.lighting.lights[l].light, query, dark, scratch);
  if (!scratch.terminator.empty())
  {
    shadow.testTerminator(query, scratch.terminator, missed);
    for (const TerminatorPoint& at : scratch.terminator)
    {
      changed |= std::uint64_t(1) << at.pixel;
    }
  }
  if (shadow.dims())
  {
    shadow.dim(query, missed);
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
  const bool underSky = instance.material.lighting && lit.shaded.dark.sky();
  const bool isLit = instance.material.lighting && (!lighting.lights.empty() || underSky);
  if (isLit && instance.receiveShadow && lit.shaded.dark.filters())
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
      clearLight(scratch.light);
    }
    this->addSky(lit, scratch);
  }
  finishLight(instance.material, isLit, patch, scratch.light, scratch.colors);
  if (lit.shaded.dark.occlusion() && instance.material.lighting && instance.receiveShadow)
  {
    this->occlude(lit, scratch);
  }
}

/// All points of a patch, which ask what is around them.
ShadowQuery PixelShader::allOf(Scratch& scratch) const
{
  const TilePatch& patch = scratch.patch;
  const ShadowQuery query{ patch, this->Errors[patch.instance], scratch.extents, patch.mask,
    scratch.rays };
  if (scratch.noted)
  {
    noteRayStarts(query, scratch.noted->raysToLights);
  }
  return query;
}

/// Ambient occlusion of the points of a patch.
void PixelShader::occlude(const Lit& lit, Scratch& scratch) const
{
  const FrameSettings& settings = lit.shaded.settings;
  const auto strength = static_cast<float>(settings.ambientOcclusionStrength);
  alignas(64) float closed[TilePatch::Most] = {};
  int counts[TilePatch::Most] = {};
  lit.shaded.dark.occlusion()->each(this->allOf(scratch),
    [&](int i, const glm::vec3&, float blocked)
    {
      closed[i] += strength * blocked;
      ++counts[i];
    });
  eachBit(
    scratch.patch.mask, [&](int i) { closed[i] /= static_cast<float>(std::max(counts[i], 1)); });
  closeOff(lit.shaded.scene.instances[scratch.patch.instance].material,
    settings.ambientOcclusionOfAllLight, scratch.patch, closed, scratch.colors);
}

/// Adds what the points of a patch see of the sky, as diffuse light. Surfaces that receive no
/// shadows see all of it.
void PixelShader::addSky(const Lit& lit, Scratch& scratch) const
{
  const SkyGradient sky(lit.shaded.settings);
  const TilePatch& patch = scratch.patch;
  glm::vec3 seen[TilePatch::Most] = {};
  if (lit.shaded.scene.instances[patch.instance].receiveShadow)
  {
    int counts[TilePatch::Most] = {};
    lit.shaded.dark.sky()->each(this->allOf(scratch),
      [&](int i, const glm::vec3& along, float blocked)
      {
        seen[i] += (1.0f - blocked) * sky.from(along);
        ++counts[i];
      });
    eachBit(patch.mask, [&](int i) { seen[i] /= static_cast<float>(std::max(counts[i], 1)); });
  }
  else
  {
    eachBit(patch.mask, [&](int i) { seen[i] = sky.over(patch.normal(i)); });
  }
  TileLight& light = scratch.light;
  eachBit(patch.mask,
    [&](int i)
    {
      light.diffuseR[i] += seen[i].r;
      light.diffuseG[i] += seen[i].g;
      light.diffuseB[i] += seen[i].b;
    });
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
