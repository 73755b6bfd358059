#include "svoFrameInputs.h"

#include "svoSkyPicture.h"

#include <tuple>
#include <type_traits>
#include <utility>

namespace svo
{
namespace
{
// Who adds a member to one of these adds it below.
static_assert(
  sizeof(View) == 496 && sizeof(FrameNeeds) == 56, "all that pictures depend on is compared");

using Bytes = std::vector<unsigned char>;

template <class... T>
void add(Bytes& bytes, const T&... values)
{
  const auto append = [&bytes](const auto& value)
  {
    static_assert(
      std::is_trivially_copyable_v<std::decay_t<decltype(value)>>, "a value, without gaps");
    const auto* first = reinterpret_cast<const unsigned char*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof(value));
  };
  (append(values), ...);
}

void addLight(const Light& l, Bytes& bytes)
{
  std::apply([&bytes](const auto&... values) { add(bytes, values...); }, valuesOf(l));
}

/// Rays and shading; what else a view has follows from these.
void addView(const View& v, Bytes& bytes)
{
  add(bytes, v.origin, v.originX, v.originY, v.direction, v.directionX, v.directionY, v.tNear,
    v.tFar, v.width, v.height, v.crop, v.worldToView, v.viewToClip);
}

void addSettings(const FrameSettings& s, Bytes& bytes)
{
  visitCompared(s, [&bytes](const auto& setting) { add(bytes, setting); });
  add(bytes, s.shadowCoarseness, s.detailThreshold, s.receiverMaps, s.wholeShadowBuffers,
    s.sampledMaps, s.writeNormals, s.writeLight, s.writeSlopes, s.writeNames,
    s.skyPicture ? s.skyPicture->version() : std::uint64_t(0));
}
}

bool FrameInputs::differ(const Scene& scene, const View& view, const FrameSettings& settings)
{
  Bytes inputs;
  inputs.reserve(this->Inputs.size());
  addView(view, inputs);
  addSettings(settings, inputs);
  add(inputs, scene.instances.size(), scene.receivers.size(), scene.lights.size(),
    scene.onlyHeadlight);
  for (const Box& box : scene.receivers)
  {
    add(inputs, box.low, box.high);
  }
  for (const Light& light : scene.lights)
  {
    addLight(light, inputs);
  }
  const bool others = inputs != this->Inputs;
  this->Inputs = std::move(inputs);
  return others;
}
}
