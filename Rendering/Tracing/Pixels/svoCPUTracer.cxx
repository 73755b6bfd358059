#include "svoCPUTracer.h"

#include "svoFrameErrors.h"
#include "svoFrameInputs.h"
#include "svoFrameTiles.h"
#include "svoInstanceTree.h"
#include "svoLayeredView.h"
#include "svoLightImages.h"
#include "svoLightSampler.h"
#include "svoNeededLevels.h"
#include "svoPixelShader.h"
#include "svoReceiverSampler.h"
#include "svoSampleCount.h"
#include "svoSceneChanges.h"
#include "svoSelectLevel.h"
#include "svoShadedTiles.h"
#include "svoShadows.h"
#include "svoSilhouetteFinder.h"
#include "svoStaleTiles.h"
#include "svoTilePatch.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <iterator>
#include <utility>

namespace svo
{
namespace
{
double now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Divides a frame into phases.
class PhaseClock
{
public:
  /// The phase that ends now began where the last one ended.
  PhaseTime end()
  {
    const PhaseTime last{ now() - this->Wall,
      static_cast<double>(std::clock() - this->Processor) / CLOCKS_PER_SEC };
    *this = PhaseClock();
    return last;
  }

private:
  double Wall = now();
  std::clock_t Processor = std::clock();
};
}

struct CPUTracer::Internals
{
  FrameSettings Settings; // of the last frame
  Frame Picture;
  FrameStatistics Statistics;
  std::vector<ShadowMap> Maps;
  SceneFollower Instances;
  std::vector<std::uint32_t> Changed; // of them, by index, since the last frame
  InstanceTree Tree;
  LayeredView Eye;
  Shadows LightShadows;
  Scene AsLightsSee; // where that is not the frame's scene; for the length of a frame
  FrameTiles Tiles;
  LightImages Sampled;
  ReceiverSampler Receivers;
  PixelShader Shader;
  FrameInputs Inputs;
  ShadedTiles Shaded;             // by tile of the eye
  std::vector<CasterBox> Casters; // by index into Scene::instances
  int Samples = 0;                // of lights, in the picture
  UsualOcclusionDistance UsualDistance;
  bool ViewsAreTraced = true; // of this frame; else they were not needed
  bool SharesBuffers = false; // shadow buffers are traced, for all processes
  double SharingTime = 0.0;   // s, that took

