// The shadow of a light that has a size: which share of it a point sees, by rays to samples of it.
#ifndef svoSoftShadow_h
#define svoSoftShadow_h

#include "svoRayShadow.h"
#include "svoSampleRays.h"
#include "svoSampleSequence.h"
#include "vtkSVOTracingModule.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// The light, rays and casters are borrowed, for a frame. Samples of the light that lie below a
/// point's own facet do not count, so a surface without casters is lit as by a point. Translucent
/// casters are among what test() finds.
class VTKSVOTRACING_EXPORT SoftShadow : public RayShadow
{
public:
  /// `samples`: to each point, at least 1.
  SoftShadow(const Light& light, const ShadowRays& exact, const RayCasters& casters,
    const PixelRotations& rotations, int samples, const LightBuffers* maps = nullptr);

  std::uint64_t test(const ShadowQuery& query, float* missed) const override;
  bool dims() const override { return false; }
  void testTerminator(const ShadowQuery& query, const std::vector<TerminatorPoint>& points,
    float* missed) const override;

private:
  void ask(const ShadowQuery& query, SampleBatch& batch, const int* pixels, float* missed) const;

  const RayCasters& Casters;
  const PixelRotations Rotations;
  std::vector<SquarePoint> Samples;
};
}

#endif
