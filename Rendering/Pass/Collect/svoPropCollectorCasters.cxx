// What of a surface casts: its opaque cells, and beside them what is translucent.
#include "svoPropCollector.h"
#include "svoPropKeys.h"

#include "vtkActor.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"

namespace svo
{
PropCollector::Casters PropCollector::castersOf(const SurfacePart& part, OpaqueCells::Answer opaque,
  vtkActor* actor, PropSurfaces& found, const CollectProps& frame)
{
  const auto answer = [&](bool otherwise)
  { return flagOf(actor, found.prop, castShadowKey(), otherwise); };
  if (answer(false))
  {
    return { part.mesh };
  }
  if (!answer(true))
  {
    found.castNothing("was told so");
    return {};
  }
  const bool mapped = part.mesh->GetPointData()->GetTCoords() != nullptr;
  const TextureAlpha texture = mapped ? alphaOf(part.texture) : TextureAlpha::Opaque;
  const bool forced = actor->GetForceTranslucent() && !frame.translucentShadows;
  if (opaque.mesh && (forced || texture == TextureAlpha::Translucent))
  {
    opaque = { nullptr, true };
  }
  vtkPolyData* translucent =
    texture != TextureAlpha::Translucent && frame.translucentShadows ? opaque.visible : nullptr;
  if (opaque.mesh != part.mesh && translucent != part.mesh)
  {
    const bool some = translucent || (opaque.mesh && !opaque.translucent);
    found.castNothing(some   ? "is invisible in parts"
        : opaque.translucent ? IsTranslucent
                             : "is invisible");
  }
  if (opaque.translucent && !translucent)
  {
    const bool whole =
      !frame.translucentShadows && (part.opacity < 1.0 || actor->GetForceTranslucent());
    this->complainOnce(
      nullptr, whole ? frame.translucentSurfaceText : frame.translucentText, frame);
  }
  else if (opaque.mesh && texture == TextureAlpha::CutOut)
  {
    this->complainOnce(nullptr, frame.cutOutText, frame);
  }
  return { opaque.mesh, translucent };
}

/// What is left of casters where their front faces are culled: light enters where the eye looks in.
/// Of culled back faces all are left, since they are the ones that a light behind a body sees.
PropCollector::Casters PropCollector::seenOf(const Casters& casters, vtkActor* actor,
  const glm::dmat4& localToWorld, PropSurfaces& found, const CollectProps& frame)
{
  vtkProperty* property = actor->GetProperty();
  const bool culled = property->GetFrontfaceCulling() && !property->GetBackfaceCulling(); // as VTK
  if (!culled || !frame.eye || flagOf(actor, found.prop, castShadowKey(), false))
  {
    return casters;
  }
  found.kept.addUnknown(); // where the eye is
  const auto left = [&](vtkPolyData* mesh)
  { return mesh ? this->Seen.of(mesh, actor, localToWorld, *frame.eye, found.kept) : nullptr; };
  const Casters seen{ left(casters.opaque), left(casters.translucent) };
  if (seen.opaque != casters.opaque || seen.translucent != casters.translucent)
  {
    found.castNothing("has culled front faces");
  }
  return seen;
}

/// Adds what of an actor casts as light as it is, which is never traced itself.
void PropCollector::addTranslucent(vtkActor* actor, const SurfacePart& part,
  const glm::dmat4& localToWorld, SceneSurface& surface, PropSurfaces& found)
{
  // What the id differs by from that of the same actor's opaque cells.
  constexpr std::uint64_t Translucent = 0x94d049bb133111ebull;
  surface.casts = surface.translucent = true;
  if (this->finish(actor, part, localToWorld, IsTranslucent, surface, found))
  {
    surface.instance.id ^= Translucent;
    found.surfaces.push_back(surface);
  }
}
}
