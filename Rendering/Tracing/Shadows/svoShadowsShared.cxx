// Shadow buffers that several processes trace together, each of its own part of the scene.
#include "svoShadows.h"

#include <cmath>

namespace svo
{
namespace
{
/// What processes must agree on; plain bytes without gaps.
struct SharedSettings
{
  AgreedSettings settings;
  double coarseness;                  // rounded to hundredths
  glm::dmat4 worldToView, viewToClip; // of the eye
  std::int32_t width, height;
  std::int32_t lights;
  std::int32_t canKeep; // the last frame's buffers are there
};
struct SharedLight
{
  glm::dvec3 position, direction;
  double coneAngle;
  std::int32_t kind, casts;
};
static_assert(
  sizeof(SharedSettings) == 264 + 16 + sizeof(AgreedSettings) && sizeof(SharedLight) == 64,
  "no gaps");

SharedSettings settingsOf(const FrameSettings& settings, const View& eye)
{
  SharedSettings shared{};
  shared.settings = agreedOf(settings);
  shared.worldToView = eye.worldToView;
  shared.viewToClip = eye.viewToClip;
  shared.width = eye.width;
  shared.height = eye.height;
  shared.coarseness = 0.01 * static_cast<double>(std::lround(100.0 * settings.shadowCoarseness));
  return shared;
}

View eyeOf(const SharedSettings& settings)
{
  View eye;
  return makeView(settings.worldToView, settings.viewToClip, settings.width, settings.height, eye)
    ? eye
    : View();
}

template <class T>
void append(std::vector<unsigned char>& bytes, const std::vector<T>& values)
{
  const auto* begin = reinterpret_cast<const unsigned char*>(values.data());
  bytes.insert(bytes.end(), begin, begin + values.size() * sizeof(T));
}
}

bool Shadows::traceShared(const Scene& scene, const View& eye, const FrameSettings& own,
  LayerBudget& budget, const ParallelFor& parallelFor, Processes& processes)
{
  this->Filters = own.filters();
  this->chooseAll(scene, ShadowTechnique::Buffer);
  std::vector<SharedSettings> settingsOfAll;
  SharedSettings mine = settingsOf(own, eye);
  mine.lights = static_cast<std::int32_t>(scene.lights.size());
  mine.canKeep = own.frameCoherence && !this->SharedState.empty();
  gatherRecords(processes, std::vector<SharedSettings>{ mine }, settingsOfAll);
  std::vector<SharedLight> ownLights;
  for (const Light& light : scene.lights)
  {
    ownLights.push_back({ light.position, light.direction, light.coneAngle,
      static_cast<std::int32_t>(light.kind), light.castShadow });
  }
  std::vector<SharedLight> lightsOfAll;
  gatherRecords(processes, ownLights, lightsOfAll);
  std::vector<Outline> outlines; // of the scenes of all processes, one scene after the other
  const std::size_t first = gatherRecords(processes, outlinesOf(scene), outlines)[processes.self()];

  const SharedSettings& agreed = settingsOfAll.front();
  bool keep = true;
  for (const SharedSettings& settings : settingsOfAll)
  {
    if (settings.lights != agreed.lights)
    {
      return false;
    }
    keep = keep && settings.canKeep;
  }
  lightsOfAll.resize(agreed.lights);

  FrameSettings settings = own;
  agree(settings, agreed.settings);
  settings.shadowCoarseness = agreed.coarseness;
  std::vector<Light> lights = scene.lights;
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    const SharedLight& light = lightsOfAll[i];
    lights[i].position = light.position;
    lights[i].direction = light.direction;
    lights[i].coneAngle = light.coneAngle;
    lights[i].kind = static_cast<Light::Kind>(light.kind);
    lights[i].castShadow = light.casts != 0;
  }
  settings.wholeShadowBuffers = true; // where some process has receivers all count their copies
  const std::vector<LightMaps> maps = mapsOfLights(outlines, lights, settings, eyeOf(agreed));

  std::vector<unsigned char> state;
  append(state, std::vector<AgreedSettings>{ agreed.settings });
  append(state, std::vector<double>{ agreed.coarseness });
  append(state, lightsOfAll);
  append(state, outlines);
  for (const LightMaps& light : maps)
  {
    for (const View& view : light.views)
    {
      append(state, std::vector<glm::dmat4>{ view.worldToView, view.viewToClip });
      append(state, std::vector<int>{ view.width, view.height });
      append(state, std::vector<PixelRect>{ view.crop });
    }
  }
  if (keep && state == this->SharedState)
  {
    this->Traced = false;
    this->eachBuffer([&](ShadowBuffer& buffer) { buffer.setBias(own); });
    return true;
  }

  this->TracesWhole = true; // what the others' visible points look up is not known here
  this->prepareBuffers(scene, lights, maps, first, settings, budget, parallelFor);
  this->eachBuffer([&](ShadowBuffer& buffer) { buffer.trace(parallelFor); });
  this->eachBuffer([&](ShadowBuffer& buffer) { buffer.merge(processes, first); });
  this->SharedState = std::move(state);
  return true;
}
}
