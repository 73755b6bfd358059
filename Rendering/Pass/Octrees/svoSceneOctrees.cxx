#include "svoSceneOctrees.h"

#include "svoSceneInstances.h"

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

/// What the surface brings, else what is known without an octree. `known`: that was asked in the
/// last frame, with the same answer.
void findAttached(
  SceneSurface& surface, bool known, OctreeStore& store, const StoreOptions& options)
{
  Body& body = surface.instance.body.own();
  body.casterOctree = Octree();
  body.leafGeometry = LeafGeometry::Automatic;
  body.neededLevel = 0;
  surface.instance.coincidentOrder = 0;
  surface.needed = NeededLevels();
  if (known)
  {
    body.octree = surface.bringsOctree ? body.octree : Octree();
    return;
  }
  body.octree = store.attached(surface.mesh, options);
  surface.bringsOctree = static_cast<bool>(body.octree);
  if (!surface.bringsOctree)
  {
    store.measure(surface.mesh, options, body);
    body.deepestLevel = options.level;
  }
}

void findOctree(SceneSurface& surface, OctreeStore& store, const StoreOptions& options)
{
  Body& body = surface.instance.body.own();
  const NeededLevels& needed = surface.needed;
  body.neededLevel = needed.eye;
  body.octree = store.find(surface.mesh, needed.eye, options);
  if (body.octree && needed.lights > 0 && needed.lights != needed.eye)
  {
    body.casterOctree = store.find(surface.mesh, needed.lights, options);
  }
}

/// Notes what each surface needs; of copies what the most demanding one does.
void noteNeeded(std::vector<PropSurfaces>& props, const std::vector<NeededLevels>& ofInstances)
{
  auto next = ofInstances.begin();
  eachSurface(props,
    [&](const PropSurfaces&, SceneSurface& surface)
    {
      NeededLevels& most = surface.needed;
      for (std::size_t i = 0; i < surface.count(); ++i, ++next)
      {
        most.eye = std::max(most.eye, next->eye);
        most.lights = std::max(most.lights, next->lights);
      }
    });
}

/// Has what findOctree() will ask for built, where that is faster for all together.
void prepareOctrees(
  std::vector<PropSurfaces>& props, OctreeStore& store, const StoreOptions& options)
{
  OctreeStore::Wanted wanted;
  eachSurface(props,
    [&](const PropSurfaces&, const SceneSurface& surface)
    {
      const NeededLevels& levels = surface.needed;
      if (!surface.bringsOctree)
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
}

std::string reasons(Reason rasterized, Reason castsNone, bool casts)
{
  std::string text;
  if (rasterized)
  {
    text += std::string("Left to the rasteriser: it ") + rasterized + ".";
  }
  if (castsNone)
  {
    text += (text.empty() ? "" : " ");
    text += casts ? "Casts less than its whole shadow: it " : "Casts no shadow: it ";
    text += std::string(castsNone) + ".";
  }
  return text;
}

void addReceiver(const PropSurfaces& prop, bool shown, Scene& scene)
{
  // To ask a prop takes VTK as long as all else that is done of it in a frame.
  const bool known = prop.bounds[0] <= prop.bounds[1];
  const double* b = shown || !prop.receives ? nullptr
    : known                                 ? prop.bounds.data()
                                            : prop.prop->GetBounds();
  if (b && b[0] <= b[1] && b[2] <= b[3] && b[4] <= b[5])
  {
    scene.receivers.push_back(boxAround(b, prop.world));
  }
}

void findOctrees(std::vector<PropSurfaces>& props, const std::vector<Light>& lights,
  const LevelSettings& settings, OctreeStore& store, const StoreOptions& options, bool sameOptions,
  std::vector<Instance>& instances)
{
  bool building = false;
  eachSurface(props,
    [&](const PropSurfaces& prop, SceneSurface& surface)
    {
      findAttached(surface, sameOptions && !prop.fresh, store, options);
      building = building || (!surface.bringsOctree && options.convert);
    });
  if (building)
  {
    Scene scene;
    scene.lights = lights;
    for (const PropSurfaces& prop : props)
    {
      addReceiver(prop, prop.traced, scene);
    }
    writeInstances(props, Stage::Planned, instances);
    scene.instances.swap(instances);
    noteNeeded(props, settings.tracer->neededLevels(scene, settings.eye, settings.frame));
    scene.instances.swap(instances);
    if (options.wait)
    {
      prepareOctrees(props, store, options);
    }
  }
  for (PropSurfaces& prop : props)
  {
    prop.shown = prop.traced;
  }
  eachSurface(props,
    [&](PropSurfaces& prop, SceneSurface& surface)
    {
      Body& body = surface.instance.body.own();
      if (!surface.bringsOctree)
      {
        findOctree(surface, store, options);
      }
      if (body.octree)
      {
        body.leafGeometry = static_cast<LeafGeometry>(body.octree.header().leafGeometry);
      }
      prop.shown = prop.shown && surface.traceable && body.octree;
    });
}
}
