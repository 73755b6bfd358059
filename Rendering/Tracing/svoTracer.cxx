#include "svoTracer.h"

#include "svoEdges.h"
#include "svoFrameTiles.h"
#include "svoLayeredView.h"
#include "svoSelect.h"
#include "svoShading.h"
#include "svoShadows.h"
#include "svoSurfacePoint.h"
#include "svoTileLighting.h"
#include "svoTilePoints.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>

namespace svo
{
namespace
{
double now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
}

struct Tracer::Internals
{
  FrameStatistics Statistics;
  std::vector<ShadowMap> Maps;
  LayeredView Eye;
  Shadows Dark;
  Scene AsLightsSee; // where that is not the frame's scene; for the length of a frame
  FrameTiles Tiles;
  std::vector<SurfaceFrame> Frames; // by index into Scene::instances
  bool FindsEdges = false;
  std::vector<Darkness> DarkPixels; // per pixel, as the depth buffer, where edges are to be found
  std::vector<double> Errors;       // world; of the instance's leaves as the eye sees them
  bool Shared = false;              // shadow buffers are traced, for all processes
  double SharedTime = 0.0;          // s, that took

  /// Calls body(tileX, tileY, scratch) for the tiles with hits.
  template <class Scratch, class Body>
  void eachTile(const ParallelFor& parallelFor, const Body& body)
  {
    const std::vector<std::uint32_t>& hits = this->Tiles.hits();
    const int tilesX = this->Eye.depthBuffer().tilesX;
    parallelFor(0, hits.size(), 32,
      [&](std::size_t first, std::size_t last)
      {
        Scratch scratch{};
        for (std::size_t k = first; k < last; ++k)
        {
          const int tile = static_cast<int>(hits[k]);
          body(tile % tilesX, tile / tilesX, scratch);
        }
      });
  }

  void describeInstances(const Scene& scene, ShadowTechnique technique);
  const Scene& sceneOfLights(const Scene& scene, ShadowTechnique technique);
  struct ShadeScratch;
  /// Shadows of light l on points [first, last) of one instance that it reaches, and adds the
  /// light.
  void shadowAndAdd(std::size_t l, const Lighting& lighting, float remaining, int first, int last,
    ShadeScratch& scratch, std::uint64_t& rays);
  /// Colours points [first, last) of one instance.
  void lightInstance(const Scene& scene, const Lighting& lighting, float remaining, int first,
    int last, bool hasColor, ShadeScratch& scratch, std::uint64_t& rays);
  void write(const Scene& scene, const Lighting& lighting, const FrameSettings& settings, int tileX,
    int tileY, ShadeScratch& scratch, Frame& frame);
  void markLightTiles(const Scene& scene, const View& view, const ParallelFor& parallelFor);
  void shadePixels(const Scene& scene, const View& view, const FrameSettings& settings,
    const ParallelFor& parallelFor, Frame& frame);
  void smoothEdges(const Scene& scene, const View& view, const FrameSettings& settings,
    const ParallelFor& parallelFor, Frame& frame);
};

void Tracer::Internals::describeInstances(const Scene& scene, ShadowTechnique technique)
{
  this->Frames.clear();
  this->Errors.clear();
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    const int level = this->Eye.level(static_cast<std::uint32_t>(i));
    const LeafGeometry geometry = this->Eye.leafGeometry(static_cast<std::uint32_t>(i));
    this->Frames.push_back(instance.octree ? SurfaceFrame(instance) : SurfaceFrame());
    this->Errors.push_back(!instance.octree  ? 0.0
        : technique == ShadowTechnique::Rays ? worldLeafError(instance, geometry, level)
                                             : worldMapError(instance, geometry, level));
  }
}

/// The scene with the octrees that shadow buffers are traced through.
const Scene& Tracer::Internals::sceneOfLights(const Scene& scene, ShadowTechnique technique)
{
  const auto differs = [](const Instance& instance)
  { return instance.casterOctree && instance.casterOctree.key() != instance.octree.key(); };
  if (technique != ShadowTechnique::Buffer ||
    std::none_of(scene.instances.begin(), scene.instances.end(), differs))
  {
    return scene;
  }
  this->AsLightsSee = scene;
  for (Instance& instance : this->AsLightsSee.instances)
  {
    if (instance.casterOctree)
    {
      instance.octree = instance.casterOctree;
    }
  }
  return this->AsLightsSee;
}

