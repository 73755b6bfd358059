// A light's shadow by exact rays.
#ifndef svoRayShadow_h
#define svoRayShadow_h

#include "svoLightShadow.h"
#include "svoShadowRays.h"
#include "svoTerminatorShadow.h"

#include <vector>

namespace svo
{
/// The light and the rays are borrowed, for a frame. Rays need no margin where facets graze the
/// light.
class RayShadow : public LightShadow
{
public:
  RayShadow(const Light& light, const ShadowRays& rays, const LightBuffers* maps)
    : LightShadow(maps)
    , Source(light)
    , Rays(rays)
  {
  }

  std::uint64_t test(const ShadowQuery& query, float* missed) const override
  {
    query.rays += static_cast<std::uint64_t>(countBits(query.asked));
    return missAll(
      this->Rays.shadows(this->Source, query.patch, query.errors.ray, query.asked), missed);
  }

  bool dims() const override { return this->Rays.translucent(); }

  void dim(const ShadowQuery& query, float* missed) const override
  {
    const std::uint64_t left = leftOf(query, missed);
    alignas(64) float taken[TilePatch::Most];
    query.rays += static_cast<std::uint64_t>(countBits(left));
    this->Rays.taken(this->Source, query.patch, query.errors.ray, left, taken);
    takeOfRest(left, taken, missed);
  }

  bool knowsTerminator() const override { return true; }

  void testTerminator(const ShadowQuery& query, const std::vector<TerminatorPoint>& points,
    float* missed) const override
  {
    testTerminatorPoints(
      nullptr, &this->Rays, this->Source, query, query.errors.ray, nullptr, points, missed);
  }

  void noteRays(const ShadowQuery& query, Box& rays) const override { noteRayStarts(query, rays); }

  void noteTerminator(
    const ShadowQuery& query, const TerminatorPoint& at, Box& rays, RaisedTiles&) const override
  {
    noteRaisedStart(query, at, rays);
  }

protected:
  const Light& Source;
  const ShadowRays& Rays;

private:
  void count(FrameStatistics& statistics) const override { ++statistics.lightsWithRays; }
};
}

#endif
