#include "svoCollectedActor.h"

#include "svoMeshOctree.h"

#include "vtkActor.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"

namespace svo
{
namespace
{
std::uint64_t combine(std::uint64_t a, std::uint64_t b)
{
  return a ^ (b + 0x9e3779b97f4a7c15ull + (a << 6) + (a >> 2));
}
}

void CollectedActor::complain(const std::string& text) const
{
  if (this->frame.complain && !this->quiet &&
    (!this->frame.said || this->frame.said->insert(text).second))
  {
    this->frame.complain(text);
  }
}

Casters CollectedActor::castersOf(const SurfacePart& part, OpaqueAnswer opaque) const
{
  if (this->flag(castShadowKey(), false))
  {
    return { part.mesh };
  }
  if (!this->flag(castShadowKey(), true))
  {
    this->found.castNothing("was told so");
    return {};
  }
  const bool mapped = part.mesh->GetPointData()->GetTCoords() != nullptr;
  const TextureAlpha texture = mapped ? alphaOf(part.texture) : TextureAlpha::Opaque;
  const bool forced = this->actor->GetForceTranslucent() && !this->frame.translucentShadows;
  if (opaque.mesh && (forced || texture == TextureAlpha::Translucent))
  {
    opaque = { nullptr, true };
  }
  vtkPolyData* translucent = texture != TextureAlpha::Translucent && this->frame.translucentShadows
    ? opaque.visible
    : nullptr;
  if (opaque.mesh != part.mesh && translucent != part.mesh)
  {
    const bool some = translucent || (opaque.mesh && !opaque.translucent);
    this->found.castNothing(some ? "is invisible in parts"
        : opaque.translucent     ? IsTranslucent
                                 : "is invisible");
  }
  if (opaque.translucent && !translucent)
  {
    const bool whole =
      !this->frame.translucentShadows && (part.opacity < 1.0 || this->actor->GetForceTranslucent());
    this->complain(whole ? this->frame.translucentSurfaceText : this->frame.translucentText);
  }
  else if (opaque.mesh && texture == TextureAlpha::CutOut)
  {
    this->complain(this->frame.cutOutText);
  }
  return { opaque.mesh, translucent };
}

void CollectedActor::add(
  const SurfacePart& part, Reason reason, SceneSurface& surface, std::uint64_t mark) const
{
  Instance& instance = surface.instance;
  surface.traceable = !reason;
  this->found.planes =
    this->found.planes || (this->traceable && !this->planes && carriesPlanes(part.mesh));
  if (surface.traceable)
  {
    surface.mesh = part.mesh;
    instance.body.own().points = pointsOf(part.mesh, this->found.kept);
  }
  else
  {
    this->found.rasterize(reason);
    if (!surface.casts)
    {
      return;
    }
  }
  instance.localToWorld = this->localToWorld;
  instance.pixelError = pixelErrorOf(this->actor, this->found.prop);
  instance.receiveShadow = this->flag(receiveShadowKey(), true);
  instance.id = mark ^
    combine(combine(reinterpret_cast<std::uintptr_t>(this->actor), part.block),
      std::uint64_t(this->found.actors));
  instance.depthOffset = coincidentOffset(this->actor->GetMapper());
  this->found.surfaces.push_back(surface);
}

void CollectedActor::addTranslucent(
  const SurfacePart& part, SceneSurface& surface, std::uint64_t mark) const
{
  // What the id differs by from that of the same actor's opaque cells.
  constexpr std::uint64_t Translucent = 0x94d049bb133111ebull;
  surface.casts = surface.translucent = true;
  this->add(part, IsTranslucent, surface, mark ^ Translucent);
}
}
