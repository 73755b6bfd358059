#include "svoPropCollector.h"

#include "svoAffineMatrix.h"
#include "svoCameraView.h"
#include "svoPropKeys.h"
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
#include "vtkProperty.h"

#include <iterator>

namespace svo
{
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

/// Brings all that a mapper draws up to date.
void update(vtkMapper* mapper)
{
  if (mapper->GetStatic())
  {
    return;
  }
  if (isGlyphMapper(mapper))
  {
    mapper->Update(); // its sources, too
  }
  else
  {
    mapper->GetInputAlgorithm()->Update();
  }
}
}

/// About an object, or about nothing in particular (null): then once for all renderers.
void PropCollector::complainOnce(
  vtkObject* about, const std::string& text, const CollectProps& frame)
{
  if (!frame.complain || this->Quiet)
  {
    return;
  }
  if (!about)
  {
    if (!frame.said || frame.said->insert(text).second)
    {
      frame.complain(text);
    }
    return;
  }
  const auto [said, isNew] = this->GivenMessages.try_emplace({ about, text }, about);
  if (isNew || said->second != about) // another one is in its place now
  {
    said->second = about;
    frame.complain(text);
  }
}

std::vector<SurfacePart> PropCollector::partsOf(vtkActor* actor, Kept& kept)
{
  vtkMapper* mapper = actor->GetMapper();
  const double opacity = actor->GetProperty()->GetOpacity();
  if (isCompositeMapper(mapper))
  {
    return this->Blocks.partsOf(mapper, opacity, kept);
  }
  auto* dataSet = vtkDataSetMapper::SafeDownCast(mapper);
  vtkPolyDataMapper* plain =
    dataSet ? this->Surfaces.mapperOf(dataSet, kept) : vtkPolyDataMapper::SafeDownCast(mapper);
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

/// The matrix of an actor, fit for tracing. False if nothing of it is collected; `beyond` says why
/// it can only cast.
bool PropCollector::placeOf(vtkActor* actor, const vtkMatrix4x4* matrix, glm::dmat4& localToWorld,
  Reason& beyond, PropSurfaces& found, const CollectProps& frame)
{
  localToWorld = frame.world * toGlm(matrix);
  switch (kindOf(localToWorld))
  {
    case MatrixKind::Nowhere:
      found.castNothing("has a matrix that is not finite");
      this->complainOnce(actor, "An actor is not drawn: its matrix is not finite.", frame);
      return false;
    case MatrixKind::Flat:
      beyond = "is flattened by its matrix";
      if (!thicken(localToWorld))
      {
        found.leaveAlone(beyond);
        return false;
      }
      return true;
    case MatrixKind::Projective:
      found.leaveAlone("has a matrix that is not affine");
      this->complainOnce(actor,
        "An actor casts no shadow and is left to the rasteriser: its matrix is not affine.", frame);
      return false;
    case MatrixKind::Affine:
      break;
  }
  return true;
}

/// What a surface that is traced, or else casts, has of its actor. False if it does neither.
bool PropCollector::finish(vtkActor* actor, const SurfacePart& part, const glm::dmat4& localToWorld,
  Reason reason, SceneSurface& surface, PropSurfaces& found)
{
  Instance& instance = surface.instance;
  surface.traceable = !reason;
  if (surface.traceable)
  {
    surface.mesh = part.mesh;
    instance.body.own().points = pointsOf(part.mesh, found.kept);
  }
  else
  {
    found.rasterize(reason);
    if (!surface.casts)
    {
      return false;
    }
  }
  vtkProp* owner = found.prop;
  instance.localToWorld = localToWorld;
  instance.pixelError = pixelErrorOf(actor, owner);
  instance.receiveShadow = flagOf(actor, owner, receiveShadowKey(), true);
  instance.id = combine(
    combine(reinterpret_cast<std::uintptr_t>(actor), part.block), std::uint64_t(found.actors));
  instance.depthOffset = coincidentOffset(actor->GetMapper());
  return true;
}

/// Adds a mesh of an actor.
void PropCollector::collectPart(vtkActor* actor, SurfacePart& part, const glm::dmat4& localToWorld,
  Reason beyond, PropSurfaces& found, const CollectProps& frame)
{
  SceneSurface surface;
  Instance& instance = surface.instance;
  Attributes& attributes = instance.body.own().attributes;
  if (part.texture)
  {
    found.kept.addUnknown(); // a block's own
  }
  part.texture = part.texture ? part.texture : textureOf(actor);
  Reason reason = beyond;
  if (!beyond || !hasOpaqueTable(part))
  {
    const Reason unmapped = mapColors(part, this->Leaves, attributes, found.kept);
    reason = beyond ? beyond : unmapped;
  }
  const bool round =
    this->collectTubes(actor, part, attributes, localToWorld, beyond, found, frame);
  if (!hasSurface(part.mesh) || actor->GetProperty()->GetRepresentation() != VTK_SURFACE)
  {
    if (!round && part.mesh->GetNumberOfCells() > 0)
    {
      found.rasterize(beyond ? beyond : "has lines or vertices");
      found.castNothing(HasNoPolygons);
    }
    return;
  }
  const OpaqueCells::Answer opaque =
    this->Opaque.of(part, attributes, frame.shadows && frame.translucentShadows, found.kept);
  Casters casters;
  if (frame.shadows)
  {
    casters = this->castersOf(part, opaque, actor, found, frame);
    casters = this->seenOf(casters, actor, localToWorld, found, frame);
  }
  surface.mesh = casters.opaque;
  surface.casts = surface.mesh != nullptr;
  if (!reason)
  {
    reason = opaque.mesh != part.mesh ? IsTranslucent
                                      : lookOf(part, actor->GetProperty(), frame.lights,
                                          instance.material, attributes, this->Floats, found.kept);
  }
  if (this->finish(actor, part, localToWorld, reason, surface, found))
  {
    found.surfaces.push_back(surface);
  }
  if (casters.translucent)
  {
    SceneSurface translucent;
    translucent.mesh = casters.translucent;
    translucent.instance.body.own().attributes = surface.instance.body->attributes;
    translucent.instance.mappedOpacity = opaque.mapped && !frame.meanOpacity;
    translucent.instance.opacity =
      static_cast<float>(part.opacity * (frame.meanOpacity ? opaque.alpha : 1.0));
    this->addTranslucent(actor, part, localToWorld, translucent, found);
  }
}

/// Adds the actor's surfaces.
void PropCollector::collectActor(
  vtkActor* actor, const vtkMatrix4x4* matrix, PropSurfaces& found, const CollectProps& frame)
{
  vtkProp* owner = found.prop;
  vtkMapper* mapper = actor->GetMapper();
  if (mapper)
  {
    found.mappers.push_back(mapper);
  }
  if (flagOf(actor, owner, shadowCatcherKey(), false))
  {
    found.leaveAlone(actor->GetProperty()->GetInterpolation() == VTK_PBR
        ? "is a shadow catcher, and not seen as such with a physically based material"
        : "is a shadow catcher");
    found.catchesShadows = true;
    return;
  }
  if (!isPlainActor(actor) && !isMarked(actor, owner))
  {
    found.leaveAlone(MayDrawAnything); // without a mapper, even
    return;
  }
  if (!mapper || mapper->GetNumberOfInputConnections(0) == 0)
  {
    return;
  }
  const bool unmarked = frame.onlyMarked && !isMarked(actor, owner);
  found.marked = found.marked || !unmarked;
  if (unmarked && !frame.unmarkedToo)
  {
    found.leaveAlone(frame.notMarked);
    return;
  }
  this->Quiet = unmarked;
  update(mapper);
  if (isCompositeMapper(mapper) && !hasMeshes(mapper))
  {
    return; // VTK does not draw it either: asked about anything, the mapper would complain
  }
  if (frame.shadows && isUnknownSurface(actor) && flagOf(actor, owner, castShadowKey(), true))
  {
    this->complainOnce(nullptr,
      std::string("What a ") + mapper->GetClassName() +
        " draws is left to the rasteriser and casts no shadow: this pass does not know that "
        "mapper. SetCastShadow(false, prop) says that this is meant.",
      frame);
  }
  const Treatment treatment = treatmentOf(actor, flagOf(actor, owner, castShadowKey(), false));
  if (treatment.castsNone)
  {
    found.leaveAlone(treatment.castsNone);
    return;
  }
  Reason beyond = treatment.rasterized;
  glm::dmat4 localToWorld;
  if (!this->placeOf(actor, matrix, localToWorld, beyond, found, frame))
  {
    return;
  }
  found.hasPlainMatrix = beyond == treatment.rasterized;
  if (!beyond && !flagOf(actor, owner, useSVOKey(), true))
  {
    beyond = "was told so";
  }
  if (!beyond && frame.onlyCast)
  {
    beyond = IsDrawnByOpenGL;
  }
  if (beyond)
  {
    found.rasterize(beyond);
  }
  if (isGlyphMapper(mapper))
  {
    this->collectGlyphs(actor, localToWorld, beyond, found, frame);
    return;
  }
  if (drawsRoundShapes(mapper))
  {
    this->collectRoundShapes(actor, localToWorld, beyond, found, frame);
    return;
  }
  for (SurfacePart& part : this->partsOf(actor, found.kept))
  {
    this->collectPart(actor, part, localToWorld, beyond, found, frame);
  }
}

bool canCollect(vtkProp* prop)
{
  return vtkActor::SafeDownCast(prop) || vtkAssembly::SafeDownCast(prop) ||
    vtkPropAssembly::SafeDownCast(prop);
}

void PropCollector::collect(PropSurfaces& found, const CollectProps& frame)
{
  vtkProp* prop = found.prop;
  found.world = frame.world;
  const auto collect = [&](vtkActor* actor, const vtkMatrix4x4* matrix)
  {
    this->collectActor(actor, matrix, found, frame);
    if (actor->GetMapper() && showsLights(actor) && flagOf(actor, prop, receiveShadowKey(), true))
    {
      found.receives = true;
      found.reaches = found.reaches || reachesBeyondBounds(actor);
    }
    ++found.actors;
  };

  if (auto* actor = vtkActor::SafeDownCast(prop))
  {
    collect(actor, actor->GetMatrix());
    return;
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
      collect(part, matrixOfPart(part, path->GetLastNode()->GetMatrix()));
    }
    else if (leaf != prop)
    {
      found.leaveAlone("has parts that are no actors");
    }
  }
}

