#include "svoShadows.h"

#include "svoBufferShadow.h"
#include "svoRayShadow.h"
#include "svoSoftShadow.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace svo
{
/// Rasterised surfaces look up buffers whatever is traced.
bool Shadows::usesBuffer(std::size_t light, const FrameSettings& settings) const
{
  return this->Techniques[light] == ShadowTechnique::Buffer ||
    (this->byRays(light) && settings.handsOutMaps() &&
      (settings.sampledMaps || !this->sampled(light)));
}

void Shadows::chooseAll(const Scene& scene, ShadowTechnique technique)
{
  this->Techniques.clear();
  this->Soft.clear();
  for (const Light& light : scene.lights)
  {
    // Shadows of lights with a size are found by rays alone.
    const bool soft = light.soft() && technique != ShadowTechnique::None;
    this->Techniques.push_back(!light.castShadow ? ShadowTechnique::None
        : soft                                   ? ShadowTechnique::Rays
                                                 : technique);
    this->Soft.push_back(light.castShadow && soft);
  }
}

void Shadows::choose(
  const Scene& scene, const Scene& seen, const View& view, const FrameSettings& settings)
{
  this->chooseAll(scene, settings.shadowTechnique);
  this->Maps.assign(seen.lights.size(), {});
  bool uses = false;
  for (std::size_t l = 0; l < seen.lights.size(); ++l)
  {
    uses = uses || this->usesBuffer(l, settings);
  }
  if (!uses)
  {
    this->Fitted.clear();
    this->FittedVersion = 0;
    return;
  }
  // The version says nothing of receivers.
  const bool same = seen.version != 0 && seen.version == this->FittedVersion;
  this->Fitted = outlinesOf(seen, same ? std::move(this->Fitted) : std::vector<Outline>());
  this->FittedVersion = seen.version;
  this->Maps = mapsOfLights(this->Fitted, seen.lights, settings, view);
}

void Shadows::prepare(const Scene& scene, const View& view, const Hits& eye,
  const FrameSettings& settings, LayerBudget& budget, const ParallelFor& parallelFor)
{
  this->Filters = settings.filters();
  this->Samples = settings.antiAliasing;
  this->TracesWhole = settings.wholeShadowBuffers || this->Samples;
  this->SharedState.clear();
  this->prepareBuffers(scene, scene.lights, this->Maps, 0, settings, budget, parallelFor);
  if (settings.receiverMaps && !this->TracesWhole)
  {
    const SeenReceivers receivers(scene.receivers, view, eye);
    this->eachBuffer([&](ShadowBuffer& buffer) { buffer.mark(receivers); });
  }
}

void Shadows::prepareAnswers(
  const Scene& scene, const View& view, const Hits& eye, const FrameSettings& settings)
{
  const bool anyByRays =
    std::count(this->Techniques.begin(), this->Techniques.end(), ShadowTechnique::Rays) > 0;
  this->OfLights.clear();
  this->releaseRays();
  if (anyByRays || settings.asksHemispheres() ||
    (this->Casting && std::any_of(scene.instances.begin(), scene.instances.end(), isSmooth)))
  {
    this->Casters = std::make_unique<RayCasters>(scene, eye.instances, this->Cull.tree);
    this->Rays = std::make_unique<ShadowRays>(*this->Casters);
  }
  if (settings.ambientOcclusion)
  {
    this->Occlusion =
      std::make_unique<HemisphereRays>(*this->Casters, settings.ambientOcclusionDistance,
        PixelRotations(view, HemisphereRays::OcclusionStream), settings.lightSamples);
  }
  if (settings.skyLight)
  {
    constexpr double Beyond = 1e100; // all
    this->Sky = std::make_unique<HemisphereRays>(*this->Casters, Beyond,
      PixelRotations(view, HemisphereRays::SkyStream), settings.lightSamples,
      settings.skyPicture.get());
  }
  for (std::size_t l = 0; l < scene.lights.size(); ++l)
  {
    const Light& light = scene.lights[l];
    const LightBuffers* const maps = this->Buffers[l];
    if (this->sampled(l))
    {
      this->OfLights.push_back(std::make_unique<SoftShadow>(light, *this->Rays, *this->Casters,
        PixelRotations(view, static_cast<unsigned>(l)), settings.lightSamples, maps));
    }
    else if (this->byRays(l))
    {
      this->OfLights.push_back(std::make_unique<RayShadow>(light, *this->Rays, maps));
    }
    else if (maps)
    {
      this->OfLights.push_back(
        std::make_unique<BufferShadow>(light, *maps, this->Rays.get(), this->Filters));
    }
    else
    {
      this->OfLights.push_back(std::make_unique<LightShadow>());
    }
  }
}

void Shadows::prepareBuffers(const Scene& scene, const std::vector<Light>& lights,
  const std::vector<LightMaps>& maps, std::size_t first, const FrameSettings& settings,
  LayerBudget& budget, const ParallelFor& parallelFor)
{
  this->OfLights.clear(); // they borrow buffers
  this->Widths = TexelWidths();
  this->Traced = true;
  this->BuffersBefore.assign(this->Buffers.begin(), this->Buffers.end());
  this->Buffers.assign(lights.size(), nullptr);
  std::map<std::uint64_t, std::unique_ptr<LightBuffers>> kept;
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    const Light& light = lights[i];
    if (!light.castShadow || !this->usesBuffer(i, settings))
    {
      continue;
    }
    std::uint64_t id = light.id;
    while (kept.count(id) > 0) // two lights of one id are still two lights
    {
      ++id;
    }
    std::unique_ptr<LightBuffers>& buffers = kept[id];
    const auto found = this->Kept.find(id);
    buffers =
      found != this->Kept.end() ? std::move(found->second) : std::make_unique<LightBuffers>();
    buffers->prepare(i, scene, maps[i], first, settings, this->Cull, budget, parallelFor);
    this->Buffers[i] = buffers.get();
    this->Widths.add(maps[i], settings);
  }
  this->Kept = std::move(kept);
  this->Casting = !this->Kept.empty();
  if (this->TracesWhole)
  {
    this->eachBuffer([](ShadowBuffer& buffer) { buffer.markAll(); });
  }
}

