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

/// What the surface brings, else what is known without an octree.
void findAttached(SceneSurface& surface, OctreeStore& store, const StoreOptions& options)
{
  Instance& instance = surface.instance;
  if (!store.attached(surface.mesh, options, instance.octree))
  {
    store.measure(surface.mesh, options, instance);
    instance.deepestLevel = options.level;
  }
  else if (instance.octree.hasFrame())
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

std::string PropSurfaces::reasons() const
{
  std::string text;
  if (this->rasterized)
  {
    text += std::string("Left to the rasteriser: it ") + this->rasterized + ".";
  }
  if (this->castsNone)
  {
    text += (text.empty() ? "" : " ");
    text += this->casts() ? "Casts less than its whole shadow: it " : "Casts no shadow: it ";
    text += std::string(this->castsNone) + ".";
  }
  return text;
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
      scene.instances.push_back(surface.instance);
      scene.instances.back().visible = prop.traced;
      scene.instances.back().castShadow = surface.casts;
      building = building || (!surface.instance.octree && options.convert);
    });
  std::vector<NeededLevels> needed(scene.instances.size());
  if (building)
  {
    needed = settings.tracer->neededLevels(scene, settings.eye, settings.frame);
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
      const NeededLevels& levels = *next++;
      if (!instance.octree)
      {
        findOctree(surface, levels, store, options);
      }
      if (!instance.octree)
      {
        surface.traceable = false;
        surface.casts = false;
        prop.leaveAlone(options.convert ? "has no octree, or none yet" : "comes without an octree");
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
