#include "svoShadowVolumes.h"

#include "svoEraseIf.h"
#include "svoLightCode.h"
#include "svoOctreeArena.h"
#include "svoOutline.h"
#include "svoUniforms.h"
#include "svoVolumeReach.h"
#include "svoWorldToOctree.h"

#include <algorithm>
#include <set>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace svo
{
namespace
{
constexpr std::size_t TexelsOfCaster = 4; // as svoShadowVolume.glsl

/// How far triangles may lie beside what VTK draws of them, edges of the octree's cube.
constexpr double PlaceError = 1e-6;
constexpr float EndlessInShader = 1e37f; // as svoShadowVolume.glsl

/// Depths that floats tell apart, and whose squares are numbers.
constexpr double Farthest = 1e15;

/// Has room for so many.
bool hasRoom(BufferTexture& texture, std::size_t texels)
{
  texels = std::max<std::size_t>(texels, 1);
  return texels <= BufferTexture::most() &&
    (texels <= texture.size() || texture.allocate(texels + texels / 2));
}
}

bool hasVolume(const Instance& caster)
{
  return !caster.translucent() && caster.body->octree.surface();
}

std::string ShadowVolumes::describe(const Scene& scene, const std::vector<CasterInMemory>& casters,
  const OctreeArena& arena, const View& view, const FrameSettings& settings, std::size_t room,
  const ParallelFor& parallelFor, LightCode& code)
{
  this->LacksRoom = false;
  if (!code.sampled.empty())
  {
    return "Lights with a size, ambient occlusion and skies are sampled by rays, and so is all "
           "light: there are no shadow volumes.";
  }
  if (!view.plain && !view.mirrored)
  {
    return "Shadow volumes are counted from the eye, and this camera's matrices have none: rays to "
           "the lights find the same shadows.";
  }
  code.volumes = this->place(scene, casters, arena, view, settings, room, code.lights, parallelFor);
  if (!code.volumes)
  {
    return "Shadow volumes do not fit into OpenGL's memory, or into GPUMemoryLimit: rays to the "
           "lights find the same shadows.";
  }
  code.constants += "#define svoHasVolumes\n";
  const std::vector<ShaderValues::Floats>& floats = code.volumes->values.floats;
  code.floats.insert(
    code.floats.end(), floats.begin(), floats.begin() + 2); // what rays of pixels need
  return {};
}

/// The volumes that these lights (indices) make. Null if OpenGL, or `room`, has no room for them.
std::shared_ptr<const VolumeDraws> ShadowVolumes::place(const Scene& scene,
  const std::vector<CasterInMemory>& casters, const OctreeArena& arena, const View& view,
  const FrameSettings& settings, std::size_t room, const std::vector<int>& lights,
  const ParallelFor& parallelFor)
{
  const std::vector<Volume> volumes = this->gather(scene, casters, view, settings, lights);
  // What did not fit is not made again to find that out.
  const auto asked = std::make_tuple(
    scene.version, settings.gpuMemoryLimit, view.width, view.height, volumes.size());
  if (scene.version != 0 && asked == this->TooMuch && room <= this->TooLittle)
  {
    this->release();
    return nullptr;
  }
  this->see(volumes, settings, parallelFor);
  auto draws = std::make_shared<VolumeDraws>();
  draws->tellAll = std::all_of(casters.begin(), casters.end(),
    [&scene](const CasterInMemory& caster) { return hasVolume(scene.instances[caster.instance]); });
  if (!this->send(volumes, arena) || !this->aim(volumes, view) || this->bytes() > room)
  {
    this->release();
    this->TooMuch = asked;
    this->TooLittle = room;
    this->LacksRoom = true;
    return nullptr;
  }
  this->TooMuch = {};
  draws->lights = this->Ranges;
  draws->lights.resize(lights.size());
  const double base = view.parallel ? view.tNear : 0.0;
  const double reach = std::min(view.tFar - base, Farthest);
  const glm::dmat3 turned(view.worldToView);
  for (std::size_t number = 0; number < lights.size(); ++number)
  {
    const Light& light = scene.lights[lights[number]];
    const glm::dvec3 at =
      turned * (light.atInfinity() ? -reach * light.direction : light.position - view.eye);
    draws->lights[number].light = glm::vec4(glm::vec3(at), light.atInfinity() ? 0.0f : 1.0f);
  }
  draws->triangles = arena.triangles().name();
  draws->edges = this->Edges.name();
  draws->casters = this->Casters.name();
  draws->senses = this->Senses.name();
  ShaderValues::Floats rays{ "svoPixelRays", 3, {} };
  for (const glm::dvec3& ray : { view.origin - view.eye, view.originX, view.originY, view.direction,
         view.directionX, view.directionY })
  {
    const glm::vec3 seen(turned * ray);
    rays.values.insert(rays.values.end(), { seen.x, seen.y, seen.z });
  }
  draws->values.floats = { rays, { "svoParallel", 1, { view.parallel ? 1.0f : 0.0f } },
    matrixOf("svoProjection", view.viewToClip),
    { "svoReach", 1, { static_cast<float>(base), static_cast<float>(reach) } } };
  return draws;
}

/// All volumes, in the order in which they are drawn, those of copies of a mesh together. Forgets
/// meshes that no caster has.
std::vector<ShadowVolumes::Volume> ShadowVolumes::gather(const Scene& scene,
  const std::vector<CasterInMemory>& casters, const View& view, const FrameSettings& settings,
  const std::vector<int>& lights)
{
  std::vector<Volume> volumes;
  std::set<std::uint64_t> inScene; // by Octree::id(): who may cast again
  const std::vector<Outline> outlines = outlinesOf(scene);
  std::vector<std::uint8_t> withVolume(outlines.size());
  for (const CasterInMemory& caster : casters)
  {
    withVolume[caster.instance] = hasVolume(scene.instances[caster.instance]);
  }
  this->Spared = 0;
  for (std::size_t number = 0; number < lights.size(); ++number)
  {
    const Light& light = scene.lights[lights[number]];
    const VolumeReach reach(outlines, withVolume, light, view, settings);
    for (const CasterInMemory& caster : casters)
    {
      const Instance& instance = scene.instances[caster.instance];
      if (!withVolume[caster.instance])
      {
        continue;
      }
      inScene.insert(instance.body->octree.id());
      std::pair<std::uint64_t, std::uint64_t> key(instance.id, light.id);
      auto known = this->Kept.find(key);
      while (known != this->Kept.end() && known->second.current)
      {
        ++key.first; // two of one name
        known = this->Kept.find(key);
      }
      double end;
      if (!reach.find(caster.instance, end))
      {
        ++this->Spared;
        if (known != this->Kept.end())
        {
          known->second.current = true;
        }
        continue;
      }
      Seen* seen = &this->Kept[key];
      seen->current = true;
      volumes.push_back(
        { &instance, number, placeOf(light, caster.toOctree), end, reach.way(caster), seen });
    }
  }
  eraseIf(this->Meshes, [&](const auto& mesh) { return inScene.count(mesh.first) == 0; });
  std::stable_sort(volumes.begin(), volumes.end(),
    [](const Volume& a, const Volume& b)
    {
      return std::make_tuple(a.number, a.way, a.instance->body->octree.id()) <
        std::make_tuple(b.number, b.way, b.instance->body->octree.id());
    });
  return volumes;
}

/// Has the contours of all of them, and of no others.
void ShadowVolumes::see(
  const std::vector<Volume>& volumes, const FrameSettings& settings, const ParallelFor& parallelFor)
{
  std::vector<std::pair<const Octree*, std::unique_ptr<const MeshEdges>*>> unknown;
  for (const Volume& volume : volumes)
  {
    const Octree& octree = volume.instance->body->octree;
    const auto [mesh, added] = this->Meshes.try_emplace(octree.id());
    if (added)
    {
      unknown.emplace_back(&octree, &mesh->second);
    }
  }
  forEach(parallelFor, unknown.size(), 1,
    [&unknown](std::size_t i)
    { *unknown[i].second = std::make_unique<const MeshEdges>(*unknown[i].first->surface()); });
  forEach(parallelFor, volumes.size(), 1,
    [&](std::size_t i) { this->see(volumes[i], settings.frameCoherence); });
  this->Volumes = volumes.size();
  this->ContourEdges = 0;
  std::size_t bytes = 0;
  for (const auto& [id, mesh] : this->Meshes)
  {
    bytes += mesh->bytes();
  }
  for (const Volume& volume : volumes)
  {
    this->ContourEdges += volume.seen->contour.edges().size();
  }
  eraseIf(this->Kept, [](const auto& entry) { return !entry.second.current; });
  for (auto& [key, seen] : this->Kept)
  {
    bytes += seen.contour.bytes() + seen.senses.size() * sizeof(std::uint32_t);
    if (!settings.frameCoherence || bytes > settings.layerMemoryLimit)
    {
      seen.contour.forget();
    }
    seen.current = false;
    seen.version = seen.version == Changed ? ++this->Versions : seen.version;
  }
}

/// Has the contour of one.
void ShadowVolumes::see(const Volume& volume, bool keeps) const
{
  const Octree& octree = volume.instance->body->octree;
  Seen& seen = *volume.seen;
  if (seen.octree != octree.id())
  {
    seen.contour = LightContour();
    seen.senses.clear();
    seen.version = Changed;
  }
  else if (keeps && seen.light == volume.light)
  {
    return;
  }
  seen.octree = octree.id();
  seen.light = volume.light;
  if (seen.contour.update(*octree.surface(), *this->Meshes.at(octree.id()), volume.light))
  {
    seen.senses = seen.contour.senses();
    seen.version = Changed;
  }
}

/// Has contours in OpenGL's memory. False if that has no room.
bool ShadowVolumes::send(const std::vector<Volume>& volumes, const OctreeArena& arena)
{
  std::vector<std::tuple<std::size_t, int, std::uint64_t, std::uint32_t>> now;
  now.reserve(volumes.size());
  for (const Volume& volume : volumes)
  {
    now.emplace_back(volume.number, volume.way, volume.seen->version,
      arena.firstOf(volume.instance->body->octree));
  }
  if (now == this->Sent && this->Edges.name() != 0)
  {
    return true;
  }
  std::vector<glm::uvec4> edges;
  std::vector<std::uint32_t> senses;
  this->FirstSenses.clear();
  this->Ranges.clear();
  for (std::size_t i = 0; i < volumes.size(); ++i)
  {
    const Volume& volume = volumes[i];
    const Octree& octree = volume.instance->body->octree;
    const auto caster = static_cast<int>(TexelsOfCaster * i);
    const std::uint32_t first = arena.firstOf(octree);
    this->Ranges.resize(std::max(this->Ranges.size(), volume.number + 1));
    VolumeDraws::Part& part = this->Ranges[volume.number].parts[volume.way];
    part.firstEdge = part.caps.empty() ? static_cast<int>(edges.size()) : part.firstEdge;
    if (!part.caps.empty() && part.caps.back().firstTriangle == static_cast<int>(first))
    {
      ++part.caps.back().casters;
    }
    else
    {
      part.caps.push_back({ caster, 1, static_cast<int>(first),
        static_cast<int>(octree.surface()->triangles.size()) });
    }
    for (const LightContour::Edge& edge : volume.seen->contour.edges())
    {
      edges.emplace_back(3 * first + edge.from, 3 * first + edge.to, caster, 0u);
    }
    part.edges = static_cast<int>(edges.size()) - part.firstEdge;
    this->FirstSenses.push_back(static_cast<std::uint32_t>(senses.size()));
    senses.insert(senses.end(), volume.seen->senses.begin(), volume.seen->senses.end());
  }
  this->Sent.clear();
  this->Aimed.clear();
  if (!hasRoom(this->Edges, edges.size()) || !hasRoom(this->Senses, senses.size()))
  {
    return false;
  }
  this->Edges.send(0, edges.data(), edges.size());
  this->Senses.send(0, senses.data(), senses.size());
  this->Sent = std::move(now);
  return true;
}

/// Says where casters are for the eye. False if OpenGL has no room.
bool ShadowVolumes::aim(const std::vector<Volume>& volumes, const View& view)
{
  std::vector<glm::vec4> texels;
  texels.reserve(TexelsOfCaster * volumes.size());
  for (std::size_t i = 0; i < volumes.size(); ++i)
  {
    const Instance& instance = *volumes[i].instance;
    const glm::dmat4 toView =
      view.worldToView * cubeToWorld(instance.body->octree, instance.localToWorld);
    const glm::dmat3 linear(toView);
    for (int row = 0; row < 3; ++row)
    {
      texels.emplace_back(toView[0][row], toView[1][row], toView[2][row], toView[3][row]);
    }
    const double edge =
      std::max({ glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]) });
    const double error = PlaceError * edge;
    const bool mirrors = glm::determinant(linear) < 0.0;
    const double end = volumes[i].end;
    texels.emplace_back(inFloats(this->FirstSenses[i]),
      end < VolumeReach::Endless ? static_cast<float>(end) : EndlessInShader,
      static_cast<float>(mirrors ? -error : error));
  }
  if (texels == this->Aimed)
  {
    return true;
  }
  if (!hasRoom(this->Casters, texels.size()))
  {
    return false;
  }
  this->Casters.send(0, texels.data(), texels.size());
  this->Aimed = std::move(texels);
  return true;
}

void ShadowVolumes::release()
{
  this->Edges.release();
  this->Casters.release();
  this->Senses.release();
  this->Sent.clear();
  this->Aimed.clear();
  this->Kept.clear();
  this->Meshes.clear();
  this->Volumes = this->ContourEdges = this->Spared = 0;
}
}
