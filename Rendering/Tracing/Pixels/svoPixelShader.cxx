#include "svoPixelShader.h"

#include "svoLeafError.h"
#include "svoShownDepth.h"
#include "svoTerminator.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace svo
{
void PixelShader::prepare(const Scene& scene, ShadowTechnique technique, const LayeredView& eye)
{
  this->Frames.clear();
  this->Smooth.clear();
  this->Errors.clear();
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    const int level = eye.level(static_cast<std::uint32_t>(i));
    const LeafGeometry geometry = eye.leafGeometry(static_cast<std::uint32_t>(i));
    const bool placed = eye.placed(static_cast<std::uint32_t>(i));
    this->Frames.push_back(instance.octree ? SurfaceMatrices(instance) : SurfaceMatrices());
    this->Smooth.push_back(instance.octree && isSmooth(instance));
    this->Errors.push_back(!instance.octree  ? 0.0
        : technique == ShadowTechnique::Rays ? worldLeafError(instance, geometry, level, placed)
                                             : worldMapError(instance, geometry, level, placed));
  }
}

/// Asks once more for those points first + i, of one instance, that light l reaches though their
/// facets turn away from it, or are dark and nearly do. `darkness`: of point i, any number above 0
/// where TileLight::dark is.
template <class Number>
void PixelShader::shadowTerminator(
  std::size_t l, const Lit& lit, int first, int last, Scratch& scratch, Number* darkness) const
{
  const TilePoints& p = scratch.points;
  const Light& light = *lit.lighting.lights[l].light;
  const Shadows& dark = lit.shaded.dark;
  const SurfaceMatrices& frame = this->Frames[p.instance[first]];
  std::uint8_t turned[TilePoints::Room];
  if (!this->Smooth[p.instance[first]] || !dark.knowsTerminator(l) ||
    !mayTurnAway(
      light, dark.grazing(), p, first, last, scratch.light.reached, scratch.light.dark, turned))
  {
    return;
  }
  for (int i = 0; i < last - first; ++i)
  {
    const int k = first + i;
    if (turned[i])
    {
      const TerminatorPoint at = atTerminator(frame, light, dark.grazing(), scratch.light.dark[i],
        p.point(k), { p.towardsX[k], p.towardsY[k], p.towardsZ[k] }, p.primitive[k]);
      if (at.kind != TerminatorPoint::Kind::Plain)
      {
        const float plain = darkness[i];
        darkness[i] = static_cast<Number>(dark.darkness(l, p.point(k), at, plain,
          this->Errors[p.instance[k]], dark.filters() ? scratch.extents[i] : 0.0, scratch.rays));
      }
    }
  }
}

/// Shadows of light l on points [first, last) of one instance that it reaches, and adds the light.
void PixelShader::shadowAndAdd(
  std::size_t l, const Lit& lit, int first, int last, Scratch& scratch) const
{
  const Shadows& dark = lit.shaded.dark;
  const TilePoints& points = scratch.points;
  TileLight& light = scratch.light;
  const int count = last - first;
  const double error = this->Errors[points.instance[first]];
  if (!dark.filters())
  {
    dark.dark(l, points, first, last, error, light.reached, light.dark, scratch.rays);
    this->shadowTerminator(l, lit, first, last, scratch, light.dark);
    for (int i = 0; i < count && this->FindsEdges; ++i)
    {
      darken(scratch.darkness[first + i], l, light.dark[i]);
    }
    addLight(lit.lighting.lights[l], lit.remaining, count, light);
    return;
  }
  for (int i = 0; i < count; ++i)
  {
    scratch.extents[i] = lit.samples ? 0.5 * worldPixel(lit.shaded.view, points.t[first + i]) : 0.0;
  }
  dark.darkness(l, points, first, last, error, scratch.extents, light.reached, scratch.missed);
  for (int i = 0; i < count; ++i)
  {
    light.dark[i] = scratch.missed[i] > 0.0f;
  }
  this->shadowTerminator(l, lit, first, last, scratch, scratch.missed);
  for (int i = 0; i < count; ++i)
  {
    light.share[i] = shareOfLight(scratch.missed[i], lit.remaining);
  }
  for (int i = 0; i < count && this->FindsEdges; ++i)
  {
    darken(scratch.darkness[first + i], l, scratch.missed[i]);
  }
  addShares(lit.lighting.lights[l], count, light);
}