void Tracer::Internals::markLightTiles(
  const Scene& scene, const View& view, const ParallelFor& parallelFor)
{
  if (!this->Dark.wantsMarks())
  {
    return;
  }
  this->eachTile<TilePoints>(parallelFor,
    [&](int tileX, int tileY, TilePoints& points)
    {
      const auto receives = [&](std::uint32_t i)
      { return scene.instances[i].receiveShadow && scene.instances[i].material.lighting; };
      const auto baseOf = [&](std::uint32_t i) { return this->Eye.base(i); };
      if (takePoints(this->Eye.depthBuffer(), view, tileX, tileY, receives, baseOf, points))
      {
        placePoints(view, points);
        this->Dark.mark(points);
      }
    });
}

/// What a thread needs to shade a tile.
struct Tracer::Internals::ShadeScratch
{
  TilePoints points;
  TileLight light;
  TileColors colors;
  std::uint32_t rgba[TilePoints::Room];
  float missed[TilePoints::Room];      // by index of the point minus the first: of one light
  Darkness darkness[TilePoints::Most]; // by index of the point
};

void Tracer::Internals::shadowAndAdd(std::size_t l, const Lighting& lighting, float remaining,
  int first, int last, ShadeScratch& scratch, std::uint64_t& rays)
{
  const TilePoints& points = scratch.points;
  TileLight& light = scratch.light;
  const int count = last - first;
  const double error = this->Errors[points.instance[first]];
  if (!this->Dark.filters())
  {
    this->Dark.dark(l, points, first, last, error, light.reached, light.dark, rays);
    for (int i = 0; i < count && this->FindsEdges; ++i)
    {
      darken(scratch.darkness[first + i], l, light.dark[i]);
    }
    addLight(lighting.lights[l], remaining, count, light);
    return;
  }
  this->Dark.darkness(l, points, first, last, error, light.reached, scratch.missed);
  for (int i = 0; i < count; ++i)
  {
    light.share[i] = shareOfLight(scratch.missed[i], remaining);
  }
  for (int i = 0; i < count && this->FindsEdges; ++i)
  {
    darken(scratch.darkness[first + i], l, scratch.missed[i]);
  }
  addShares(lighting.lights[l], count, light);
}

void Tracer::Internals::lightInstance(const Scene& scene, const Lighting& lighting, float remaining,
  int first, int last, bool hasColor, ShadeScratch& scratch, std::uint64_t& rays)
{
  const TilePoints& points = scratch.points;
  TileLight& light = scratch.light;
  const std::uint32_t index = points.instance[first];
  const Instance& instance = scene.instances[index];
  const int count = last - first;
  std::fill_n(scratch.darkness + first, count, Darkness(0));
  if (instance.material.lighting && !lighting.lights.empty())
  {
    beginLight(lighting, points, first, last, light);
    for (std::size_t l = 0; l < lighting.lights.size(); ++l)
    {
      arriveLight(lighting, l, instance.material, count, light);
      if (instance.receiveShadow && lighting.lights[l].light->castShadow)
      {
        this->shadowAndAdd(l, lighting, remaining, first, last, scratch, rays);
      }
      else
      {
        std::fill_n(light.dark, count, std::uint8_t(0));
        addLight(lighting.lights[l], remaining, count, light);
      }
    }
  }
  finishLight(lighting, instance.material, points, first, last, hasColor, light, scratch.colors);
}

