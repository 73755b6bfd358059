#include "svoSeenSurfaces.h"

#include "svoEyeWalk.h"
#include "svoLeafError.h"
#include "svoLeafGeometry.h"
#include "svoLocalView.h"
#include "svoOctreeArena.h"
#include "svoOctreeWalk.h"
#include "svoSurfacePoint.h"
#include "svoUnfold.h"
#include "svoUniforms.h"
#include "svoWalkReach.h"
#include "svoWorldToOctree.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace svo
{
namespace
{
const unsigned char* colorsOf(const Instance& instance)
{
  const Attributes& attributes = instance.body->attributes;
  return attributes.colorAssociation == Association::Leaf ? attributes.colors : nullptr;
}

ShaderValues::Floats vectorOf(const char* name, const glm::dvec3& v, double last)
{
  return { name, 4,
    { static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z),
      static_cast<float>(last) } };
}
}

SeenSurfaces::Key SeenSurfaces::keyOf(const Instance& instance)
{
  return Key(instance.body->octree.id(), instance.body->attributes.version, colorsOf(instance));
}

bool SeenSurfaces::place(const Scene& scene, const std::vector<std::size_t>& seen)
{
  this->Seen = seen;
  std::map<Key, const Instance*> wanted;
  std::size_t size = 0;
  for (const std::size_t index : seen)
  {
    const Instance& instance = scene.instances[index];
    if (colorsOf(instance) && wanted.emplace(keyOf(instance), &instance).second)
    {
      size += instance.body->octree.header().listWords;
    }
  }
  if (wanted.size() == this->Colored.size() &&
    std::all_of(wanted.begin(), wanted.end(),
      [this](const auto& entry) { return this->Colored.count(entry.first) > 0; }))
  {
    return true;
  }
  this->Colored.clear();
  this->Colors.release();
  if (size > BufferTexture::most() || (size > 0 && !this->Colors.allocate(size)))
  {
    return false;
  }
  std::size_t first = 0;
  for (const auto& [key, instance] : wanted)
  {
    const std::size_t count = instance->body->octree.header().listWords;
    this->Colors.send(first, colorsOf(*instance), count);
    this->Colored.emplace(key, first);
    first += count;
  }
  return true;
}

void SeenSurfaces::describe(const Scene& scene, const View& view, const OctreeArena& arena,
  const std::string& constants, EyeCode& code) const
{
  static const std::string Text = std::string(svoUnfold) + svoOctreeWalk + svoEyeWalk;
  code.constants =
    constants + "#define svoHasColors " + (this->Colors.size() > 0 ? "true\n" : "false\n");
  code.text = Text.c_str();
  code.values.textures = { { "svoNodes", arena.nodes().name() },
    { "svoLists", arena.lists().name() }, { "svoTriangles", arena.triangles().name() } };
  if (this->Colors.size() > 0)
  {
    code.values.textures.push_back({ "svoColors", this->Colors.name() });
  }
  const glm::dmat3 turned(view.worldToView);
  const glm::dvec3 centre(view.worldToView * glm::dvec4(view.origin, 1.0));
  code.values.floats = { matrixOf("svoViewToClip", view.viewToClip),
    vectorOf("svoCentre", view.parallel ? turned * view.direction : centre, !view.parallel),
    { "svoNear", 1, { static_cast<float>(view.tNear) } },
    { "svoTurn", 1, { !view.plain && view.mirrored ? -1.0f : 1.0f } } };
  for (const std::size_t index : this->Seen)
  {
    const Instance& instance = scene.instances[index];
    const Octree& octree = instance.body->octree;
    const LeafQuery query(octree, { LeafGeometry::Plane, MaximumLevel });
    const SurfaceMatrices matrices(instance);
    EyeCode::Surface surface;
    surface.instance = index;
    const double voxel = 1.0 / static_cast<double>(1 << query.bits);
    surface.low = glm::max(glm::vec3(query.low - voxel), 1.0f - 0.001f) - 1.5f;
    surface.high = glm::min(glm::vec3(query.high + voxel), 2.0f + 0.001f) - 1.5f;
    const glm::dmat4 boxToWorld = cubeToWorld(octree, instance.localToWorld);
    surface.turned = (glm::determinant(glm::dmat3(boxToWorld)) < 0.0) != view.mirrored;
    surface.colored = colorsOf(instance) != nullptr;
    const PixelRect rect = seeOctree(octree, instance.localToWorld, view).rect;
    surface.rows = rect.y1 - rect.y0;
    const glm::dmat3 toBox =
      matrices.toOctree.inverse * matrices.toOctree.scale * glm::transpose(turned);
    const auto error = worldLeafError(instance, LeafGeometry::Plane, octree.level());
    surface.values.integers = { { "svoRoot", { static_cast<int>(arena.rootOf(octree)) } },
      { "svoDepths", { octree.depthCount() } } };
    if (surface.colored)
    {
      const std::size_t first = this->Colored.at(keyOf(instance));
      surface.values.integers.push_back(
        { "svoFirstColor", { static_cast<int>(first) - static_cast<int>(arena.firstOf(octree)) } });
    }
    surface.values.floats = { matrixOf("svoBoxToView", view.worldToView * boxToWorld),
      matrixOf("svoViewToBox", glm::dmat4(toBox)),
      matrixOf("svoNormalToView", glm::dmat4(turned * glm::dmat3(matrices.normalMatrix))),
      vectorOf("svoSeenLow", query.low, walkReach(instance)),
      vectorOf("svoSeenHigh", query.high, 0.0),
      { "svoColored", 1, { surface.colored ? 1.0f : 0.0f } },
      { "svoFlat", 1, { instance.material.flatPlanes ? 1.0f : 0.0f } },
      { "svoDepthOffset", 1, { instance.depthOffset.units } },
      { "svoSeenError", 1, { static_cast<float>(error) } } };
    code.surfaces.push_back(std::move(surface));
  }
}

void SeenSurfaces::release()
{
  this->Seen.clear();
  this->Colored.clear();
  this->Colors.release();
}
}