/// Colours points [first, last) of one instance.
void PixelShader::lightInstance(
  const Lit& lit, int first, int last, bool hasColor, Scratch& scratch) const
{
  const Lighting& lighting = lit.lighting;
  const TilePoints& points = scratch.points;
  TileLight& light = scratch.light;
  const std::uint32_t index = points.instance[first];
  const Instance& instance = lit.shaded.scene.instances[index];
  const int count = last - first;
  std::fill_n(scratch.darkness + first, count, Darkness(0));
  if (instance.material.lighting && !lighting.lights.empty())
  {
    toViewSpace(lighting, points, first, last, light);
    for (std::size_t l = 0; l < lighting.lights.size(); ++l)
    {
      arriveLight(lighting, l, instance.material, count, light);
      if (instance.receiveShadow && lighting.lights[l].light->castShadow)
      {
        this->shadowAndAdd(l, lit, first, last, scratch);
      }
      else
      {
        std::fill_n(light.dark, count, std::uint8_t(0));
        addLight(lighting.lights[l], lit.remaining, count, light);
      }
    }
  }
  finishLight(lighting, instance.material, points, first, last, hasColor, light, scratch.colors);
}

void PixelShader::shadePoints(const Lit& lit, Scratch& scratch) const
{
  TilePoints& points = scratch.points;
  lookAtPoints(this->Frames, lit.shaded.view, points);
  for (int run = 0; run < points.runCount;)
  {
    const int first = points.runs[run].first;
    const std::uint32_t instance = points.runs[run].instance;
    const bool hasColor = points.runs[run].hasColor;
    int last = first;
    for (; run < points.runCount && points.runs[run].instance == instance; ++run)
    {
      last = points.runs[run].last;
    }
    this->lightInstance(lit, first, last, hasColor, scratch);
  }
  packColors(scratch.colors, points.count, scratch.rgba);
}

/// Writes a tile's points into the frame.
void PixelShader::write(const Lit& lit, int tileX, int tileY, const Scratch& scratch, Frame& frame)
{
  const TilePoints& points = scratch.points;
  const std::size_t corner = static_cast<std::size_t>(8 * tileY) * frame.width + 8 * tileX;
  for (int run = 0; run < points.runCount; ++run)
  {
    const TilePoints::Run& r = points.runs[run];
    const double offset = shownOffset(lit.shaded.scene.instances[r.instance], lit.shaded.view);
    for (int i = r.first; i < r.last; ++i)
    {
      const int k = points.pixel[i];
      const std::size_t pixel = corner + static_cast<std::size_t>(k >> 3) * frame.width + (k & 7);
      std::memcpy(frame.color.data() + 4 * pixel, scratch.rgba + i, 4);
      frame.depth[pixel] = static_cast<float>(std::clamp(points.window[i] + offset, 0.0, 1.0));
      frame.instance[pixel] = r.instance;
      frame.primitive[pixel] = points.primitive[i];
    }
  }
  for (int i = 0; lit.shaded.settings.writeNormals && i < points.count; ++i)
  {
    const int k = points.pixel[i];
    const std::size_t pixel = corner + static_cast<std::size_t>(k >> 3) * frame.width + (k & 7);
    const bool hasNormal = lit.shaded.scene.instances[points.instance[i]].material.lighting;
    const glm::vec3 normal = hasNormal
      ? lit.lighting.rotation * glm::vec3(points.normalX[i], points.normalY[i], points.normalZ[i])
      : glm::vec3(0.0f);
    std::copy(&normal[0], &normal[0] + 3, frame.normals.data() + 3 * pixel);
  }
  const auto positive = [](float v) { return v > 0.0f ? v : 0.0f; }; // not a number: no light
  for (int i = 0; lit.shaded.settings.writeLight && i < points.count; ++i)
  {
    const int k = points.pixel[i];
    const std::size_t pixel = corner + static_cast<std::size_t>(k >> 3) * frame.width + (k & 7);
    frame.light[3 * pixel] = positive(scratch.colors.r[i]);
    frame.light[3 * pixel + 1] = positive(scratch.colors.g[i]);
    frame.light[3 * pixel + 2] = positive(scratch.colors.b[i]);
  }
  const std::size_t tile =
    static_cast<std::size_t>(tileY) * lit.shaded.eye.depthBuffer().tilesX + tileX;
  for (int i = 0; this->FindsEdges && i < points.count; ++i)
  {
    this->DarkPixels[64 * tile + points.pixel[i]] = scratch.darkness[i];
  }
}

void PixelShader::shade(const ShadedScene& shaded, const ParallelFor& parallelFor, Frame& frame,
  FrameStatistics& statistics)
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
      TilePoints& points = scratch.points;
      takePoints(
        depth, shaded.view, tileX, tileY, [](std::uint32_t) { return true; },
        [&](std::uint32_t i) { return shaded.eye.base(i); }, points);
      if (points.count < TilePoints::Most)
      {
        wipeTile(frame, 8 * tileX, 8 * tileY);
      }
      if (points.count == 0) // hits beyond the border of the image only
      {
        return;
      }
      scratch.rays = 0;
      this->shadePoints(lit, scratch);
      if (scratch.rays > 0)
      {
        allRays.fetch_add(scratch.rays, std::memory_order_relaxed);
      }
      this->write(lit, tileX, tileY, scratch, frame);
    });
  statistics.shadowRays += allRays;
}
}
