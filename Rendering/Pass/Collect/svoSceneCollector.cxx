#include "svoSceneCollector.h"

#include "svoAffineMatrix.h"
#include "svoCameraView.h"
#include "svoGiveWay.h"
#include "svoPropKeys.h"
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
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPropAssembly.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <iterator>

namespace svo
{
/// What one frame's collection hands around.
struct SceneCollector::Frame
{
  const StoreOptions& options;
  CollectSettings settings;
  CollectedScene& result;
  glm::dmat4 world; // see sceneTransform()
  std::vector<PropSurfaces> props;
  bool quiet = false; // about the actor that is being collected
};

namespace
{
std::uint64_t combine(std::uint64_t a, std::uint64_t b)
{
  return a ^ (b + 0x9e3779b97f4a7c15ull + (a << 6) + (a >> 2));
}

/// True if the prop or its assembly says explicitly that it uses octrees.
bool isMarked(vtkProp* prop, vtkProp* owner)
{
  return flagOf(prop, owner, useSVOKey(), false);
}

bool hasSurface(vtkPolyData* mesh)
{
  return mesh->GetNumberOfPolys() > 0 || mesh->GetNumberOfStrips() > 0;
}
}

/// About an object, or about nothing in particular (null): then once for all renderers.
void SceneCollector::complainOnce(vtkObject* about, const std::string& text, const Frame& frame)
{
  if (!frame.options.complain || frame.quiet)
  {
    return;
  }
  if (!about)
  {
    if (!frame.settings.said || frame.settings.said->insert(text).second)
    {
      frame.options.complain(text);
    }
    return;
  }
  const auto [said, isNew] = this->GivenMessages.try_emplace({ about, text }, about);
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
  if (isCompositeMapper(mapper))
  {
    return this->Blocks.partsOf(mapper, opacity);
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

/// What of a part casts a shadow; nullptr if nothing does.
vtkPolyData* SceneCollector::casterOf(const SurfacePart& part, OpaqueCells::Answer opaque,
  vtkActor* actor, PropSurfaces& found, const Frame& frame)
{
  const auto answer = [&](bool otherwise)
  { return flagOf(actor, found.prop, castShadowKey(), otherwise); };
  if (answer(false))
  {
    return part.mesh;
  }
  if (!answer(true))
  {
    found.castNothing("was told so");
    return nullptr;
  }
  const bool mapped = part.mesh->GetPointData()->GetTCoords() != nullptr;
  const TextureAlpha texture = mapped ? alphaOf(part.texture) : TextureAlpha::Opaque;
  if (opaque.mesh && (actor->GetForceTranslucent() || texture == TextureAlpha::Translucent))
  {
    opaque = { nullptr, true };
  }
  if (opaque.mesh != part.mesh)
  {
    found.castNothing(opaque.translucent ? "is translucent"
        : opaque.mesh                    ? "is invisible in parts"
                                         : "is invisible");
  }
  if (opaque.translucent)
  {
    const bool whole = part.opacity < 1.0 || actor->GetForceTranslucent();
    this->complainOnce(nullptr,
      whole ? frame.settings.translucentSurfaceText : frame.settings.translucentText, frame);
  }
  else if (opaque.mesh && texture == TextureAlpha::CutOut)
  {
    this->complainOnce(nullptr, frame.settings.cutOutText, frame);
  }
  return opaque.mesh;
}

/// Adds the actor's surfaces.
void SceneCollector::collectActor(
  vtkActor* actor, const vtkMatrix4x4* matrix, PropSurfaces& found, Frame& frame)
{
  vtkProp* owner = found.prop;
  if (flagOf(actor, owner, shadowCatcherKey(), false))
  {
    found.leaveAlone(actor->GetProperty()->GetInterpolation() == VTK_PBR
        ? "is a shadow catcher, and not seen as such with a physically based material"
        : "is a shadow catcher");
    frame.result.shadowCatchers = true;
    return;
  }
  if (!isPlainActor(actor) && !isMarked(actor, owner))
  {
    found.leaveAlone("is of a class that may draw anything"); // without a mapper, even
    return;
  }
  vtkMapper* mapper = actor->GetMapper();
  if (!mapper || mapper->GetNumberOfInputConnections(0) == 0)
  {
    return;
  }
  const bool unmarked = frame.settings.onlyMarked && !isMarked(actor, owner);
  if (unmarked && !frame.settings.unmarkedCast)
  {
    found.leaveAlone(frame.settings.notMarked);
    return;
  }
  frame.quiet = unmarked;
  if (!mapper->GetStatic())
  {
    mapper->GetInputAlgorithm()->Update();
  }
  if (frame.settings.shadows && isUnknownSurface(actor) &&
    flagOf(actor, owner, castShadowKey(), true))
  {
    this->complainOnce(nullptr,
      std::string("What a ") + mapper->GetClassName() +
        " draws is left to the rasteriser and casts no shadow: this pass does not know that "
        "mapper. SetCastShadow(false, prop) says that this is meant.",
      frame);
  }
  const Treatment treatment = treatmentOf(actor);
  if (treatment.castsNone)
  {
    found.leaveAlone(treatment.castsNone);
    return;
  }
  Reason beyond = treatment.rasterized;
  glm::dmat4 localToWorld = frame.world * toGlm(matrix);
  switch (kindOf(localToWorld))
  {
    case MatrixKind::Nowhere:
      found.castNothing("has a matrix that is not finite");
      this->complainOnce(actor, "An actor is not drawn: its matrix is not finite.", frame);
      return;
    case MatrixKind::Flat:
      beyond = "is flattened by its matrix";
      if (!thicken(localToWorld))
      {
        found.leaveAlone(beyond);
        return;
      }
      break;
    case MatrixKind::Projective:
      found.leaveAlone("has a matrix that is not affine");
      this->complainOnce(actor,
        "An actor casts no shadow and is left to the rasteriser: its matrix is not affine.", frame);
      return;
    case MatrixKind::Affine:
      break;
  }

  if (unmarked)
  {
    beyond = frame.settings.notMarked;
  }
  else if (!beyond && !flagOf(actor, owner, useSVOKey(), true))
  {
    beyond = "was told so";
  }
  if (beyond)
  {
    found.rasterize(beyond);
  }
  vtkProperty* property = actor->GetProperty();
  for (SurfacePart& part : this->partsOf(actor))
  {
    if (!hasSurface(part.mesh))
    {
      if (part.mesh->GetNumberOfCells() > 0)
      {
        found.leaveAlone("has lines or vertices");
      }
      continue;
    }
    SceneSurface surface;
    Instance& instance = surface.instance;
    part.texture = part.texture ? part.texture : textureOf(actor);
    Reason reason = beyond;
    if (!beyond || !hasOpaqueTable(part))
    {
      const Reason unmapped = mapColors(part, this->Leaves, instance.attributes, frame.result.kept);
      reason = beyond ? beyond : unmapped;
    }
    const OpaqueCells::Answer opaque = this->Opaque.of(part, instance.attributes);
    surface.mesh =
      frame.settings.shadows ? this->casterOf(part, opaque, actor, found, frame) : nullptr;
    surface.casts = surface.mesh != nullptr;
    if (!reason)
    {
      reason = opaque.mesh != part.mesh
        ? "is translucent"
        : lookOf(part, property, !frame.result.scene.lights.empty(), instance.material,
            instance.attributes, this->Floats, frame.result.kept);
    }
    surface.traceable = !reason;
    if (surface.traceable)
    {
      surface.mesh = part.mesh;
      instance.points = pointsOf(part.mesh, frame.result.kept);
    }
    else
    {
      found.rasterize(reason);
      if (!surface.casts)
      {
        continue;
      }
    }
    instance.localToWorld = localToWorld;
    instance.pixelError = pixelErrorOf(actor, owner);
    instance.receiveShadow = flagOf(actor, owner, receiveShadowKey(), true);
    instance.id = combine(
      combine(reinterpret_cast<std::uintptr_t>(actor), part.block), std::uint64_t(found.actors));
    instance.depthOffsetUnits = static_cast<float>(coincidentDepthOffset(mapper));
    found.surfaces.push_back(surface);
  }
}

/// False if the prop cannot have any.
bool SceneCollector::collectProp(PropSurfaces& found, Frame& frame)
{
  vtkProp* prop = found.prop;
  found.world = frame.world;
  const auto collect = [&](vtkActor* actor, const vtkMatrix4x4* matrix)
  {
    this->collectActor(actor, matrix, found, frame);
    found.receives = found.receives ||
      (actor->GetMapper() && showsLights(actor) && flagOf(actor, prop, receiveShadowKey(), true));
    ++found.actors;
  };

  if (auto* actor = vtkActor::SafeDownCast(prop))
  {
    collect(actor, actor->GetMatrix());
    return true;
  }
  if (!vtkAssembly::SafeDownCast(prop) && !vtkPropAssembly::SafeDownCast(prop))
  {
    return false;
  }
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
      found.leaveAlone("has parts that are no actors");
    }
  }
  return true;
}

PropSurfaces SceneCollector::judge(vtkProp* prop)
{
  CollectedScene scene;
  const StoreOptions silent{};
  Frame frame{ silent, CollectSettings(), scene, glm::dmat4(1.0), {} };
  PropSurfaces found;
  found.prop = prop;
  if (!prop->GetVisibility())
  {
    found.castNothing("is not visible");
  }
  else if (!this->collectProp(found, frame))
  {
    found.leaveAlone("is neither an actor nor an assembly");
  }
  return found;
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
  Frame frame{ options, settings, result, world, {} };
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
    PropSurfaces found;
    found.prop = prop;
    if (prop->GetVisibility() && this->collectProp(found, frame))
    {
      frame.props.push_back(std::move(found));
    }
  }
  findOctrees(frame.props, result.scene.lights, settings.levels, store, options);
  giveWay(frame.props);
  for (const PropSurfaces& prop : frame.props)
  {
    addProp(prop, result);
    const bool asChosen = !prop.castsNone && prop.rasterized == settings.notMarked;
    if (settings.onlyMarked && !asChosen && !prop.reasons().empty())
    {
      result.reasons.emplace_back(prop.prop, prop.reasons());
    }
  }
  for (auto said = this->GivenMessages.begin(); said != this->GivenMessages.end();)
  {
    said = said->second ? std::next(said) : this->GivenMessages.erase(said);
  }
  this->Surfaces.endFrame();
  this->Floats.endFrame();
  this->Leaves.endFrame();
  this->Blocks.endFrame();
  this->Opaque.endFrame();
}
}
