#include "svoSceneCollector.h"

#include "svoCameraView.h"
#include "svoGiveWay.h"
#include "svoSceneLights.h"

#include "vtkPolyData.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"

namespace svo
{
PropSurfaces SceneCollector::judge(vtkProp* prop)
{
  const StoreOptions silent{};
  const CollectProps frame{ silent, true, false, false, nullptr, {}, {}, {}, glm::dmat4(1.0) };
  PropSurfaces found;
  found.prop = prop;
  if (!prop->GetVisibility())
  {
    found.castNothing("is not visible");
  }
  else if (!this->Props.collect(found, frame))
  {
    found.leaveAlone("is neither an actor nor an assembly");
  }
  return found;
}

namespace
{
/// Adds a prop, whose surfaces have their octrees, to the scene.
void addProp(PropSurfaces& prop, CollectedScene& result)
{
  if (prop.traced)
  {
    result.replaced.insert(prop.prop);
    result.tracedActors += prop.surfaces.empty() ? 0 : prop.actors;
  }
  else
  {
    result.rasterizedActors += prop.actors;
    result.rasterizedReceivers = result.rasterizedReceivers || prop.receives;
    addReceiver(prop, result.scene);
  }
  result.kept.insert(result.kept.end(), prop.kept.begin(), prop.kept.end());
  for (SceneSurface& surface : prop.surfaces)
  {
    surface.instance.visible = prop.traced;
    if (surface.instance.octree && (prop.traced || surface.casts))
    {
      surface.addTo(result.scene.instances);
      result.meshes.resize(result.scene.instances.size(), surface.mesh);
    }
  }
}
}

void SceneCollector::collect(vtkRenderer* renderer, OctreeStore& store, const StoreOptions& options,
  const CollectSettings& settings, CollectedScene& result)
{
  const glm::dmat4 world = sceneTransform(renderer);
  SceneLights lights = lightsOf(renderer, world, settings.nameOfHeadlight);
  result.scene.lights = std::move(lights.lights);
  result.lightsText = std::move(lights.text);
  result.headlightOnly = lights.headlightOnly;
  bool casting = false;
  for (const Light& light : result.scene.lights)
  {
    casting = casting || light.castShadow;
  }
  const CollectProps frame{ options, settings.shadows && casting, !result.scene.lights.empty(),
    settings.onlyMarked, settings.said, settings.translucentSurfaceText, settings.translucentText,
    settings.cutOutText, world };
  std::vector<PropSurfaces> found;
  // Updating a prop may change the renderer's list.
  std::vector<vtkSmartPointer<vtkProp>> props;
  vtkCollectionSimpleIterator iterator;
  vtkPropCollection* collection = renderer->GetViewProps();
  collection->InitTraversal(iterator);
  while (vtkProp* prop = collection->GetNextProp(iterator))
  {
    props.emplace_back(prop);
  }
  for (vtkProp* prop : props)
  {
    PropSurfaces surfaces;
    surfaces.prop = prop;
    if (prop->GetVisibility() && this->Props.collect(surfaces, frame))
    {
      found.push_back(std::move(surfaces));
    }
  }
  findOctrees(found, result.scene.lights, settings.levels, store, options);
  giveWay(found);
  for (PropSurfaces& prop : found)
  {
    addProp(prop, result);
  }
  this->Props.endFrame();
}
}
