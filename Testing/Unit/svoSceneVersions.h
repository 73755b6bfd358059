// Versions of instances by comparing all that they are: of scenes that tests write, and the oracle
// of those that the pass collects.
#ifndef svoSceneVersions_h
#define svoSceneVersions_h

#include "svoScene.h"

#include <cstdint>
#include <map>
#include <mutex>
#include <type_traits>
#include <vector>

namespace svotest
{
// Who adds a member to one of these adds it below.
static_assert(sizeof(svo::Material) == 56 && sizeof(svo::Attributes) == 64 &&
    sizeof(svo::Body) == 216 && sizeof(svo::Instance) == 248,
  "all that pictures depend on is compared");

/// All that an instance is, as plain bytes. Of octrees and arrays their names count: Octree::id(),
/// and where an array lies together with its version.
inline std::vector<unsigned char> bytesOf(const svo::Instance& i)
{
  std::vector<unsigned char> all;
  const auto add = [&all](const auto&... values)
  {
    const auto append = [&all](const auto& value)
    {
      static_assert(std::is_trivially_copyable_v<std::decay_t<decltype(value)>>, "a plain value");
      const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
      all.insert(all.end(), bytes, bytes + sizeof(value));
    };
    (append(values), ...);
  };
  const auto nameOf = [](const svo::Octree& octree)
  { return octree ? octree.id() : std::uint64_t(0); };
  const svo::Body& b = *i.body;
  const svo::Attributes& a = b.attributes;
  const svo::Material& m = i.material;
  add(i.localToWorld, i.pixelError, i.id, i.depthOffset, i.coincidentOrder, i.visible, i.castShadow,
    i.receiveShadow, i.mappedOpacity, i.opacity);
  add(m.ambientColor, m.diffuseColor, m.specularColor, m.ambient, m.diffuse, m.specular,
    m.specularPower, m.lighting, m.flat, m.flatPlanes);
  add(nameOf(b.octree), nameOf(b.casterOctree), b.leafGeometry, b.ball, b.deepestLevel,
    b.neededLevel, b.points.floats, b.points.doubles, b.points.count);
  add(a.normals, a.normalAssociation, a.colors, a.colorAssociation, a.colorCoordinates,
    a.colorTexture, a.colorTextureSize, a.version);
  return all;
}

/// Gives instances, and their scene, versions: the same one where all of them is the same.
inline void stamp(svo::Scene& scene)
{
  static std::mutex mutex;
  static std::map<std::vector<unsigned char>, std::uint64_t> known;
  const std::lock_guard<std::mutex> lock(mutex);
  std::vector<unsigned char> versions;
  for (svo::Instance& instance : scene.instances)
  {
    instance.version = known.emplace(bytesOf(instance), known.size() + 1).first->second;
    const auto* bytes = reinterpret_cast<const unsigned char*>(&instance.version);
    versions.insert(versions.end(), bytes, bytes + sizeof instance.version);
  }
  scene.version = known.emplace(versions, known.size() + 1).first->second;
}

inline svo::Scene stamped(svo::Scene scene)
{
  stamp(scene);
  return scene;
}
}

#endif
