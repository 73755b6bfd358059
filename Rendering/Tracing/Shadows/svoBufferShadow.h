// A light's shadow by its shadow buffers.
#ifndef svoBufferShadow_h
#define svoBufferShadow_h

#include "svoLightShadow.h"
#include "svoShadowBuffer.h"
#include "svoShadowRays.h"

#include <vector>

namespace svo
{
/// The light, buffers and rays are borrowed, for a frame.
class BufferShadow : public LightShadow
{
public:
  /// `name`: LightTile::light of the opaque casters' buffer. `translucent`: buffers of the groups
  /// of translucent casters. `rays`: of points at the terminator, null where no mesh is smooth.
  /// `filters`: as ShadowBuffer::darkness().
  BufferShadow(const Light& light, const ShadowBuffer& opaque, std::uint16_t name,
    std::vector<const ShadowBuffer*> translucent, const ShadowRays* rays, bool filters);

  std::uint64_t test(const ShadowQuery& query, float* missed) const override;
  bool dims() const override { return !this->Translucent.empty(); }
  void dim(const ShadowQuery& query, float* missed) const override;
  bool knowsTerminator() const override { return this->Opaque.automaticBias(); }
  double grazing() const override;
  void testTerminator(const ShadowQuery& query, const std::vector<TerminatorPoint>& points,
    float* missed) const override;
  void noteTerminator(const ShadowQuery& query, const TerminatorPoint& at, PointBox& rays,
    RaisedTiles& raised) const override;

private:
  const Light& Source;
  const ShadowBuffer& Opaque;
  std::uint16_t Name;
  std::vector<const ShadowBuffer*> Translucent;
  const ShadowRays* Rays;
  bool Filters;
};
}

#endif
