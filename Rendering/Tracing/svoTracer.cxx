#include "svoTracer.h"

namespace svo
{
struct Tracer::Internals
{
  FrameStatistics Statistics;
  std::vector<ShadowMap> Maps;
};

Tracer::Tracer()
  : Impl(new Internals)
{
}

Tracer::~Tracer() = default;

void Tracer::render(
  const Scene&, const View&, const FrameSettings&, const ParallelFor&, Frame&)
{
}

const FrameStatistics& Tracer::statistics() const
{
  return this->Impl->Statistics;
}

const std::vector<ShadowMap>& Tracer::shadowMaps() const
{
  return this->Impl->Maps;
}

void Tracer::releaseLayers() {}
}
