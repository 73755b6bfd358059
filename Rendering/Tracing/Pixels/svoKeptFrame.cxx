#include "svoKeptFrame.h"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

namespace svo
{
namespace
{
// Who adds a member to one of these adds it below.
static_assert(sizeof(Material) == 56 && sizeof(Attributes) == 64 && sizeof(Light) == 112 &&
    sizeof(Instance) == 560 && sizeof(View) == 480 && sizeof(FrameSettings) == 80,
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

void add(const Instance& i, Bytes& bytes)
{
  const Material& m = i.material;
  const Attributes& a = i.attributes;
  add(i.octree, bytes);
  add(i.casterOctree, bytes);
  bytes.add(i.localToWorld, i.leafGeometry, i.pixelError, i.id, i.depthOffsetUnits, i.givesWay,
    i.neededLevel, i.visible, i.castShadow, i.receiveShadow, i.mappedOpacity, i.opacity);
  bytes.add(m.ambientColor, m.diffuseColor, m.specularColor, m.ambient, m.diffuse, m.specular,
    m.specularPower, m.lighting, m.flat, m.flatPlanes);
  bytes.add(a.normals, a.normalAssociation, a.colors, a.colorAssociation, a.colorCoordinates,
    a.colorTexture, a.colorTextureSize, a.version);
  bytes.add(i.points.floats, i.points.doubles, i.points.count);
}

void add(const Light& l, Bytes& bytes)
{
  bytes.add(l.kind, l.headlight, l.position, l.direction, l.coneAngle, l.exponent, l.attenuation,
    l.color, l.castShadow, l.shadowTechnique, l.id);
}

/// Rays and shading; what else a view has follows from these.
void add(const View& v, Bytes& bytes)
{
  bytes.add(v.origin, v.originX, v.originY, v.direction, v.directionX, v.directionY, v.tNear,
    v.tFar, v.width, v.height, v.worldToView, v.viewToClip);
}

void add(const FrameSettings& s, Bytes& bytes)
{
  bytes.add(s.shadowTechnique, s.shadowResolution, s.shadowCoarseness, s.shadowMemoryLimit,
    s.automaticBias, s.bias, s.shadowIntensity, s.pixelError, s.antiAliasing, s.filterShadows,
    s.wholeShadowBuffers, s.mayDependOnLastFrame, s.writeNormals, s.writeLight, s.writeNames);
}
}

void KeptFrame::inputsOf(
  const Scene& scene, const View& view, const FrameSettings& settings, Inputs& inputs)
{
  Bytes bytes(inputs.bytes);
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
  inputs.instances = inputs.bytes.size();
  for (const Instance& instance : scene.instances)
  {
    add(instance, bytes);
  }
  inputs.size =
    scene.instances.empty() ? 0 : (inputs.bytes.size() - inputs.instances) / scene.instances.size();
}

FrameChanges KeptFrame::compare(
  const Scene& scene, const View& view, const FrameSettings& settings, const Frame& frame)
{
  inputsOf(scene, view, settings, this->Next);
  FrameChanges changes;
  const Inputs &now = this->Next, &last = this->Last;
  if (this->Version == 0 || this->Version != frame.version || this->Pixels != frame.color.data() ||
    now.bytes.size() != last.bytes.size() ||
    !std::equal(now.bytes.begin(), now.bytes.begin() + static_cast<std::ptrdiff_t>(now.instances),
      last.bytes.begin()))
  {
    return changes;
  }
  changes.all = false;
  const unsigned char *a = now.bytes.data() + now.instances, *b = last.bytes.data() + now.instances;
  for (std::size_t i = 0; i < scene.instances.size(); ++i, a += now.size, b += now.size)
  {
    if (std::memcmp(a, b, now.size) != 0)
    {
      changes.instances.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return changes;
}

void KeptFrame::keep(const Frame& frame)
{
  this->Version = frame.version;
  this->Pixels = frame.color.data();
  this->Covered = frame.covered;
  std::swap(this->Last, this->Next);
}
}