  void follow(const Scene& scene, const ParallelFor& parallelFor);
  void cull(const FrameSettings& settings);
  const Scene& sceneOfLights(const Scene& scene, ShadowTechnique technique);
  void markLightTiles(const Scene& scene, const View& view, const ParallelFor& parallelFor);
  void sampleLights(const ShadedScene& shaded, bool more, const ParallelFor& parallelFor,
    FrameStatistics& statistics);
  void traceViews(const Scene& scene, const View& view, const FrameSettings& settings,
    const ParallelFor& parallelFor, const FrameChanges& changes, Frame* frame,
    FrameStatistics& statistics);
  void traceLeftOut(const Scene& scene, const View& view, const ParallelFor& parallelFor);
};

/// Finds what has changed.
void CPUTracer::Internals::follow(const Scene& scene, const ParallelFor& parallelFor)
{
  const SceneChanges changes = this->Instances.follow(scene);
  this->Tree.follow(scene, changes, parallelFor);
  std::vector<std::uint32_t>& all = this->Changed;
  const std::vector<std::uint32_t> before = std::move(all);
  all.clear();
  std::set_union(before.begin(), before.end(), changes.instances.begin(), changes.instances.end(),
    std::back_inserter(all));
  all.erase(std::lower_bound(all.begin(), all.end(), changes.count), all.end()); // they are gone
}

/// Says how the instances of a frame are culled.
void CPUTracer::Internals::cull(const FrameSettings& settings)
{
  Culling culling;
  culling.tree = settings.viewCulling ? this->Tree.tree() : nullptr;
  culling.occlusion = settings.occlusionCulling;
  this->LightShadows.setCulling(culling);
  culling.leastPixels = settings.detailThreshold;
  this->Eye.setCulling(culling);
}

/// The scene with the octrees that shadow buffers are traced through.
const Scene& CPUTracer::Internals::sceneOfLights(const Scene& scene, ShadowTechnique technique)
{
  const auto differs = [](const Instance& instance)
  {
    return instance.body->casterOctree &&
      instance.body->casterOctree.key() != instance.body->octree.key();
  };
  if (technique != ShadowTechnique::Buffer ||
    std::none_of(scene.instances.begin(), scene.instances.end(), differs))
  {
    return scene;
  }
  this->AsLightsSee = scene;
  this->AsLightsSee.version = 0;
  Shared<Body> seen, lit; // once for all copies
  for (Instance& instance : this->AsLightsSee.instances)
  {
    if (instance.body->casterOctree)
    {
      if (!instance.body.same(seen))
      {
        seen = lit = instance.body;
        lit.own().octree = seen->casterOctree;
      }
      instance.body = lit;
    }
  }
  return this->AsLightsSee;
}

void CPUTracer::Internals::markLightTiles(
  const Scene& scene, const View& view, const ParallelFor& parallelFor)
{
  if (!this->LightShadows.wantsMarks())
  {
    for (const std::uint32_t index : this->Tiles.hits())
    {
      if (this->Shaded.stale(index))
      {
        this->Shaded[index].looksUp.clear();
      }
    }
    return;
  }
  const bool sameMaps = this->LightShadows.sameMaps();
  this->Tiles.each<TilePatch>(parallelFor,
    [&](int tileX, int tileY, TilePatch& patch)
    {
      const std::size_t index = this->Shaded.index(tileX, tileY);
      ShadedTiles::Tile& tile = this->Shaded[index];
      if (sameMaps && !this->Shaded.stale(index))
      {
        this->LightShadows.mark(tile.looksUp);
        return;
      }
      tile.looksUp.clear();
      eachPatch(
        view, hitsOfTile(this->Eye.hits().depth, view, tileX, tileY),
        [&](std::uint32_t i)
        { return scene.instances[i].receiveShadow && scene.instances[i].material.lighting; },
        [&](std::uint32_t i) { return this->Eye.hits().base(i); }, patch,
        [&](const TilePatch&) { this->LightShadows.mark(patch, tile.looksUp); });
    });
}

/// What shading reads of lights that are sampled. `more`: the last frame's samples are among them.
void CPUTracer::Internals::sampleLights(
  const ShadedScene& shaded, bool more, const ParallelFor& parallelFor, FrameStatistics& statistics)
{
  const bool filtered = shaded.settings.filterLightSamples;
  const DepthBuffer& depth = shaded.eye.depth;
  this->Sampled.begin(shaded.shadows.sampledPlanes(), depth.grid.tilesX, depth.grid.tilesY,
    depth.hit.data(), shaded.settings.lightSamples, more);
  if (!this->Sampled.sampled().any())
  {
    return;
  }
  svo::sampleLights(
    shaded, this->Shader.points(), parallelFor, this->Shaded, this->Sampled, statistics);
  if (filtered)
  {
    this->Shaded.spread();
  }
  this->Sampled.findMeans(parallelFor, filtered,
    [this](int x, int y) { return this->Shaded.shadedAnew(this->Shaded.index(x, y)); });
}

CPUTracer::CPUTracer()
  : Impl(new Internals)
{
}

CPUTracer::~CPUTracer() = default;

std::unique_ptr<Tracer> makeCPUTracer()
{
  return std::make_unique<CPUTracer>();
}

std::vector<NeededLevels> CPUTracer::neededLevels(
  const Scene& scene, const View& view, const FrameSettings& settings) const
{
  return svo::neededLevels(scene, view, settings);
}

/// The depth buffers of the eye and of the lights, and all that shading needs besides. `frame`: to
/// be prepared for shading, or null. Sets the phases' times.
void CPUTracer::Internals::traceViews(const Scene& scene, const View& view,
  const FrameSettings& settings, const ParallelFor& parallelFor, const FrameChanges& changes,
  Frame* frame, FrameStatistics& statistics)
{
  PhaseClock clock;
  this->Maps.clear();
  LayerBudget budget{ settings.layerMemoryLimit,
    this->Eye.layerMemory() + this->LightShadows.layerMemory() };

  // Depth layers of the eye, merged.
  this->cull(settings);
  this->Eye.prepare(
    scene, view, [](const Instance& instance) { return instance.visible; },
    [&](const Instance& instance, const LocalView& local)
    { return selectEyeLevel(instance, local, view, settings.pixelError); },
    settings.frameCoherence, budget, parallelFor);
  this->Eye.trace(parallelFor, nullptr);
  const bool sameFrame = frame && this->Tiles.find(this->Eye.hits().depth, view, settings, *frame);
  // Edges are smoothed over the tiles' borders.
  findStaleTiles(this->Eye.hits(), changes.instances,
    changes.all || !sameFrame || this->Settings.antiAliasing, this->Shaded);
  statistics.eye = clock.end();

  // What visible points will look up of the lights.
  this->Shader.prepare(scene, this->Eye.hits());
  const bool shared = this->SharesBuffers && settings.shadowTechnique == ShadowTechnique::Buffer;
  if (!shared)
  {
    const Scene& seen = this->sceneOfLights(scene, settings.shadowTechnique);
    this->LightShadows.choose(scene, seen, view, settings);
    this->LightShadows.prepare(seen, view, this->Eye.hits(), settings, budget, parallelFor);
  }
  this->LightShadows.prepareAnswers(scene, view, this->Eye.hits(), settings);
  if (!shared)
  {
    this->markLightTiles(scene, view, parallelFor);
  }
  statistics.mark = clock.end();

  // Shadow layers, merged likewise.
  if (!shared)
  {
    this->LightShadows.trace(parallelFor);
  }
  if (settings.handsOutMaps())
  {
    this->LightShadows.copyMaps(this->Maps);
  }
  this->AsLightsSee = Scene();
  statistics.lights = clock.end();
}

/// Has what the last frame did not need.
void CPUTracer::Internals::traceLeftOut(
  const Scene& scene, const View& view, const ParallelFor& parallelFor)
{
  if (!this->ViewsAreTraced)
  {
    FrameStatistics later; // the frame's own have been told
    this->traceViews(scene, view, this->Settings, parallelFor, FrameChanges(), nullptr, later);
    this->ViewsAreTraced = true;
  }
}

Frame& CPUTracer::frame()
{
  return this->Impl->Picture;
}

void CPUTracer::render(
  const Scene& scene, const View& view, const FrameSettings& asked, const ParallelFor& parallelFor)
{
  Internals& self = *this->Impl;
  FrameSettings settings = asked;
  if (settings.ambientOcclusion && settings.ambientOcclusionDistance <= 0.0)
  {
    settings.ambientOcclusionDistance = self.UsualDistance.of(scene);
  }
  Frame& frame = self.Picture;
  PhaseClock clock;
  FrameStatistics& statistics = self.Statistics;
  self.follow(scene, parallelFor);
  FrameChanges changes{ self.Inputs.differ(scene, view, settings),
    std::exchange(self.Changed, {}) };
  const bool keeps = settings.frameCoherence && !self.SharesBuffers;
  changes.all = changes.all || !keeps;
  const SampleCount samples(scene, settings, changes, self.Samples);
  changes.all = changes.all || samples.other;
  settings.lightSamples = self.Samples = samples.count;
  self.Settings = settings;
  std::vector<std::uint8_t> coarser;
  if (samples.refined)
  {
    coarser = frame.color;
  }
  self.ViewsAreTraced = !changes.none();
  if (!self.ViewsAreTraced)
  {
    static_cast<FrameCounts&>(statistics) = FrameCounts();
    statistics.mark = statistics.lights = statistics.shade = PhaseTime();
    statistics.shadowTime = statistics.samplingTime = 0.0;
    statistics.eye = clock.end();
    statistics.traceTime = statistics.eye.wall;
    return;
  }
  statistics = FrameStatistics();
  statistics.lightSamples = samples.count;
  self.traceViews(scene, view, settings, parallelFor, changes, &frame, statistics);
  clock.end(); // its phases have been timed
  findDarkenedTiles(
    scene, changes, self.LightShadows, self.Tiles.hits(), self.Casters, parallelFor, self.Shaded);

  // Shade and test.
  const ShadedScene shaded{ { scene, view, settings, self.Eye.hits(), self.LightShadows }, self.Eye,
    self.Tiles };
  self.Shaded.forget(self.Tiles.hits());
  const double before = now();
  self.sampleLights(shaded, samples.refined, parallelFor, statistics);
  self.Receivers.begin(self.LightShadows.sampledPlanes(), !samples.refined, samples.refined);
  statistics.samplingTime = now() - before;
  statistics.lightNoise = 255.0 * self.Sampled.noise().rms();
  self.Shader.shade(shaded, self.Sampled, parallelFor, self.Shaded, frame, statistics);
  if (settings.antiAliasing)
  {
    self.Shader.smoothEdges(shaded, parallelFor, frame, statistics);
  }
  if (samples.refined)
  {
    statistics.lightError = differenceOf(coarser, frame.color);
  }
  statistics.shade = clock.end();
  self.LightShadows.addStatistics(statistics);
  // Where there are shadow rays, they are nearly all of it.
  double& shadeTime = statistics.askedCasters() ? statistics.shadowTime : statistics.traceTime;
  shadeTime = statistics.shade.wall;
  statistics.traceTime += statistics.eye.wall + statistics.mark.wall;
  statistics.shadowTime += statistics.lights.wall + self.SharingTime;

  if (!keeps)
  {
    self.Inputs.forget();
  }
  statistics.primaryRays += self.Eye.rays();
  statistics.retracedLayers += self.Eye.retracedLayers();
  const VisibleSet& set = self.Eye.visibleSet();
  statistics.outsideInstances = self.Tree.shown() - set.visible.size() - set.small;
  statistics.hiddenInstances = self.Eye.spared().hidden;
  statistics.smallInstances = set.small;
  statistics.largestSmallInstance = set.largestSmall;
  findErrors(
    scene, view, self.Eye.hits(), settings.shadowTechnique != ShadowTechnique::None, statistics);
  statistics.layerMemory = self.Eye.layerMemory() + self.LightShadows.layerMemory();
  self.SharesBuffers = false;
  self.SharingTime = 0.0;
}

bool CPUTracer::shareShadows(const Scene& scene, const View& view, const FrameSettings& settings,
  const ParallelFor& parallelFor, Processes& processes)
{
  Internals& self = *this->Impl;
  const double start = now();
  LayerBudget budget{ settings.layerMemoryLimit,
    self.Eye.layerMemory() + self.LightShadows.layerMemory() };
  self.follow(scene, parallelFor);
  self.cull(settings);
  self.SharesBuffers =
    self.LightShadows.traceShared(self.sceneOfLights(scene, settings.shadowTechnique), view,
      settings, budget, parallelFor, processes);
  self.SharingTime = now() - start;
  return self.SharesBuffers;
}

void CPUTracer::divideEdges(const Scene& scene, const View& view,
  const std::vector<glm::vec2>& positions, const ParallelFor& parallelFor,
  Silhouettes& result) const
{
  Internals& self = *this->Impl;
  self.traceLeftOut(scene, view, parallelFor);
  findSilhouettes(
    { { scene, view, self.Settings, self.Eye.hits(), self.LightShadows }, self.Eye, self.Tiles },
    self.Shader, self.Sampled, self.Picture, positions, parallelFor, result);
}

const ReceiverShares& CPUTracer::receiverShares() const
{
  return this->Impl->Receivers.shares();
}

void CPUTracer::sampleReceivers(const Scene& scene, const View& view, const ReceiverPlaces& places,
  bool same, const ParallelFor& parallelFor)
{
  Internals& self = *this->Impl;
  const double start = now();
  self.traceLeftOut(scene, view, parallelFor);
  self.Statistics.shadowRays += self.Receivers.sample(
    { scene, view, self.Settings, self.Eye.hits(), self.LightShadows }, places, same, parallelFor);
  const double seconds = now() - start;
  FrameStatistics& statistics = self.Statistics;
  statistics.samplingTime += seconds;
  (statistics.askedCasters() ? statistics.shadowTime : statistics.traceTime) += seconds;
  SampleNoise noise = self.Sampled.noise();
  noise.add(self.Receivers.noise());
  statistics.lightNoise = 255.0 * noise.rms();
  statistics.lightError = std::max(statistics.lightError, self.Receivers.shares().error);
}

const FrameStatistics& CPUTracer::statistics() const
{
  return this->Impl->Statistics;
}

const std::vector<ShadowMap>& CPUTracer::shadowMaps() const
{
  return this->Impl->Maps;
}

void CPUTracer::releaseLayers()
{
  this->Impl->Eye.release();
  this->Impl->LightShadows.release();
  this->Impl->SharesBuffers = false;
  this->Impl->ViewsAreTraced = false;
  this->Impl->Inputs.forget();
  this->Impl->Receivers = ReceiverSampler();
}
}
