// A light's shadow by exact rays.
#ifndef svoRayShadow_h
#define svoRayShadow_h

#include "svoLightShadow.h"
#include "svoShadowRays.h"

#include <vector>

namespace svo
{
/// The light and the rays are borrowed, for a frame. Rays need no margin where facets graze the
/// light.
class RayShadow : public LightShadow
{
public:
  RayShadow(const Light& light, const ShadowRays& rays)
    : Source(light)
    , Rays(rays)
  {
  }
  std::uint64_t test(const ShadowQuery& query, float* missed) const override;
  bool dims() const override { return this->Rays.translucent(); }
  void dim(const ShadowQuery& query, float* missed) const override;
  bool knowsTerminator() const override { return true; }
  void testTerminator(const ShadowQuery& query, const std::vector<TerminatorPoint>& points,
    float* missed) const override;
  void noteRays(const ShadowQuery& query, PointBox& rays) const override;
  void noteTerminator(const ShadowQuery& query, const TerminatorPoint& at, PointBox& rays,
    RaisedTiles& raised) const override;

private:
  const Light& Source;
  const ShadowRays& Rays;
};
}

#endif
