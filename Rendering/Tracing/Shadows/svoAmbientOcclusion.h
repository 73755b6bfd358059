// How much of the hemisphere over a point other surfaces close off nearby: ambient occlusion, by
// rays (Zhukov et al., "An Ambient Light Illumination Model", 1998; Landis, "Production-Ready
// Global Illumination", 2002). A surface counts by the cosine of its direction.
#ifndef svoAmbientOcclusion_h
#define svoAmbientOcclusion_h

#include "svoCasterBox.h"
#include "svoLightShadow.h"
#include "svoSampleRays.h"
#include "svoSampleSequence.h"
#include "vtkSVOTracingModule.h"

#include <vector>

namespace svo
{
/// The distance where users name none, world: a fifth of the diagonal of all that casts.
double usualOcclusionDistance(const Scene& scene);

class VTKSVOTRACING_EXPORT AmbientOcclusion
{
public:
  /// `distance`: beyond it nothing counts, world. The rays are borrowed, for a frame. `samples`: of
  /// each point, at least 1.
  AmbientOcclusion(const SampleRays& rays, double distance, int samples);

  /// Sets the share of the hemisphere that is closed, by pixel, 0..1, of the points that are asked:
  /// on the side of their facets that the viewer sees.
  void test(const ShadowQuery& query, float* closed) const;

  /// All that rays can meet which start in a box.
  BoxWay way(const PointBox& starts) const
  {
    BoxWay way(starts, glm::dvec3(0.0), 0.0);
    way.half += this->Distance;
    return way;
  }

private:
  const SampleRays& Rays;
  const double Distance;
  std::vector<SquarePoint> Samples;
};
}

#endif
