// Splats, impostors, tubes and spheres as casters. VTK goes on drawing them.
#include "svoImpostors.h"
#include "svoPropCollector.h"
#include "svoPropKeys.h"
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
/// Adds copies of a unit shape. `translucent`: what is, and is not in `shapes`, casts nothing.
void PropCollector::addRoundShapes(vtkActor* actor, const std::shared_ptr<RoundShapes>& shapes,
  bool translucent, const SurfacePart& of, const glm::dmat4& localToWorld, Reason reason,
  PropSurfaces& found, const CollectProps& frame)
{
  found.rasterize(reason);
  if (!frame.shadows || (!shapes && !translucent))
  {
    return;
  }
  SurfacePart part = of;
  part.mesh = this->Shapes->of(shapes ? *shapes : RoundShapes());
  SceneSurface surface;
  surface.mesh =
    this->castersOf(part, { shapes ? part.mesh : nullptr, translucent }, actor, found, frame)
      .opaque;
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
  this->finish(actor, part, local ? localToWorld : glm::dmat4(1.0), reason, surface, found);
  surface.instance.body.own().ball = shapes->shape == RoundShapes::Shape::Ball;
  placeShapes(*shapes, local ? glm::dmat4(1.0) : localToWorld, View(), *copies);
  if (!local)
  {
    surface.placed = std::make_shared<PlacedShapes>(PlacedShapes{ shapes, localToWorld, copies });
  }
  // Others of the actor's are not the same.
  surface.instance.id ^= (found.surfaces.size() + 1) * 0x9e3779b97f4a7c15ull;
  found.surfaces.push_back(surface);
}

/// Adds the tubes and spheres of a part whose scalars have been mapped to `attributes`. True if it
/// draws any.
bool PropCollector::collectTubes(vtkActor* actor, const SurfacePart& part,
  const Attributes& attributes, const glm::dmat4& localToWorld, Reason beyond, PropSurfaces& found,
  const CollectProps& frame)
{
  vtkProperty* property = actor->GetProperty();
  if (!roundLookOf(property).any())
  {
    return false;
  }
  const bool told = flagOf(actor, found.prop, castShadowKey(), false);
  const bool whole = !told && part.opacity < 1.0;
  const Attributes uncolored;
  Tubes tubes = tubesOf(part.mesh, property, CellAlpha(told ? uncolored : attributes));
  const Reason reason = beyond ? beyond : "has lines or vertices";
  const bool any = tubes.rods || tubes.balls || tubes.translucent;
  for (const std::shared_ptr<RoundShapes>& shapes : { tubes.rods, tubes.balls })
  {
    if (shapes || (tubes.translucent && !tubes.rods && !tubes.balls))
    {
      this->addRoundShapes(actor, whole ? nullptr : shapes, whole || tubes.translucent, part,
        localToWorld, reason, found, frame);
    }
  }
  return any;
}

/// Adds the splats of an actor.
void PropCollector::collectSplats(vtkActor* actor, const glm::dmat4& localToWorld, Reason beyond,
  PropSurfaces& found, const CollectProps& frame)
{
  auto* mapper = static_cast<vtkPointGaussianMapper*>(actor->GetMapper());
  if (const Reason none = beyondSplats(mapper))
  {
    found.leaveAlone(none);
    return;
  }
  const bool told = flagOf(actor, found.prop, castShadowKey(), false);
  const auto add = [&](vtkPolyData* input, unsigned int block)
  {
    if (!input || input->GetNumberOfPoints() == 0)
    {
      return;
    }
    SurfacePart part;
    part.mesh = input;
    part.block = block;
    part.opacity = actor->GetProperty()->GetOpacity();
    const bool whole = !told && part.opacity < 1.0;
    const Splats splats = splatsOf(mapper, input, told);
    const bool none = whole || splats.shapes->ends.empty();
    this->addRoundShapes(actor, none ? nullptr : splats.shapes, whole || splats.translucent, part,
      localToWorld, beyond ? beyond : "shows its points as splats", found, frame);
  };
  vtkDataObject* input = mapper->GetInputDataObject(0, 0);
  auto* tree = vtkDataObjectTree::SafeDownCast(input);
  if (!tree)
  {
    add(vtkPolyData::SafeDownCast(input), 0);
    return;
  }
  auto leaves = vtkSmartPointer<vtkDataObjectTreeIterator>::Take(tree->NewTreeIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    add(vtkPolyData::SafeDownCast(leaves->GetCurrentDataObject()), leaves->GetCurrentFlatIndex());
  }
}

/// Adds what an actor's mapper draws that draws nothing else.
void PropCollector::collectRoundShapes(vtkActor* actor, const glm::dmat4& localToWorld,
  Reason beyond, PropSurfaces& found, const CollectProps& frame)
{
  if (isSplatMapper(actor->GetMapper()))
  {
    this->collectSplats(actor, localToWorld, beyond, found, frame);
    return;
  }
  const Impostors impostors = impostorsOf(actor->GetMapper());
  SurfacePart part;
  part.opacity = actor->GetProperty()->GetOpacity();
  const bool opaque =
    (impostors.opaque && part.opacity >= 1.0) || flagOf(actor, found.prop, castShadowKey(), false);
  found.rasterize(beyond ? beyond : "is drawn without polygons");
  for (const std::shared_ptr<RoundShapes>& shapes : impostors.shapes)
  {
    ++part.block;
    this->addRoundShapes(actor, opaque ? shapes : nullptr, !opaque, part, localToWorld,
      found.rasterized, found, frame);
  }
}

void PropCollector::place(std::vector<PropSurfaces>& props, const View& eye, bool sameEye)
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
