// The tracer on the processor: select, trace, merge, shadow, shade.
#ifndef svoCPUTracer_h
#define svoCPUTracer_h

#include "svoTracer.h"

#include <memory>

namespace svo
{
class VTKSVOTRACING_EXPORT CPUTracer : public Tracer
{
public:
  CPUTracer();
  ~CPUTracer() override;

  std::vector<NeededLevels> neededLevels(
    const Scene& scene, const View& view, const FrameSettings& settings) const override;
  void render(const Scene& scene, const View& view, const FrameSettings& settings,
    const ParallelFor& parallelFor) override;
  Frame& frame() override;
  bool shareShadows(const Scene& scene, const View& view, const FrameSettings& settings,
    const ParallelFor& parallelFor, Processes& processes) override;
  void divideEdges(const Scene& scene, const View& view, const std::vector<glm::vec2>& positions,
    const ParallelFor& parallelFor, Silhouettes& result) const override;
  const ReceiverShares& receiverShares() const override;
  void sampleReceivers(const Scene& scene, const View& view, const ReceiverPlaces& places,
    bool same, const ParallelFor& parallelFor) override;
  const FrameStatistics& statistics() const override;
  const std::vector<ShadowMap>& shadowMaps() const override;
  void releaseLayers() override;

private:
  struct Internals;
  std::unique_ptr<Internals> Impl;
};
}

#endif
