#include "svoSceneOctrees.h"

namespace svo
{
namespace
{
/// Calls visit(prop, surface) for all surfaces, in order.
template <class Visit>
void eachSurface(std::vector<PropSurfaces>& props, const Visit& visit)
{
  for (PropSurfaces& prop : props)
  {
    for (SceneSurface& surface : prop.surfaces)
    {
      visit(prop, surface);
    }
  }
}

std::uint64_t scatter(std::uint64_t a)
{
  // The finalizer of SplitMix64 (Steele, Lea, Flood 2014): ids of neighbours have nothing in
  // common.
  a = (a ^ (a >> 30)) * 0xbf58476d1ce4e5b9ull;
  a = (a ^ (a >> 27)) * 0x94d049bb133111ebull;
  return a ^ (a >> 31);
}

/// What the surface brings, else what is known without an octree.
void findAttached(SceneSurface& surface, OctreeStore& store, const StoreOptions& options)
{
  Instance& instance = surface.instance;
  if (!store.attached(surface.mesh, options, instance.octree))
  {
    store.measure(surface.mesh, options, instance);
    instance.deepestLevel = options.level;
  }
  else if (instance.octree.hasFrame() && !surface.copies)
  {
    // To the tracer the octree's own frame is the object's.
    instance.localToWorld = instance.localToWorld * instance.octree.frame();
  }
}

void findOctree(SceneSurface& surface, const NeededLevels& needed, OctreeStore& store,
  const StoreOptions& options)
{
  Instance& instance = surface.instance;
  instance.neededLevel = needed.eye;
  if (store.find(surface.mesh, needed.eye, options, instance.octree) != OctreeStore::Answer::Found)
  {
    return;
  }
  if (needed.lights > 0 && needed.lights != needed.eye)
  {
    store.find(surface.mesh, needed.lights, options, instance.casterOctree);
  }
}
}

/// Of each surface; of copies what the most demanding one needs.
std::vector<NeededLevels> ofSurfaces(
  std::vector<PropSurfaces>& props, const std::vector<NeededLevels>& ofInstances)
{
  std::vector<NeededLevels> needed;
  auto next = ofInstances.begin();
  eachSurface(props,
    [&](const PropSurfaces&, const SceneSurface& surface)
    {
      NeededLevels most;
      for (std::size_t i = 0; i < surface.count(); ++i, ++next)
      {
        most.eye = std::max(most.eye, next->eye);
        most.lights = std::max(most.lights, next->lights);
      }
      needed.push_back(most);
    });
  return needed;
}

/// Has what findOctree() will ask for built, where that is faster for all together.
void prepareOctrees(std::vector<PropSurfaces>& props, const std::vector<NeededLevels>& needed,
  OctreeStore& store, const StoreOptions& options)
{
  OctreeStore::Wanted wanted;
  auto next = needed.begin();
  eachSurface(props,
    [&](const PropSurfaces&, const SceneSurface& surface)
    {
      const NeededLevels& levels = *next++;
      if (!surface.instance.octree)
      {
        wanted.emplace_back(surface.mesh, levels.eye);
        if (levels.lights > 0 && levels.lights != levels.eye)
        {
          wanted.emplace_back(surface.mesh, levels.lights);
        }
      }
    });
  store.prepare(wanted, options);
}

void SceneSurface::addTo(std::vector<Instance>& instances) const
{
  if (!this->copies)
  {
    instances.push_back(this->instance);
    return;
  }
  const Octree& octree = this->instance.octree;
  const bool framed = octree && octree.hasFrame();
  const glm::dmat4 frame = framed ? octree.frame() : glm::dmat4(1.0);
  for (const GlyphCopy& copy : this->copies->copies)
  {
    Instance& one = instances.emplace_back(this->instance);
    one.localToWorld = one.localToWorld * glm::dmat4(copy.place);
    if (framed)
    {
      one.localToWorld = one.localToWorld * frame;
    }
    const glm::vec3 color = glm::vec3(copy.color[0], copy.color[1], copy.color[2]) / 255.0f;
    one.material.ambientColor = color;
    one.material.diffuseColor = color;
    one.id = scatter(one.id + static_cast<std::uint64_t>(copy.point));
  }
}

void addReceiver(const PropSurfaces& prop, Scene& scene)
{
  const double* b = !prop.traced && prop.receives ? prop.prop->GetBounds() : nullptr;
  if (b && b[0] <= b[1] && b[2] <= b[3] && b[4] <= b[5])
  {
    Box receiver;
    for (int i = 0; i < 8; ++i)
    {
      receiver.add(prop.world * glm::dvec4(b[i & 1], b[2 + (i >> 1 & 1)], b[4 + (i >> 2)], 1.0));
    }
    scene.receivers.push_back(receiver);
  }
}

void findOctrees(std::vector<PropSurfaces>& props, const std::vector<Light>& lights,
  const LevelSettings& settings, OctreeStore& store, const StoreOptions& options)
{
  Scene scene;
  scene.lights = lights;
  bool building = false;
  for (const PropSurfaces& prop : props)
  {
    addReceiver(prop, scene);
  }
  eachSurface(props,
    [&](const PropSurfaces& prop, SceneSurface& surface)
    {
      findAttached(surface, store, options);
      surface.instance.visible = prop.traced;
      surface.instance.castShadow = surface.casts;
      surface.addTo(scene.instances);
      building = building || (!surface.instance.octree && options.convert);
    });
  std::vector<NeededLevels> needed;
  if (building)
  {
    needed = ofSurfaces(props, settings.tracer->neededLevels(scene, settings.eye, settings.frame));
    if (options.wait)
    {
      prepareOctrees(props, needed, store, options);
    }
  }
  auto next = needed.begin();
  eachSurface(props,
    [&](PropSurfaces& prop, SceneSurface& surface)
    {
      Instance& instance = surface.instance;
      const NeededLevels levels = building ? *next++ : NeededLevels();
      if (!instance.octree)
      {
        findOctree(surface, levels, store, options);
      }
      if (!instance.octree)
      {
        surface.traceable = false;
        surface.casts = false;
      }
      else
      {
        instance.leafGeometry = static_cast<LeafGeometry>(instance.octree.header().leafGeometry);
      }
      instance.castShadow = surface.casts;
      prop.traced = prop.traced && surface.traceable;
    });
}
}
