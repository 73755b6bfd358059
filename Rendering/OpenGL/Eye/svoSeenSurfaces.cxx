#include "svoSeenSurfaces.h"

#include "svoEyeWalk.h"
#include "svoLeafError.h"
#include "svoLeafGeometry.h"
#include "svoLocalView.h"
#include "svoOctreeArena.h"
#include "svoOctreeWalk.h"
#include "svoSeenBoxes.h"
#include "svoSurfacePoint.h"
#include "svoUnfold.h"
#include "svoUniforms.h"
#include "svoWalkReach.h"
#include "svoWorldToOctree.h"

#include <algorithm>
#include <utility>

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

constexpr std::size_t TexelsOfBox = 14; // svoSeenBoxes.glsl

/// An instance's colour takes the place of VTK's in the shader if it is one: so copies with colours
/// of their own are drawn at once.
bool isTinted(const Instance& instance)
{
  return colorsOf(instance) || instance.material.ambientColor == instance.material.diffuseColor;
}

/// The texels of its box.
void addBox(const Instance& instance, const View& view, const OctreeArena& arena, bool colored,
  std::uint32_t firstColor, std::vector<glm::vec4>& texels)
{
  const Octree& octree = instance.body->octree;
  const LeafQuery query(octree, { LeafGeometry::Plane, MaximumLevel });
  const SurfaceMatrices matrices(instance);
  const glm::dmat3 turned(view.worldToView);
  const glm::dmat4 boxToWorld = cubeToWorld(octree, instance.localToWorld);
  const glm::dmat4 toView = view.worldToView * boxToWorld;
  const glm::dmat3 toBox =
    matrices.toOctree.inverse * matrices.toOctree.scale * glm::transpose(turned);
  const glm::dmat3 normals = turned * glm::dmat3(matrices.normalMatrix);
  const bool mirrored = (glm::determinant(glm::dmat3(boxToWorld)) < 0.0) != view.mirrored;
  const auto add = [&texels](const auto& vector, double last)
  { texels.emplace_back(glm::vec3(vector), static_cast<float>(last)); };
  const auto addRow = [&add](const auto& matrix, int row, double last)
  { add(glm::dvec3(matrix[0][row], matrix[1][row], matrix[2][row]), last); };
  for (int row = 0; row < 3; ++row)
  {
    addRow(toView, row, toView[3][row]);
  }
  const glm::vec2 root = inFloats(arena.rootOf(octree));
  const double besideWays[] = { root.x, root.y, static_cast<double>(octree.depthCount()) };
  for (int row = 0; row < 3; ++row)
  {
    addRow(toBox, row, besideWays[row]);
  }
  const double besideNormals[] = { instance.depthOffset.units,
    worldLeafError(instance, LeafGeometry::Plane, octree.level()),
    instance.material.flatPlanes ? 1.0 : 0.0 };
  for (int row = 0; row < 3; ++row)
  {
    addRow(normals, row, besideNormals[row]);
  }
  add(query.low, walkReach(instance));
  add(query.high, mirrored ? 1.0 : 0.0);
  add(isTinted(instance) ? instance.material.diffuseColor : glm::vec3(1.0f), colored ? 1.0 : 0.0);
  const double voxel = 1.0 / static_cast<double>(1 << query.bits);
  const glm::vec2 color = inFloats(firstColor);
  add(glm::max(glm::vec3(query.low - voxel), 1.0f - 0.001f) - 1.5f, color.x);
  add(glm::min(glm::vec3(query.high + voxel), 2.0f + 0.001f) - 1.5f, color.y);
}
}

SeenSurfaces::Key SeenSurfaces::keyOf(const Instance& instance)
{
  return Key(instance.body->octree.id(), instance.body->attributes.version, colorsOf(instance));
}

bool SeenSurfaces::place(const Scene& scene, const std::vector<std::size_t>& seen)
{
  this->Seen = seen;
  const std::size_t texels = TexelsOfBox * seen.size();
  if (texels > this->Boxes.size() || texels < this->Boxes.size() / 4)
  {
    this->Sent.clear();
    this->Boxes.release();
    if (texels > BufferTexture::most() || (texels > 0 && !this->Boxes.allocate(texels)))
    {
      return false;
    }
  }
  return this->placeColors(scene);
}

bool SeenSurfaces::placeColors(const Scene& scene)
{
  std::map<Key, const Instance*> wanted;
  std::size_t size = 0;
  for (const std::size_t index : this->Seen)
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
  const std::string& constants, EyeCode& code)
{
  static const std::string Text =
    std::string(svoUnfold) + svoOctreeWalk + svoSeenBoxes + svoEyeWalk;
  const bool anyColors = this->Colors.size() > 0;
  code.constants = constants + "#define svoHasColors " + (anyColors ? "true\n" : "false\n");
  code.text = Text.c_str();
  code.vertexText = svoSeenBoxes;
  std::vector<glm::vec4> texels;
  for (const std::size_t index : this->Seen)
  {
    const Instance& instance = scene.instances[index];
    const Octree& octree = instance.body->octree;
    const PixelRect rect = seeOctree(octree, instance.localToWorld, view).rect;
    const bool colored = colorsOf(instance) != nullptr;
    // The difference of whole numbers of 32 bits, here and in the shader, whichever is larger.
    const std::uint32_t firstColor = colored
      ? static_cast<std::uint32_t>(this->Colored.at(keyOf(instance))) - arena.firstOf(octree)
      : 0;
    addBox(instance, view, arena, colored, firstColor, texels);
    code.surfaces.push_back({ index, isTinted(instance),
      rect.pixels() / (static_cast<double>(view.width) * view.height) });
  }
  if (texels != this->Sent && !texels.empty())
  {
    this->Boxes.send(0, texels.data(), texels.size());
    this->Sent = std::move(texels);
  }
  code.values.textures = { { "svoNodes", arena.nodes().name() },
    { "svoLists", arena.lists().name() }, { "svoTriangles", arena.triangles().name() },
    { "svoBoxes", this->Boxes.name() } };
  if (anyColors)
  {
    code.values.textures.push_back({ "svoColors", this->Colors.name() });
  }
  const glm::vec3 centre(view.parallel
      ? glm::dmat3(view.worldToView) * view.direction
      : glm::dvec3(view.worldToView * glm::dvec4(view.origin, 1.0)));
  code.values.floats = { matrixOf("svoViewToClip", view.viewToClip),
    { "svoCentre", 4, { centre.x, centre.y, centre.z, view.parallel ? 0.0f : 1.0f } },
    { "svoNear", 1, { static_cast<float>(view.tNear) } },
    { "svoTurn", 1, { !view.plain && view.mirrored ? -1.0f : 1.0f } } };
}

void SeenSurfaces::release()
{
  this->Seen.clear();
  this->Colored.clear();
  this->Colors.release();
  this->Sent.clear();
  this->Boxes.release();
}
}
