#include "svoPropCollector.h"

#include "svoAffineMatrix.h"
#include "svoCameraView.h"
#include "svoEraseIf.h"
#include "svoMeshOctree.h"
#include "svoRoundSurfaces.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkAssembly.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkDataSetMapper.h"
#include "vtkGlyph3DMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPropAssembly.h"
#include "vtkProperty.h"

#include <algorithm>

namespace svo
{
namespace
{
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

void PropCollector::complainOnce(const CollectedActor& of, const std::string& text)
{
  if (!of.frame.complain || of.quiet)
  {
    return;
  }
  const auto [said, isNew] = this->GivenMessages.try_emplace({ of.actor, text }, of.actor);
  if (isNew || said->second != of.actor) // another one is in its place now
  {
    said->second = of.actor;
    of.frame.complain(text);
  }
}

std::vector<SurfacePart> PropCollector::partsOf(vtkActor* actor, KeepAlive& kept)
{
  vtkMapper* mapper = actor->GetMapper();
  const double opacity = actor->GetProperty()->GetOpacity();
  if (isCompositeMapper(mapper))
  {
    return this->Blocks.partsOf(mapper, opacity, kept);
  }
  auto* dataSet = vtkDataSetMapper::SafeDownCast(mapper);
  vtkPolyDataMapper* plain = dataSet ? surfaceMapperOf(dataSet, this->Surfaces, kept)
                                     : vtkPolyDataMapper::SafeDownCast(mapper);
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

/// Sets the actor's matrix, and why it can only cast. False if nothing of it is collected.
bool PropCollector::place(CollectedActor& of, const vtkMatrix4x4* matrix)
{
  of.localToWorld = of.frame.world * toGlm(matrix);
  switch (kindOf(of.localToWorld))
  {
    case MatrixKind::Nowhere:
      of.found.castNothing("has a matrix that is not finite");
      this->complainOnce(of, "An actor is not drawn: its matrix is not finite.");
      return false;
    case MatrixKind::Flat:
      of.beyond = "is flattened by its matrix";
      if (!thicken(of.localToWorld))
      {
        of.found.leaveAlone(of.beyond);
        return false;
      }
      return true;
    case MatrixKind::Projective:
      of.found.leaveAlone("has a matrix that is not affine");
      this->complainOnce(
        of, "An actor casts no shadow and is left to the rasteriser: its matrix is not affine.");
      return false;
    case MatrixKind::Affine:
      break;
  }
  return true;
}

/// What is left of casters where their front faces are culled: light enters where the eye looks in.
/// Of culled back faces all are left, since they are the ones that a light behind a body sees.
Casters PropCollector::seenOf(const Casters& casters, const CollectedActor& of)
{
  PropSurfaces& found = of.found;
  vtkProperty* property = of.actor->GetProperty();
  const bool culled = property->GetFrontfaceCulling() && !property->GetBackfaceCulling(); // as VTK
  if (!culled || !of.frame.eye || of.flag(castShadowKey(), false))
  {
    return casters;
  }
  found.kept.addUnknown(); // where the eye is
  const auto left = [&](vtkPolyData* mesh)
  {
    return mesh
      ? seenFacesOf(mesh, of.actor, of.localToWorld, *of.frame.eye, this->Seen, found.kept)
      : nullptr;
  };
  const Casters seen{ left(casters.opaque), left(casters.translucent) };
  if (seen.opaque != casters.opaque || seen.translucent != casters.translucent)
  {
    found.castNothing("has culled front faces");
  }
  return seen;
}

/// Adds a mesh of an actor.
void PropCollector::collectPart(const CollectedActor& of, SurfacePart& part)
{
  vtkActor* actor = of.actor;
  PropSurfaces& found = of.found;
  const CollectProps& frame = of.frame;
  const Reason beyond = of.beyond;
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
  const bool round = collectTubes(of, part, attributes, *this->Shapes);
  if (!hasSurface(part.mesh) || actor->GetProperty()->GetRepresentation() != VTK_SURFACE)
  {
    if (!round && part.mesh->GetNumberOfCells() > 0)
    {
      found.rasterize(beyond ? beyond : "has lines or vertices");
      found.castNothing(HasNoPolygons);
    }
    return;
  }
  const OpaqueAnswer opaque = opaqueCellsOf(
    part, attributes, frame.shadows && frame.translucentShadows, this->Opaque, found.kept);
  Casters casters;
  if (frame.shadows)
  {
    casters = this->seenOf(of.castersOf(part, opaque), of);
  }
  surface.mesh = casters.opaque;
  surface.casts = surface.mesh != nullptr;
  if (!reason)
  {
    reason = opaque.mesh != part.mesh ? IsTranslucent
                                      : lookOf(part, actor->GetProperty(), frame.lights,
                                          instance.material, attributes, this->Floats, found.kept);
  }
  of.add(part, reason, surface);
  if (casters.translucent)
  {
    SceneSurface translucent;
    translucent.mesh = casters.translucent;
    translucent.instance.body.own().attributes = surface.instance.body->attributes;
    translucent.instance.mappedOpacity = opaque.mapped && !frame.meanOpacity;
    translucent.instance.opacity =
      static_cast<float>(part.opacity * (frame.meanOpacity ? opaque.alpha : 1.0));
    of.addTranslucent(part, translucent);
  }
}

/// Adds the actor's surfaces.
void PropCollector::collectActor(
  vtkActor* actor, const vtkMatrix4x4* matrix, PropSurfaces& found, const CollectProps& frame)
{
  vtkProp* owner = found.prop;
  CollectedActor of{ actor, found, frame };
  vtkMapper* mapper = actor->GetMapper();
  if (mapper)
  {
    found.mappers.push_back(mapper);
  }
  if (of.flag(shadowCatcherKey(), false))
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
  of.quiet = unmarked;
  update(mapper);
  if (isCompositeMapper(mapper) && !hasMeshes(mapper))
  {
    return; // VTK does not draw it either: asked about anything, the mapper would complain
  }
  if (frame.shadows && isUnknownSurface(actor) && of.flag(castShadowKey(), true))
  {
    of.complain(std::string("What a ") + mapper->GetClassName() +
      " draws is left to the rasteriser and casts no shadow: this pass does not know that "
      "mapper. SetCastShadow(false, prop) says that this is meant.");
  }
  const Treatment treatment = treatmentOf(actor, of.flag(castShadowKey(), false));
  if (treatment.castsNone)
  {
    found.leaveAlone(treatment.castsNone);
    return;
  }
  of.beyond = treatment.rasterized;
  if (!this->place(of, matrix))
  {
    return;
  }
  found.hasPlainMatrix = of.beyond == treatment.rasterized;
  if (!of.beyond && !of.flag(useSVOKey(), true))
  {
    of.beyond = "was told so";
  }
  of.traceable = !of.beyond;
  const bool round = drawsRoundShapes(mapper);
  std::vector<SurfacePart> parts;
  if (isGlyphMapper(mapper))
  {
    of.planes = actor == owner && copiesPlanes(vtkGlyph3DMapper::SafeDownCast(mapper));
  }
  else if (!round)
  {
    parts = this->partsOf(actor, found.kept);
    of.planes = actor == owner && !parts.empty() &&
      std::all_of(parts.begin(), parts.end(),
        [](const SurfacePart& part) { return carriesPlanes(part.mesh); });
  }
  if (of.traceable && frame.openGL && !of.planes)
  {
    of.beyond = IsDrawnByOpenGL;
  }
  if (of.beyond)
  {
    found.rasterize(of.beyond);
  }
  if (isGlyphMapper(mapper))
  {
    this->collectGlyphs(of);
    return;
  }
  if (round)
  {
    collectRoundShapes(of, *this->Shapes);
    return;
  }
  for (SurfacePart& part : parts)
  {
    this->collectPart(of, part);
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
  eraseIf(this->GivenMessages, [](const auto& said) { return !said.second; });
  this->Surfaces.sweep();
  this->Floats.sweep();
  this->Leaves.sweep();
  this->Blocks.sweep();
  this->Copies.sweep();
  this->Opaque.sweep();
  this->Seen.sweep();
}
}
