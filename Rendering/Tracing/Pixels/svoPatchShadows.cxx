#include "svoPatchShadows.h"

#include "svoLeafError.h"
#include "svoTileShadows.h"

namespace svo
{
void PatchShadows::prepare(const Scene& scene, const Hits& eye)
{
  this->Matrices.clear();
  this->Smooth.clear();
  this->Errors.clear();
  this->Matrices.reserve(scene.instances.size());
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    const int level = eye.instances.level(static_cast<std::uint32_t>(i));
    const LeafGeometry geometry = eye.instances.leafGeometry(static_cast<std::uint32_t>(i));
    const bool placed = eye.instances.placed(static_cast<std::uint32_t>(i));
    const bool seen = !eye.instances.rect(static_cast<std::uint32_t>(i)).empty();
    this->Matrices.push_back(seen ? SurfaceMatrices(instance) : SurfaceMatrices());
    this->Smooth.push_back(instance.body->octree && isSmooth(instance));
    this->Errors.push_back(instance.body->octree
        ? PointErrors{ worldMapError(instance, geometry, level, placed),
            worldLeafError(instance, geometry, level, placed) }
        : PointErrors());
  }
}

/// Finds those points that have to be asked for once more, at another place: the light reaches them
/// though their facets turn away from it, or they are dark and nearly do.
void PatchShadows::findTerminator(const LightShadow& shadow, const Light& light,
  const ShadowQuery& query, std::uint64_t dark, Scratch& scratch) const
{
  const TilePatch& patch = query.patch;
  scratch.terminator.clear();
  if (!this->Smooth[patch.instance] || !shadow.knowsTerminator())
  {
    return;
  }
  const double grazing = shadow.grazing();
  const std::uint64_t asked = mayTurnAway(light, grazing, patch, query.asked, dark);
  if (asked == 0)
  {
    return;
  }
  SmoothTriangles triangles(this->Matrices[patch.instance]);
  eachBit(asked,
    [&](int i)
    {
      TerminatorPoint at = atTerminator(triangles, light, grazing, dark >> i & 1, patch.point(i),
        patch.towards(i), patch.hits->primitive[i]);
      if (at.kind != TerminatorPoint::Kind::Plain)
      {
        at.pixel = i;
        if (scratch.noted && at.kind != TerminatorPoint::Kind::Hidden)
        {
          shadow.noteTerminator(query, at, scratch.noted->raysToLights, scratch.noted->raised);
        }
        scratch.terminator.push_back(at);
      }
    });
}

std::uint64_t PatchShadows::find(
  const LightShadow& shadow, const Light& light, const ShadowQuery& query, Scratch& scratch) const
{
  float* missed = scratch.missed;
  if (scratch.noted)
  {
    shadow.noteRays(query, scratch.noted->raysToLights);
  }
  const std::uint64_t dark = shadow.test(query, missed);
  std::uint64_t changed = dark;
  this->findTerminator(shadow, light, query, dark, scratch);
  if (!scratch.terminator.empty())
  {
    shadow.testTerminator(query, scratch.terminator, missed);
    for (const TerminatorPoint& at : scratch.terminator)
    {
      changed |= std::uint64_t(1) << at.pixel;
    }
  }
  if (shadow.dims())
  {
    shadow.dim(query, missed);
    changed |= query.asked;
  }
  return changed;
}
}
