#include "svoKeptFrame.h"

#include <cassert>
#include <cstring>
#include <type_traits>
#include <utility>

namespace svo
{
namespace
{
// Who adds a member to one of these adds it below.
static_assert(sizeof(Material) == 56 && sizeof(Attributes) == 64 && sizeof(Light) == 112 &&
    sizeof(Body) == 216 && sizeof(Instance) == 240 && sizeof(View) == 480 &&
    sizeof(FrameNeeds) == 24,
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

void add(const Octree& octree, Bytes& bytes)
{
  bytes.add(octree ? octree.id() : std::uint64_t(0));
}

void add(const Body& b, Bytes& bytes)
{
  const Attributes& a = b.attributes;
  add(b.octree, bytes);
  add(b.casterOctree, bytes);
  bytes.add(b.leafGeometry, b.ball, b.deepestLevel, b.neededLevel);
  bytes.add(a.normals, a.normalAssociation, a.colors, a.colorAssociation, a.colorCoordinates,
    a.colorTexture, a.colorTextureSize, a.version);
  bytes.add(b.points.floats, b.points.doubles, b.points.count);
}

/// Without its body.
void add(const Instance& i, Bytes& bytes)
{
  const Material& m = i.material;
  bytes.add(i.localToWorld, i.pixelError, i.id, i.depthOffset, i.givesWay, i.visible, i.castShadow,
    i.receiveShadow, i.mappedOpacity, i.opacity);
  bytes.add(m.ambientColor, m.diffuseColor, m.specularColor, m.ambient, m.diffuse, m.specular,
    m.specularPower, m.lighting, m.flat, m.flatPlanes);
}

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

void KeptFrame::valuesOf(const Scene& scene, Instances& instances)
{
  instances.version = scene.version;
  instances.body.clear();
  Bytes own(instances.own), bodies(instances.bodies);
  instances.own.reserve(scene.instances.size() * sizeof(Instance)); // a little more than it takes
  instances.body.reserve(scene.instances.size());
  std::uint32_t count = 0;
  const Shared<Body>* last = nullptr;
  for (const Instance& instance : scene.instances)
  {
    add(instance, own);
    if (!last || !last->same(instance.body))
    {
      add(*instance.body, bodies);
      ++count;
    }
    last = &instance.body;
    instances.body.push_back(count - 1);
  }
  instances.ownSize = count == 0 ? 0 : instances.own.size() / scene.instances.size();
  instances.bodySize = count == 0 ? 0 : instances.bodies.size() / count;
}

/// Of as many instances, those that differ.
std::vector<std::uint32_t> KeptFrame::differences() const
{
  const Instances &a = this->Next, &b = this->Last;
  assert(a.ownSize == b.ownSize && a.bodySize == b.bodySize && a.body.size() == b.body.size());
  const auto differ =
    [](const Values& x, std::size_t i, const Values& y, std::size_t k, std::size_t size)
  { return std::memcmp(x.data() + i * size, y.data() + k * size, size) != 0; };
  std::vector<std::uint32_t> result;
  bool bodyDiffers = false;
  for (std::size_t i = 0; i < a.body.size(); ++i)
  {
    if (i == 0 || a.body[i] != a.body[i - 1] || b.body[i] != b.body[i - 1])
    {
      bodyDiffers = differ(a.bodies, a.body[i], b.bodies, b.body[i], a.bodySize);
    }
    if (bodyDiffers || differ(a.own, i, b.own, i, a.ownSize))
    {
      result.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return result;
}

FrameChanges KeptFrame::compare(
  const Scene& scene, const View& view, const FrameSettings& settings, const Frame& frame)
{
  valuesOf(scene, view, settings, this->NextFrame);
  this->SameInstances = scene.version != 0 && scene.version == this->Last.version;
  if (!this->SameInstances)
  {
    valuesOf(scene, this->Next);
  }
  FrameChanges changes;
  if (this->Version == 0 || this->Version != frame.version || this->Pixels != frame.color.data() ||
    this->NextFrame != this->LastFrame)
  {
    return changes;
  }
  changes.all = false;
  if (!this->SameInstances)
  {
    changes.instances = this->differences();
  }
  return changes;
}

void KeptFrame::keep(const Frame& frame)
{
  this->Version = frame.version;
  this->Pixels = frame.color.data();
  this->Covered = frame.covered;
  std::swap(this->LastFrame, this->NextFrame);
  if (!this->SameInstances)
  {
    std::swap(this->Last, this->Next);
  }
}
}