bool PropCollector::move(PropSurfaces& found, const CollectProps& frame)
{
  const glm::dmat4 localToWorld =
    frame.world * toGlm(vtkActor::SafeDownCast(found.prop)->GetMatrix());
  // Others have had their treatment. Who has no surfaces has bounds, which have moved, too.
  if (found.surfaces.empty() || !found.hasPlainMatrix || kindOf(localToWorld) != MatrixKind::Affine)
  {
    return false;
  }
  const double condition = frobeniusCondition(localToWorld);
  for (const SceneSurface& surface : found.surfaces)
  {
    if (surface.copies && !surface.placed &&
      condition * surface.copies->condition > MaximumCondition)
    {
      return false;
    }
  }
  for (SceneSurface& surface : found.surfaces)
  {
    (surface.placed ? surface.placed->localToWorld : surface.instance.localToWorld) = localToWorld;
  }
  found.moved = true;
  return true;
}

void PropCollector::sweep()
{
  for (auto said = this->GivenMessages.begin(); said != this->GivenMessages.end();)
  {
    said = said->second ? std::next(said) : this->GivenMessages.erase(said);
  }
  this->Surfaces.sweep();
  this->Floats.sweep();
  this->Leaves.sweep();
  this->Blocks.sweep();
  this->Copies.sweep();
  this->Opaque.sweep();
  this->Seen.sweep();
}
}
