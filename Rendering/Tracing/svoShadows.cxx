#include "svoShadows.h"

namespace svo
{
void Shadows::begin(
  const Scene& scene, const FrameSettings& settings, const LayeredView& eye, LayerBudget& budget)
{
  // Subsamples of a pixel may look up what no pixel's centre does.
  this->All = settings.wholeShadowBuffers || settings.antiAliasing;
  this->Shared.clear();
  this->beginBuffers(
    scene, scene.lights, { outlinesOf(scene), 0, settings.wholeShadowBuffers }, settings, budget);
  if (settings.shadowTechnique == ShadowTechnique::Rays)
  {
    this->Rays = std::make_unique<ShadowRays>(scene, eye);
  }
}

void Shadows::beginBuffers(const Scene& scene, const std::vector<Light>& lights,
  const Outlines& outlines, const FrameSettings& settings, LayerBudget& budget)
{
  this->Of = &scene;
  this->Traced = true;
  this->Buffers.assign(lights.size(), nullptr);
  this->Rays.reset();
  std::unordered_map<std::uint64_t, std::unique_ptr<ShadowBuffer>> kept;
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    const Light& light = lights[i];
    if (settings.shadowTechnique != ShadowTechnique::Buffer || !light.castShadow)
    {
      continue;
    }
    std::uint64_t id = light.id;
    while (kept.count(id)) // two lights of one id are still two lights
    {
      ++id;
    }
    std::unique_ptr<ShadowBuffer>& buffer = kept[id];
    const auto found = this->Kept.find(id);
    buffer =
      found != this->Kept.end() ? std::move(found->second) : std::make_unique<ShadowBuffer>();
    buffer->begin(scene, outlines, light, settings, budget);
    this->Buffers[i] = buffer.get();
    if (this->All)
    {
      buffer->markAll();
    }
  }
  this->Kept = std::move(kept);
  this->Casting = !this->Kept.empty();
}

namespace
{
/// What processes must agree on; plain bytes without gaps.
struct SharedSettings
{
  double pixelError;
  std::int32_t resolution;
  std::int32_t lights;
  std::int32_t unknownReceivers;
  std::int32_t canKeep; // the last frame's buffers are there
};
struct SharedLight
{
  double position[3], direction[3], coneAngle;
  std::int32_t kind, casts;
};
static_assert(sizeof(SharedSettings) == 24 && sizeof(SharedLight) == 64, "no gaps");

template <class T>
void append(std::vector<unsigned char>& bytes, const std::vector<T>& values)
{
  const auto* begin = reinterpret_cast<const unsigned char*>(values.data());
  bytes.insert(bytes.end(), begin, begin + values.size() * sizeof(T));
}
}