/// Writes a tile's points into the frame.
void Tracer::Internals::write(const Scene& scene, const Lighting& lighting,
  const FrameSettings& settings, int tileX, int tileY, ShadeScratch& scratch, Frame& frame)
{
  const TilePoints& points = scratch.points;
  packColors(scratch.colors, points.count, scratch.rgba);
  const std::size_t corner = static_cast<std::size_t>(8 * tileY) * frame.width + 8 * tileX;
  for (int run = 0; run < points.runCount; ++run)
  {
    const TilePoints::Run& r = points.runs[run];
    const double offset = scene.instances[r.instance].depthOffsetUnits;
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
  for (int i = 0; settings.writeNormals && i < points.count; ++i)
  {
    const int k = points.pixel[i];
    const std::size_t pixel = corner + static_cast<std::size_t>(k >> 3) * frame.width + (k & 7);
    const glm::vec3 normal =
      lighting.rotation * glm::vec3(points.normalX[i], points.normalY[i], points.normalZ[i]);
    std::copy(&normal[0], &normal[0] + 3, frame.normals.data() + 3 * pixel);
  }
  const std::size_t tile = static_cast<std::size_t>(tileY) * this->Eye.depthBuffer().tilesX + tileX;
  for (int i = 0; this->FindsEdges && i < points.count; ++i)
  {
    this->DarkPixels[64 * tile + points.pixel[i]] = scratch.darkness[i];
  }
}

void Tracer::Internals::shadePixels(const Scene& scene, const View& view,
  const FrameSettings& settings, const ParallelFor& parallelFor, Frame& frame)
{
  const DepthBuffer& depth = this->Eye.depthBuffer();
  const Lighting lighting(scene, view);
  const float remaining = static_cast<float>(1.0 - settings.shadowIntensity);
  std::atomic<std::uint64_t> allRays{ 0 };
  this->FindsEdges = settings.antiAliasing;
  if (this->FindsEdges)
  {
    this->DarkPixels.resize(depth.instance.size());
  }
  this->eachTile<ShadeScratch>(parallelFor,
    [&](int tileX, int tileY, ShadeScratch& scratch)
    {
      TilePoints& points = scratch.points;
      takePoints(
        depth, view, tileX, tileY, [](std::uint32_t) { return true; },
        [&](std::uint32_t i) { return this->Eye.base(i); }, points);
      if (points.count < TilePoints::Most)
      {
        wipeTile(frame, 8 * tileX, 8 * tileY);
      }
      if (points.count == 0) // hits beyond the border of the image only
      {
        return;
      }
      lookAtPoints(this->Frames, view, points);
      std::uint64_t rays = 0;
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
        this->lightInstance(scene, lighting, remaining, first, last, hasColor, scratch, rays);
      }
      if (rays > 0)
      {
        allRays.fetch_add(rays, std::memory_order_relaxed);
      }
      this->write(scene, lighting, settings, tileX, tileY, scratch, frame);
    });
  this->Statistics.shadowRays += allRays;
}

void Tracer::Internals::smoothEdges(const Scene& scene, const View& view,
  const FrameSettings& settings, const ParallelFor& parallelFor, Frame& frame)
{
  // A rotated grid: four points of a pixel that share no row and no column.
  constexpr double OffsetX[4] = { 0.375, 0.875, 0.125, 0.625 };
  constexpr double OffsetY[4] = { 0.125, 0.375, 0.625, 0.875 };
  const DepthBuffer& depth = this->Eye.depthBuffer();
  const EdgeFinder edges(depth, this->Eye, this->DarkPixels, view);
  const Lighting lighting(scene, view);
  const float remaining = static_cast<float>(1.0 - settings.shadowIntensity);
  std::atomic<std::uint64_t> primaryRays{ 0 };
  std::atomic<std::uint64_t> shadowRays{ 0 };
  const auto smoothTile = [&](std::size_t tile)
  {
    const int tileX = static_cast<int>(tile % depth.tilesX);
    const int tileY = static_cast<int>(tile / depth.tilesX);
    int pixels[64];
    const int count = edges.find(tileX, tileY, pixels);
    std::uint64_t rays = 0;
    for (int first = 0; first < count; first += 16)
    {
      Samples samples;
      for (int k = 0; k < 64; ++k)
      {
        const int pixel = pixels[std::min(first + k / 4, count - 1)];
        samples.x[k] = 8 * tileX + (pixel & 7) + OffsetX[k % 4];
        samples.y[k] = 8 * tileY + (pixel >> 3) + OffsetY[k % 4];
      }
      this->Eye.sample(tileX, tileY, samples);
      primaryRays.fetch_add(64, std::memory_order_relaxed);
      for (int p = 0; p < std::min(16, count - first); ++p)
      {
        glm::vec3 sum(0.0f);
        int hits = 0;
        for (int k = 4 * p; k < 4 * p + 4; ++k)
        {
          const std::uint32_t i = samples.instance[k];
          if (i == NoInstance)
          {
            continue;
          }
          ++hits;
          const double extent = 0.5 * worldPixel(view, samples.t[k]);
          const SurfacePoint point = surfacePoint(
            this->Frames[i], view, samples.x[k], samples.y[k], samples.t[k], samples.primitive[k]);
          sum += glm::clamp(
            shade(lighting, scene.instances[i], point, remaining,
              [&](std::size_t light)
              { return this->Dark.darkness(light, point, this->Errors[i], extent, rays); }),
            0.0f, 1.0f);
        }
        const int x = 8 * tileX + (pixels[first + p] & 7);
        const int y = 8 * tileY + (pixels[first + p] >> 3);
        std::uint8_t* rgba =
          frame.color.data() + 4 * (static_cast<std::size_t>(y) * view.width + x);
        for (int c = 0; c < 3 && hits > 0; ++c)
        {
          rgba[c] = toByte(sum[c] / static_cast<float>(hits));
        }
      }
    }
    shadowRays.fetch_add(rays, std::memory_order_relaxed);
  };
  parallelFor(0, this->Tiles.hits().size(), 32,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t k = first; k < last; ++k)
      {
        smoothTile(this->Tiles.hits()[k]);
      }
    });
  this->Statistics.primaryRays += primaryRays;
  this->Statistics.shadowRays += shadowRays;
}

