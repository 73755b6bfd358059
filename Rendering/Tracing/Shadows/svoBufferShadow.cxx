#include "svoBufferShadow.h"

#include "svoShadowRules.h"
#include "svoTerminatorShadow.h"

#include <utility>

namespace svo
{
BufferShadow::BufferShadow(const Light& light, const ShadowBuffer& opaque, std::uint16_t name,
  std::vector<const ShadowBuffer*> translucent, const ShadowRays* rays, bool filters)
  : Source(light)
  , Opaque(opaque)
  , Name(name)
  , Translucent(std::move(translucent))
  , Rays(rays)
  , Filters(filters)
{
}

std::uint64_t BufferShadow::test(const ShadowQuery& query, float* missed) const
{
  if (!this->Filters)
  {
    return missAll(this->Opaque.shadows(query.patch, query.errors.map, query.asked), missed);
  }
  std::uint64_t dark = 0;
  this->Opaque.darkness(query.patch, query.errors.map, query.extents, query.asked, missed);
  eachBit(query.asked, [&](int i) { dark |= std::uint64_t(missed[i] > 0.0f) << i; });
  return dark;
}

void BufferShadow::dim(const ShadowQuery& query, float* missed) const
{
  const std::uint64_t left = leftOf(query, missed);
  alignas(64) float taken[TilePatch::Most];
  for (const ShadowBuffer* const buffer : this->Translucent)
  {
    buffer->taken(
      query.patch, query.errors.map, this->Filters ? query.extents : nullptr, left, taken);
    takeOfRest(left, taken, missed);
  }
}

double BufferShadow::grazing() const
{
  return 1.0 / GrazingReach;
}

void BufferShadow::testTerminator(
  const ShadowQuery& query, const std::vector<TerminatorPoint>& points, float* missed) const
{
  testTerminatorPoints(&this->Opaque, this->Rays, this->Source, query, query.errors.map,
    this->Filters ? query.extents : nullptr, points, missed);
}

void BufferShadow::noteTerminator(
  const ShadowQuery& query, const TerminatorPoint& at, PointBox& rays, RaisedTiles& raised) const
{
  const glm::dvec3 reach(query.errors.map);
  rays.add(query.patch.position(at.pixel), reach);
  rays.add(at.point.position, reach);
  this->Opaque.note(at.point.position, this->Name, raised);
}
}
