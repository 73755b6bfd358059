#include "svoKeptFrame.h"

#include <type_traits>
#include <utility>

namespace svo
{
namespace
{
// Who adds a member to one of these adds it below.
static_assert(sizeof(Light) == 112 && sizeof(View) == 480 && sizeof(FrameNeeds) == 24,
  "all that pictures depend on is compared");

/// Values as plain bytes, one behind the other.
class Bytes
{
public:
  explicit Bytes(std::vector<unsigned char>& to)
    : All(to)
  {
    this->All.clear();
  }
  template <class... T>
  void add(const T&... values)
  {
    (this->append(values), ...);
  }

private:
  template <class T>
  void append(const T& value)
  {
    static_assert(std::is_trivially_copyable_v<T>, "a value, without gaps");
    const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
    this->All.insert(this->All.end(), bytes, bytes + sizeof(T));
  }

  std::vector<unsigned char>& All;
};

void add(const Light& l, Bytes& bytes)
{
  bytes.add(l.kind, l.headlight, l.position, l.direction, l.coneAngle, l.exponent, l.attenuation,
    l.color, l.castShadow, l.id);
}

/// Rays and shading; what else a view has follows from these.
void add(const View& v, Bytes& bytes)
{
  bytes.add(v.origin, v.originX, v.originY, v.direction, v.directionX, v.directionY, v.tNear,
    v.tFar, v.width, v.height, v.worldToView, v.viewToClip);
}

void add(const FrameSettings& s, Bytes& bytes)
{
  visitCompared(s, [&bytes](const auto& setting) { bytes.add(setting); });
  bytes.add(s.shadowCoarseness, s.detailThreshold, s.receiverMaps, s.wholeShadowBuffers,
    s.writeNormals, s.writeLight, s.writeSlopes, s.writeNames);
}
}

void KeptFrame::valuesOf(
  const Scene& scene, const View& view, const FrameSettings& settings, Values& values)
{
  Bytes bytes(values);
  add(view, bytes);
  add(settings, bytes);
  bytes.add(scene.instances.size(), scene.receivers.size(), scene.lights.size());
  bytes.add(scene.onlyHeadlight);
  for (const Box& box : scene.receivers)
  {
    bytes.add(box.low, box.high);
  }
  for (const Light& light : scene.lights)
  {
    add(light, bytes);
  }
}

FrameChanges KeptFrame::compare(
  const Scene& scene, const View& view, const FrameSettings& settings, const Frame& frame)
{
  valuesOf(scene, view, settings, this->NextFrame);
  FrameChanges changes;
  if (scene.version == 0 || scene.version != this->SceneVersion)
  {
    this->SceneVersion = scene.version;
    const std::size_t before = this->Instances.size();
    this->Instances.resize(scene.instances.size());
    for (std::size_t i = 0; i < this->Instances.size(); ++i)
    {
      const std::uint64_t version = scene.instances[i].version;
      if (i >= before || version == 0 || version != this->Instances[i])
      {
        changes.instances.push_back(static_cast<std::uint32_t>(i));
      }
      this->Instances[i] = version;
    }
  }
  changes.all = this->Version == 0 || this->Version != frame.version ||
    this->Pixels != frame.color.data() || this->NextFrame != this->LastFrame;
  return changes;
}

void KeptFrame::keep(const Frame& frame)
{
  this->Version = frame.version;
  this->Pixels = frame.color.data();
  this->Covered = frame.covered;
  std::swap(this->LastFrame, this->NextFrame);
}
}
