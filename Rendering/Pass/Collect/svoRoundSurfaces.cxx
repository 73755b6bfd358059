#include "svoRoundSurfaces.h"

#include "svoImpostors.h"
#include "svoPlacedShapes.h"
#include "svoSplats.h"
#include "svoTubes.h"

#include "vtkActor.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"

namespace svo
{
namespace
{
/// Adds copies of a unit shape. `translucent`: what is, and is not in `shapes`, casts nothing.
void add(const CollectedActor& actor, const std::shared_ptr<RoundShapes>& shapes, bool translucent,
  const SurfacePart& of, Reason reason, UnitShapes& units)
{
  PropSurfaces& found = actor.found;
  found.rasterize(reason);
  if (!actor.frame.shadows || (!shapes && !translucent))
  {
    return;
  }
  SurfacePart part = of;
  part.mesh = units.of(shapes ? *shapes : RoundShapes());
  SceneSurface surface;
  surface.mesh = actor.castersOf(part, { shapes ? part.mesh : nullptr, translucent }).opaque;
  surface.casts = shapes && surface.mesh;
  if (translucent && surface.casts)
  {
    found.castNothing(IsTranslucent);
  }
  if (!surface.casts)
  {
    return;
  }
  const auto copies = std::make_shared<GlyphSet>();
  surface.copies = copies;
  const bool local = shapes->width == RoundShapes::Width::Local;
  surface.instance.body.own().ball = shapes->shape == RoundShapes::Shape::Ball;
  placeShapes(*shapes, local ? glm::dmat4(1.0) : actor.localToWorld, View(), *copies);
  if (!local)
  {
    surface.placed =
      std::make_shared<PlacedShapes>(PlacedShapes{ shapes, actor.localToWorld, copies });
  }
  // Others of the actor's are not the same.
  actor.add(part, reason, surface, (found.surfaces.size() + 1) * 0x9e3779b97f4a7c15ull);
  if (!local)
  {
    found.surfaces.back().instance.localToWorld = glm::dmat4(1.0);
  }
}

/// Adds the splats of an actor.
void collectSplats(const CollectedActor& actor, UnitShapes& units)
{
  auto* mapper = static_cast<vtkPointGaussianMapper*>(actor.actor->GetMapper());
  if (const Reason none = beyondSplats(mapper))
  {
    actor.found.leaveAlone(none);
    return;
  }
  const bool told = actor.flag(castShadowKey(), false);
  const auto addBlock = [&](vtkPolyData* input, unsigned int block)
  {
    if (!input || input->GetNumberOfPoints() == 0)
    {
      return;
    }
    SurfacePart part;
    part.mesh = input;
    part.block = block;
    part.opacity = actor.actor->GetProperty()->GetOpacity();
    const bool whole = !told && part.opacity < 1.0;
    const Splats splats = splatsOf(mapper, input, told);
    const bool none = whole || splats.shapes->ends.empty();
    add(actor, none ? nullptr : splats.shapes, whole || splats.translucent, part,
      actor.beyond ? actor.beyond : "shows its points as splats", units);
  };
  vtkDataObject* input = mapper->GetInputDataObject(0, 0);
  auto* tree = vtkDataObjectTree::SafeDownCast(input);
  if (!tree)
  {
    addBlock(vtkPolyData::SafeDownCast(input), 0);
    return;
  }
  auto leaves = vtkSmartPointer<vtkDataObjectTreeIterator>::Take(tree->NewTreeIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    addBlock(
      vtkPolyData::SafeDownCast(leaves->GetCurrentDataObject()), leaves->GetCurrentFlatIndex());
  }
}
}

bool collectTubes(const CollectedActor& actor, const SurfacePart& part,
  const Attributes& attributes, UnitShapes& units)
{
  vtkProperty* property = actor.actor->GetProperty();
  if (!roundLookOf(property).any())
  {
    return false;
  }
  const bool told = actor.flag(castShadowKey(), false);
  const bool whole = !told && part.opacity < 1.0;
  const Attributes uncolored;
  Tubes tubes = tubesOf(part.mesh, property, CellAlpha(told ? uncolored : attributes));
  const Reason reason = actor.beyond ? actor.beyond : "has lines or vertices";
  const bool any = tubes.rods || tubes.balls || tubes.translucent;
  for (const std::shared_ptr<RoundShapes>& shapes : { tubes.rods, tubes.balls })
  {
    if (shapes || (tubes.translucent && !tubes.rods && !tubes.balls))
    {
      add(actor, whole ? nullptr : shapes, whole || tubes.translucent, part, reason, units);
    }
  }
  return any;
}

void collectRoundShapes(const CollectedActor& actor, UnitShapes& units)
{
  if (isSplatMapper(actor.actor->GetMapper()))
  {
    collectSplats(actor, units);
    return;
  }
  const Impostors impostors = impostorsOf(actor.actor->GetMapper());
  SurfacePart part;
  part.opacity = actor.actor->GetProperty()->GetOpacity();
  const bool opaque =
    (impostors.opaque && part.opacity >= 1.0) || actor.flag(castShadowKey(), false);
  actor.found.rasterize(actor.beyond ? actor.beyond : "is drawn without polygons");
  for (const std::shared_ptr<RoundShapes>& shapes : impostors.shapes)
  {
    ++part.block;
    add(actor, opaque ? shapes : nullptr, !opaque, part, actor.found.rasterized, units);
  }
}

void placeRoundShapes(std::vector<PropSurfaces>& props, const View& eye, bool sameEye)
{
  for (PropSurfaces& prop : props)
  {
    for (SceneSurface& surface : prop.surfaces)
    {
      PlacedShapes* placed = surface.placed.get();
      const bool follows =
        placed && placed->shapes->width == RoundShapes::Width::Pixels && !sameEye;
      if (placed && (prop.fresh || prop.moved || follows))
      {
        const std::size_t before = placed->copies->copies.size();
        placeShapes(*placed->shapes, placed->localToWorld, eye, *placed->copies);
        prop.moved = true;
        prop.fresh = prop.fresh || placed->copies->copies.size() != before;
      }
    }
  }
}
}
