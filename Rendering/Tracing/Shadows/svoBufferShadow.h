// A light's shadow by its shadow buffers.
#ifndef svoBufferShadow_h
#define svoBufferShadow_h

#include "svoLightShadow.h"
#include "svoMapTest.h"
#include "svoShadowBuffer.h"
#include "svoShadowRays.h"
#include "svoShadowRules.h"
#include "svoTerminatorShadow.h"

#include <vector>

namespace svo
{
/// The light, its buffers and rays are borrowed, for a frame.
class BufferShadow : public LightShadow
{
public:
  /// `rays`: of points at the terminator, null where no mesh is smooth. `filters`: as
  /// MapTest::darkness().
  BufferShadow(const Light& light, const LightBuffers& maps, const ShadowRays* rays, bool filters)
    : LightShadow(&maps)
    , Source(light)
    , Opaque(maps.opaque())
    , Name(maps.nameOfOpaque())
    , Translucent(maps.translucent())
    , Rays(rays)
    , Filters(filters)
  {
  }

  std::uint64_t test(const ShadowQuery& query, float* missed) const override
  {
    if (!this->Filters)
    {
      return missAll(
        MapTest(this->Opaque.maps()).shadows(query.patch, query.errors.map, query.asked), missed);
    }
    std::uint64_t dark = 0;
    MapTest(this->Opaque.maps())
      .darkness(query.patch, query.errors.map, query.extents, query.asked, missed);
    eachBit(query.asked, [&](int i) { dark |= std::uint64_t(missed[i] > 0.0f) << i; });
    return dark;
  }

  bool dims() const override { return !this->Translucent.empty(); }

  void dim(const ShadowQuery& query, float* missed) const override
  {
    const std::uint64_t left = leftOf(query, missed);
    alignas(64) float taken[TilePatch::Most];
    for (const ShadowBuffer* const buffer : this->Translucent)
    {
      MapTest(buffer->maps())
        .taken(query.patch, query.errors.map, this->Filters ? query.extents : nullptr, left, taken);
      takeOfRest(left, taken, missed);
    }
  }

  bool knowsTerminator() const override { return this->Opaque.maps().automaticBias; }
  double grazing() const override { return 1.0 / GrazingReach; }

  void testTerminator(const ShadowQuery& query, const std::vector<TerminatorPoint>& points,
    float* missed) const override
  {
    testTerminatorPoints(&this->Opaque, this->Rays, this->Source, query, query.errors.map,
      this->Filters ? query.extents : nullptr, points, missed);
  }

  void noteTerminator(const ShadowQuery& query, const TerminatorPoint& at, Box& rays,
    RaisedTiles& raised) const override
  {
    const glm::dvec3 reach(query.errors.map);
    rays.add(query.patch.position(at.pixel), reach);
    rays.add(at.point.position, reach);
    this->Opaque.note(at.point.position, this->Name, raised);
  }

private:
  void count(FrameStatistics& statistics) const override { ++statistics.lightsWithBuffers; }

  const Light& Source;
  const ShadowBuffer& Opaque;
  BufferName Name; // of it
  std::vector<const ShadowBuffer*> Translucent;
  const ShadowRays* Rays;
  bool Filters;
};
}

#endif