Tracer::Tracer()
  : Impl(new Internals)
{
}

Tracer::~Tracer() = default;

void Tracer::render(const Scene& scene, const View& view, const FrameSettings& settings,
  const ParallelFor& parallelFor, Frame& frame)
{
  Internals& self = *this->Impl;
  const double start = now();
  self.Statistics = FrameStatistics();
  self.Maps.clear();

  LayerBudget budget{ settings.layerMemoryLimit, self.Eye.layerMemory() + self.Dark.layerMemory() };

  // Depth layers of the eye, merged.
  self.Eye.begin(
    scene, view, [](const Instance& instance) { return instance.visible; },
    [&](const Instance& instance, const LocalView& local)
    { return selectLevel(instance, local, view, settings.pixelError); },
    settings.frameCoherence, budget);
  self.Eye.trace(parallelFor, nullptr);
  self.Tiles.begin(self.Eye.depthBuffer(), view, settings.writeNormals, frame);

  // What visible points will look up of the lights.
  self.describeInstances(scene, settings.shadowTechnique);
  const bool shared = self.Shared && settings.shadowTechnique == ShadowTechnique::Buffer;
  if (!shared)
  {
    self.Dark.begin(
      self.sceneOfLights(scene, settings.shadowTechnique), settings, self.Eye, budget);
    self.markLightTiles(scene, view, parallelFor);
  }

  // Shadow layers, merged likewise.
  const double shadowStart = now();
  if (!shared)
  {
    self.Dark.trace(parallelFor);
  }
  if (settings.wholeShadowBuffers)
  {
    self.Dark.copyMaps(self.Maps);
  }
  double shadowTime = now() - shadowStart;

  // Shade and test.
  const double shadeStart = now();
  self.shadePixels(scene, view, settings, parallelFor, frame);
  if (settings.antiAliasing)
  {
    self.smoothEdges(scene, view, settings, parallelFor, frame);
  }
  if (settings.shadowTechnique == ShadowTechnique::Rays)
  {
    shadowTime += now() - shadeStart; // the rays are nearly all of it
  }

  self.AsLightsSee = Scene();
  FrameStatistics& statistics = self.Statistics;
  self.Dark.addStatistics(statistics);
  statistics.primaryRays += self.Eye.rays();
  statistics.retracedLayers += self.Eye.retracedLayers();
  statistics.layerMemory = self.Eye.layerMemory() + self.Dark.layerMemory();
  statistics.shadowTime = shadowTime + self.SharedTime;
  statistics.traceTime = now() - start - shadowTime;
  self.Shared = false;
  self.SharedTime = 0.0;
}

bool Tracer::shareShadows(const Scene& scene, const FrameSettings& settings,
  const ParallelFor& parallelFor, Processes& processes)
{
  Internals& self = *this->Impl;
  const double start = now();
  LayerBudget budget{ settings.layerMemoryLimit, self.Eye.layerMemory() + self.Dark.layerMemory() };
  self.Shared = self.Dark.traceShared(
    self.sceneOfLights(scene, settings.shadowTechnique), settings, budget, parallelFor, processes);
  self.SharedTime = now() - start;
  return self.Shared;
}

const FrameStatistics& Tracer::statistics() const
{
  return this->Impl->Statistics;
}

const std::vector<ShadowMap>& Tracer::shadowMaps() const
{
  return this->Impl->Maps;
}

void Tracer::releaseLayers()
{
  this->Impl->Eye.release();
  this->Impl->Dark.release();
  this->Impl->Shared = false;
}
}