bool Shadows::traceShared(const Scene& scene, const FrameSettings& own, LayerBudget& budget,
  const ParallelFor& parallelFor, Processes& processes)
{
  std::vector<SharedSettings> settingsOfAll;
  gatherRecords(processes,
    std::vector<SharedSettings>{ { own.pixelError, own.shadowResolution,
      static_cast<std::int32_t>(scene.lights.size()), own.wholeShadowBuffers,
      own.frameCoherence && !this->Shared.empty() } },
    settingsOfAll);
  std::vector<SharedLight> ownLights;
  for (const Light& light : scene.lights)
  {
    const glm::dvec3 &p = light.position, &d = light.direction;
    ownLights.push_back({ { p.x, p.y, p.z }, { d.x, d.y, d.z }, light.coneAngle,
      static_cast<std::int32_t>(light.kind), light.castShadow });
  }
  std::vector<SharedLight> lightsOfAll;
  gatherRecords(processes, ownLights, lightsOfAll);
  Outlines outlines;
  outlines.first = gatherRecords(processes, outlinesOf(scene), outlines.instances);

  const SharedSettings& agreed = settingsOfAll.front();
  bool keep = true;
  for (const SharedSettings& settings : settingsOfAll)
  {
    if (settings.lights != agreed.lights)
    {
      return false;
    }
    outlines.unknownReceivers |= settings.unknownReceivers != 0;
    keep = keep && settings.canKeep;
  }
  lightsOfAll.resize(agreed.lights);

  std::vector<unsigned char> state;
  append(state, std::vector<double>{ agreed.pixelError, static_cast<double>(agreed.resolution),
                  static_cast<double>(outlines.unknownReceivers) });
  append(state, lightsOfAll);
  append(state, outlines.instances);
  if (keep && state == this->Shared)
  {
    this->Of = &scene;
    this->Traced = false;
    return true;
  }

  FrameSettings settings = own;
  settings.pixelError = agreed.pixelError;
  settings.shadowResolution = agreed.resolution;
  std::vector<Light> lights = scene.lights;
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    const SharedLight& light = lightsOfAll[i];
    lights[i].position = { light.position[0], light.position[1], light.position[2] };
    lights[i].direction = { light.direction[0], light.direction[1], light.direction[2] };
    lights[i].coneAngle = light.coneAngle;
    lights[i].kind = static_cast<Light::Kind>(light.kind);
    lights[i].castShadow = light.casts != 0;
  }
  this->All = true; // what the others' visible points look up is not known here
  this->beginBuffers(scene, lights, outlines, settings, budget);
  this->trace(parallelFor);
  for (ShadowBuffer* buffer : this->Buffers)
  {
    if (buffer)
    {
      buffer->merge(processes, outlines.first);
    }
  }
  this->Shared = std::move(state);
  return true;
}

void Shadows::release()
{
  this->Kept.clear();
  this->Buffers.clear();
  this->Shared.clear();
}

void Shadows::mark(const TilePoints& points)
{
  if (!this->All)
  {
    for (ShadowBuffer* buffer : this->Buffers)
    {
      if (buffer)
      {
        buffer->mark(points);
      }
    }
  }
}

void Shadows::trace(const ParallelFor& parallelFor)
{
  for (ShadowBuffer* buffer : this->Buffers)
  {
    if (buffer)
    {
      buffer->trace(parallelFor);
    }
  }
}

bool Shadows::dark(
  std::size_t light, const SurfacePoint& point, double error, std::uint64_t& rays) const
{
  if (this->Buffers[light])
  {
    return this->Buffers[light]->shadows(point, error);
  }
  if (this->Rays && this->Of->lights[light].castShadow)
  {
    ++rays;
    return this->Rays->shadows(this->Of->lights[light], point.position, point.facet, error);
  }
  return false;
}

void Shadows::dark(std::size_t light, const TilePoints& points, int first, int last, double error,
  const std::uint8_t* asked, std::uint8_t* dark, std::uint64_t& rays) const
{
  if (this->Buffers[light])
  {
    this->Buffers[light]->shadows(points, first, last, error, asked, dark);
    return;
  }
  for (int i = first; i < last; ++i)
  {
    dark[i - first] = asked[i - first] && this->dark(light, points.point(i), error, rays);
  }
}

std::size_t Shadows::layerMemory() const
{
  std::size_t sum = 0;
  for (const auto& kept : this->Kept)
  {
    sum += kept.second->layerMemory();
  }
  return sum;
}

void Shadows::addStatistics(FrameStatistics& statistics) const
{
  statistics.mergedShadows = this->Traced && !this->Shared.empty();
  for (const ShadowBuffer* buffer : this->Buffers)
  {
    if (buffer && this->Traced)
    {
      statistics.shadowRays += buffer->rays();
      statistics.retracedLayers += buffer->retracedLayers();
    }
  }
}

void Shadows::copyMaps(std::vector<ShadowMap>& maps) const
{
  for (std::size_t i = 0; i < this->Buffers.size(); ++i)
  {
    if (this->Buffers[i])
    {
      this->Buffers[i]->copyMaps(static_cast<int>(i), maps);
    }
  }
}
}
