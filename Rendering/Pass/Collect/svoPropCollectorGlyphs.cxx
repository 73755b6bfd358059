// The copies of glyphs as surfaces.
#include "svoAffineMatrix.h"
#include "svoPropCollector.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkGlyph3DMapper.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"

#include <algorithm>

namespace svo
{
namespace
{
/// Of these copies those that `wanted` is true of.
template <class Wanted>
std::shared_ptr<const GlyphSet> select(const GlyphSet& set, const Wanted& wanted)
{
  auto selected = std::make_shared<GlyphSet>();
  selected->source = set.source;
  selected->opaque = set.opaque;
  selected->condition = set.condition;
  std::copy_if(set.copies.begin(), set.copies.end(), std::back_inserter(selected->copies), wanted);
  return selected;
}

/// What the mapper draws of a source otherwise than the tracer would; null if nothing.
Reason beyondGlyph(vtkGlyph3DMapper* mapper, vtkPolyData* source)
{
  if (source->GetNumberOfVerts() > 0 || source->GetNumberOfLines() > 0)
  {
    return "has lines or vertices";
  }
  if (mapper->GetCullingAndLOD())
  {
    return "shows coarser copies far away";
  }
  // The mapper's shader does not turn them.
  return !source->GetPointData()->GetNormals() && source->GetCellData()->GetNormals()
    ? "has sources with normals of cells"
    : nullptr;
}
}

void PropCollector::collectGlyphs(const CollectedActor& of)
{
  PropSurfaces& found = of.found;
  vtkProperty* property = of.actor->GetProperty();
  auto* mapper = vtkGlyph3DMapper::SafeDownCast(of.actor->GetMapper());
  if (mapper->GetNumberOfInputConnections(1) == 0)
  {
    found.leaveAlone("has lines or vertices"); // VTK draws a line in the place of a source
    return;
  }
  const Glyphs glyphs = glyphsOf(mapper, property, this->Copies, found.kept);
  if (glyphs.beyond)
  {
    found.leaveAlone(glyphs.beyond);
    return;
  }
  const double condition = frobeniusCondition(of.localToWorld);
  std::uint64_t number = 0;
  for (const Glyphs::Drawn& drawn : glyphs.drawn)
  {
    ++number;
    vtkPolyData* mesh = drawn.mesh;
    if (mesh->GetNumberOfPolys() == 0 && mesh->GetNumberOfStrips() == 0)
    {
      if (mesh->GetNumberOfCells() > 0)
      {
        found.leaveAlone("has lines or vertices");
      }
      continue;
    }
    SceneSurface surface;
    surface.copies = drawn.set;
    Reason reason = of.beyond ? of.beyond : beyondGlyph(mapper, mesh);
    if (condition * drawn.set->condition > MaximumCondition)
    {
      // Thin copies may be traced, but sheets may not.
      const auto isAffine = [&](const GlyphCopy& copy)
      { return kindOf(of.localToWorld * glm::dmat4(copy.place)) == MatrixKind::Affine; };
      surface.copies = select(*drawn.set, isAffine);
      if (surface.copies->copies.size() < drawn.set->copies.size())
      {
        reason = reason ? reason : "has copies that are flattened";
        found.castNothing("has copies that are flattened");
      }
    }
    SurfacePart part;
    part.mesh = mesh;
    part.block = drawn.block;
    part.overridesColor = true;
    part.opacity = property->GetOpacity();
    part.texture = textureOf(of.actor);
    std::shared_ptr<const GlyphSet> translucent;
    if (of.frame.shadows)
    {
      const bool all = surface.copies->opaque;
      const bool some = all ||
        std::any_of(surface.copies->copies.begin(), surface.copies->copies.end(),
          [](const GlyphCopy& copy) { return copy.color[3] == 255; });
      const OpaqueAnswer opaque{ some ? mesh : nullptr, !all, all ? nullptr : mesh };
      const Casters casters = of.castersOf(part, opaque);
      surface.mesh = casters.opaque;
      surface.casts = surface.mesh != nullptr;
      if (casters.translucent)
      {
        translucent = select(*surface.copies,
          [](const GlyphCopy& copy) { return copy.color[3] > 0 && copy.color[3] < 255; });
      }
      if (surface.casts && !all && !of.flag(castShadowKey(), false))
      {
        if (!translucent)
        {
          found.castNothing(IsTranslucent);
        }
        surface.copies =
          select(*surface.copies, [](const GlyphCopy& copy) { return copy.color[3] == 255; });
      }
    }
    if (!reason)
    {
      reason = !drawn.set->opaque
        ? IsTranslucent
        : lookOf(part, property, of.frame.lights, surface.instance.material,
            surface.instance.body.own().attributes, this->Floats, found.kept);
    }
    if (drawn.overridesSpecular)
    {
      surface.instance.material.specularColor = drawn.specular;
    }
    // Copies of several sources may be at the same point.
    const std::uint64_t mark = number * 0x9e3779b97f4a7c15ull;
    if (!surface.copies->copies.empty())
    {
      of.add(part, reason, surface, mark);
    }
    if (translucent && !translucent->copies.empty())
    {
      SceneSurface lighter;
      lighter.mesh = mesh;
      lighter.copies = translucent;
      of.addTranslucent(part, lighter, mark);
    }
  }
}
}
