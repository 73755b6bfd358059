#include "svoRayShadow.h"

#include "svoTerminatorShadow.h"

namespace svo
{
std::uint64_t RayShadow::test(const ShadowQuery& query, float* missed) const
{
  query.rays += static_cast<std::uint64_t>(countBits(query.asked));
  return missAll(
    this->Rays.shadows(this->Source, query.patch, query.errors.ray, query.asked), missed);
}

void RayShadow::dim(const ShadowQuery& query, float* missed) const
{
  const std::uint64_t left = leftOf(query, missed);
  alignas(64) float taken[TilePatch::Most];
  query.rays += static_cast<std::uint64_t>(countBits(left));
  this->Rays.taken(this->Source, query.patch, query.errors.ray, left, taken);
  takeOfRest(left, taken, missed);
}

void RayShadow::testTerminator(
  const ShadowQuery& query, const std::vector<TerminatorPoint>& points, float* missed) const
{
  testTerminatorPoints(
    nullptr, &this->Rays, this->Source, query, query.errors.ray, nullptr, points, missed);
}

void RayShadow::noteRays(const ShadowQuery& query, PointBox& rays) const
{
  rays.add(
    query.patch.origin.position, (1.0 + 1e-6) * glm::dvec3(query.patch.extent) + query.errors.ray);
}

void RayShadow::noteTerminator(
  const ShadowQuery& query, const TerminatorPoint& at, PointBox& rays, RaisedTiles&) const
{
  const glm::dvec3 reach(query.errors.ray);
  rays.add(query.patch.position(at.pixel), reach);
  rays.add(at.point.position, reach);
}
}
