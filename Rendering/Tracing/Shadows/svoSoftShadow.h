// The shadow of a light that has a size: which share of it a point sees, by rays to samples of it.
#ifndef svoSoftShadow_h
#define svoSoftShadow_h

#include "svoLightShadow.h"
#include "svoSampleRays.h"
#include "svoSampleSequence.h"
#include "svoShadowRays.h"
#include "vtkSVOTracingModule.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// The light and the rays are borrowed, for a frame. Samples of the light that lie below a point's
/// own facet do not count, so a surface without casters is lit as by a point. Translucent casters
/// are among what test() finds.
class VTKSVOTRACING_EXPORT SoftShadow : public LightShadow
{
public:
  /// `stream`: of pixelRotation(). `samples`: to each point, at least 1.
  SoftShadow(const Light& light, const SampleRays& rays, const ShadowRays& exact, unsigned stream,
    int samples);

  std::uint64_t test(const ShadowQuery& query, float* missed) const override;
  bool knowsTerminator() const override { return true; }
  void testTerminator(const ShadowQuery& query, const std::vector<TerminatorPoint>& points,
    float* missed) const override;
  void noteRays(const ShadowQuery& query, PointBox& rays) const override;
  void noteTerminator(const ShadowQuery& query, const TerminatorPoint& at, PointBox& rays,
    RaisedTiles&) const override;

private:
  struct Asker;
  void ask(const ShadowQuery& query, const Asker* askers, int count, float* missed) const;

  const Light& Source;
  const SampleRays& Rays;
  const ShadowRays& Exact; // of points that see none of the samples above their facet
  const unsigned Stream;
  std::vector<SquarePoint> Samples;
};
}

#endif