void Shadows::releaseRays()
{
  this->Occlusion.reset();
  this->Sky.reset();
  this->Rays.reset();
  this->Casters.reset();
}

void Shadows::release()
{
  this->OfLights.clear();
  this->releaseRays();
  this->Kept.clear();
  this->Buffers.clear();
  this->SharedState.clear();
}

void Shadows::mark(const TilePatch& patch, LightTiles& noted) const
{
  assert(this->OfLights.size() == this->Buffers.size());
  for (const auto& light : this->OfLights)
  {
    light->mark(patch, noted);
  }
}

void Shadows::mark(const LightTiles& noted) const
{
  for (const LightTile& tile : noted)
  {
    this->of(tile.light).bufferOf(tile).mark(tile);
  }
}

bool Shadows::sameMaps() const
{
  return this->Buffers.size() == this->BuffersBefore.size() &&
    std::equal(this->Buffers.begin(), this->Buffers.end(), this->BuffersBefore.begin(),
      [](const LightBuffers* now, const LightBuffers* before)
      { return now == before && (!now || now->sameMaps()); });
}

bool Shadows::changedSince(const LightTiles& noted, std::uint64_t version) const
{
  return std::any_of(noted.begin(), noted.end(),
    [=](const LightTile& tile)
    { return this->of(tile.light).bufferOf(tile).changedSince(tile, version); });
}

bool Shadows::changedSince(const RaisedTiles& noted, std::uint64_t version) const
{
  return std::any_of(noted.begin(), noted.end(),
    [=](const RaisedTile& raised)
    {
      const ShadowBuffer& buffer = this->of(raised.tile.light).bufferOf(raised.tile);
      return buffer.wants(raised.tile) != raised.wanted ||
        (raised.wanted && buffer.changedSince(raised.tile, version));
    });
}

void Shadows::trace(const ParallelFor& parallelFor) const
{
  assert(this->OfLights.size() == this->Buffers.size());
  for (const auto& light : this->OfLights)
  {
    light->trace(parallelFor);
  }
}

SampledPlanes Shadows::sampledPlanes() const
{
  SampledPlanes planes;
  for (const std::uint8_t soft : this->Soft)
  {
    planes.ofLights.push_back(soft ? planes.count++ : SampledPlanes::None);
  }
  if (this->Occlusion)
  {
    planes.ofOcclusion = planes.count++;
  }
  if (this->Sky)
  {
    planes.ofSky = planes.count;
    planes.count += 3;
  }
  return planes;
}

bool Shadows::knows(const glm::dvec3& position) const
{
  return this->TracesWhole ||
    std::all_of(this->OfLights.begin(), this->OfLights.end(),
      [&](const auto& light) { return light->knows(position); });
}

std::size_t Shadows::layerMemory() const
{
  std::size_t sum = 0;
  for (const auto& kept : this->Kept)
  {
    kept.second->each([&](const ShadowBuffer& buffer) { sum += buffer.layerMemory(); });
  }
  return sum;
}

void Shadows::addStatistics(FrameStatistics& statistics) const
{
  this->Widths.tell(statistics);
  for (const auto& light : this->OfLights)
  {
    light->addStatistics(this->Traced, statistics);
  }
}

void Shadows::copyMaps(std::vector<ShadowMap>& maps) const
{
  for (const LightBuffers* const ofLight : this->Buffers)
  {
    if (ofLight)
    {
      ofLight->copyMaps(maps);
    }
  }
}
}
