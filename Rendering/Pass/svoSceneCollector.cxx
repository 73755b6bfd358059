#include "svoSceneCollector.h"

#include "svoAffineMatrix.h"
#include "svoCameraView.h"
#include "svoSceneLights.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkAssembly.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkDataSetMapper.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPropAssembly.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSVORenderPass.h"

#include <iterator>

namespace svo
{
/// What one frame's collection hands around.
struct SceneCollector::Frame
{
  const StoreOptions& options;
  CollectSettings settings;
  CollectedScene& result;
  std::vector<PropSurfaces> props;
};

namespace
{
std::uint64_t combine(std::uint64_t a, std::uint64_t b)
{
  return a ^ (b + 0x9e3779b97f4a7c15ull + (a << 6) + (a >> 2));
}

/// An explicit answer of the part or of the assembly that it belongs to; `otherwise` without one.
bool flagOf(vtkProp* prop, vtkProp* owner, vtkInformationIntegerKey* key, bool otherwise)
{
  for (vtkProp* asked : { prop, owner })
  {
    vtkInformation* keys = asked->GetPropertyKeys();
    if (keys && keys->Has(key))
    {
      return keys->Get(key) != 0;
    }
  }
  return otherwise;
}

double pixelErrorOf(vtkProp* prop, vtkProp* owner)
{
  const double own = vtkSVORenderPass::GetPropPixelError(prop);
  return own >= 0.0 ? own : vtkSVORenderPass::GetPropPixelError(owner);
}

/// True if the prop or its assembly says explicitly that it uses octrees.
bool isMarked(vtkProp* prop, vtkProp* owner)
{
  return flagOf(prop, owner, vtkSVORenderPass::USE_SVO(), false);
}

bool hasSurface(vtkPolyData* mesh)
{
  return mesh->GetNumberOfPolys() > 0 || mesh->GetNumberOfStrips() > 0;
}
}

/// About an object, or about nothing in particular (null).
void SceneCollector::complainOnce(vtkObject* about, const std::string& text, const Frame& frame)
{
  const auto [said, isNew] = this->Said.try_emplace({ about, text }, about);
  if (isNew || said->second != about) // another one is in its place now
  {
    said->second = about;
    frame.options.complain(text);
  }
}

std::vector<SurfacePart> SceneCollector::partsOf(vtkActor* actor)
{
  vtkMapper* mapper = actor->GetMapper();
  const double opacity = actor->GetProperty()->GetOpacity();
  if (CompositeMapper* composite = compositeMapper(mapper))
  {
    return this->Blocks.partsOf(composite, opacity);
  }
  auto* dataSet = vtkDataSetMapper::SafeDownCast(mapper);
  vtkPolyDataMapper* plain =
    dataSet ? this->Surfaces.mapperOf(dataSet) : vtkPolyDataMapper::SafeDownCast(mapper);
  if (!plain || !plain->GetInput())
  {
    return {};
  }
  SurfacePart whole;
  whole.mesh = plain->GetInput();
  whole.colors = plain;
  whole.opacity = opacity;
  return { whole };
}

/// Adds the actor's surfaces. False if the rasteriser has to draw the actor.
bool SceneCollector::collectActor(vtkActor* actor, vtkProp* owner, const vtkMatrix4x4* matrix,
  int path, std::vector<SceneSurface>& surfaces, Frame& frame)
{
  if (!isPlainActor(actor) && !isMarked(actor, owner))
  {
    return false; // it may well draw without a mapper of its own
  }
  vtkMapper* mapper = actor->GetMapper();
  if (!mapper || mapper->GetNumberOfInputConnections(0) == 0)
  {
    return true;
  }
  if (frame.settings.onlyMarked && !isMarked(actor, owner))
  {
    return false;
  }
  if (!mapper->GetStatic())
  {
    mapper->GetInputAlgorithm()->Update();
  }
  if (isUnknownSurfaceMapper(mapper))
  {
    this->complainOnce(nullptr,
      std::string("Surfaces of a ") + mapper->GetClassName() +
        " are left to the rasteriser and cast no shadow: this pass does not know that mapper.",
      frame);
  }
  Treatment treatment = treatmentOf(actor);
  const glm::dmat4 localToWorld = toGlm(matrix);
  if (treatment != Treatment::Rasterize)
  {
    switch (kindOf(localToWorld))
    {
      case MatrixKind::Singular:
        this->complainOnce(
          actor, "An actor is not drawn: its matrix is singular, nearly so, or not finite.", frame);
        return true;
      case MatrixKind::Projective:
        this->complainOnce(actor,
          "An actor casts no shadow and is left to the rasteriser: its matrix is not affine.",
          frame);
        treatment = Treatment::Rasterize;
        break;
      case MatrixKind::Affine:
        break;
    }
  }
  if (treatment == Treatment::Rasterize)
  {
    return false;
  }

  vtkProperty* property = actor->GetProperty();
  const bool composite = compositeMapper(mapper) != nullptr;
  const bool translucent = actor->HasTranslucentPolygonalGeometry();
  const bool mayTrace =
    treatment == Treatment::Trace && flagOf(actor, owner, vtkSVORenderPass::USE_SVO(), true);
  bool traced = mayTrace;
  for (const SurfacePart& part : this->partsOf(actor))
  {
    if (!hasSurface(part.mesh))
    {
      traced = traced && part.mesh->GetNumberOfCells() == 0;
      continue;
    }
    SceneSurface surface;
    surface.mesh = part.mesh;
    Instance& instance = surface.instance;
    surface.traceable = mayTrace &&
      lookOf(part, property, !frame.result.scene.lights.empty(), instance.material,
        instance.attributes, this->Floats, frame.result.kept);
    surface.casts = flagOf(actor, owner, vtkSVORenderPass::CAST_SHADOW(),
      part.opacity >= 1.0 && (composite || !translucent));
    surface.casts = surface.casts && frame.settings.shadows;
    traced = traced && surface.traceable;
    if (!surface.traceable && !surface.casts)
    {
      continue;
    }
    instance.localToWorld = localToWorld;
    instance.pixelError = pixelErrorOf(actor, owner);
    instance.receiveShadow = flagOf(actor, owner, vtkSVORenderPass::RECEIVE_SHADOW(), true);
    instance.id =
      combine(combine(reinterpret_cast<std::uintptr_t>(actor), part.block), std::uint64_t(path));
    instance.depthOffsetUnits = static_cast<float>(coincidentDepthOffset(mapper));
    surfaces.push_back(surface);
  }
  return traced;
}

void SceneCollector::collectProp(vtkProp* prop, Frame& frame)
{
  PropSurfaces found;
  found.prop = prop;
  const auto collect = [&](vtkActor* actor, const vtkMatrix4x4* matrix)
  {
    found.traced =
      this->collectActor(actor, prop, matrix, found.actors, found.surfaces, frame) && found.traced;
    found.receives = found.receives ||
      (actor->GetMapper() && actor->GetProperty()->GetLighting() &&
        flagOf(actor, prop, vtkSVORenderPass::RECEIVE_SHADOW(), true));
    ++found.actors;
  };

  if (auto* actor = vtkActor::SafeDownCast(prop))
  {
    collect(actor, actor->GetMatrix());
  }
  else if (vtkAssembly::SafeDownCast(prop) || vtkPropAssembly::SafeDownCast(prop))
  {
    prop->InitPathTraversal();
    while (vtkAssemblyPath* path = prop->GetNextPath())
    {
      vtkProp* leaf = path->GetLastNode()->GetViewProp();
      if (!leaf->GetVisibility())
      {
        continue;
      }
      if (auto* part = vtkActor::SafeDownCast(leaf))
      {
        collect(part, path->GetLastNode()->GetMatrix());
      }
      else if (leaf != prop)
      {
        found.traced = false;
      }
    }
  }
  else
  {
    return;
  }

  frame.props.push_back(std::move(found));
}

namespace
{
/// Adds a prop, whose surfaces have their octrees, to the scene.
void addProp(const PropSurfaces& prop, CollectedScene& result)
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
  for (const SceneSurface& surface : prop.surfaces)
  {
    if (surface.instance.octree && (prop.traced || surface.casts))
    {
      result.scene.instances.push_back(surface.instance);
      result.scene.instances.back().visible = prop.traced;
      result.meshes.push_back(surface.mesh);
    }
  }
}
}

void SceneCollector::collect(vtkRenderer* renderer, OctreeStore& store, const StoreOptions& options,
  const CollectSettings& settings, CollectedScene& result)
{
  result.scene.lights = lightsOf(renderer, result.headlightOnly);
  bool casting = false;
  for (const Light& light : result.scene.lights)
  {
    casting = casting || light.castShadow;
  }
  Frame frame{ options, settings, result, {} };
  frame.settings.shadows = settings.shadows && casting;
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
    if (prop->GetVisibility())
    {
      this->collectProp(prop, frame);
    }
  }
  findOctrees(frame.props, result.scene.lights, settings.levels, store, options);
  for (const PropSurfaces& prop : frame.props)
  {
    addProp(prop, result);
  }
  for (auto said = this->Said.begin(); said != this->Said.end();)
  {
    const bool gone = said->first.first && !said->second;
    said = gone ? this->Said.erase(said) : std::next(said);
  }
  this->Surfaces.endFrame();
  this->Floats.endFrame();
  this->Blocks.endFrame();
}
}
