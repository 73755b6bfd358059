// What points see all around them: rays over their hemispheres, each direction as often as its
// cosine. How much of it surfaces nearby close off is ambient occlusion (Zhukov et al., "An Ambient
// Light Illumination Model", 1998; Landis, "Production-Ready Global Illumination", 2002), what
// comes from where nothing does is a sky's light.
#ifndef svoHemisphereRays_h
#define svoHemisphereRays_h

#include "svoCasterBox.h"
#include "svoLightShadow.h"
#include "svoSampleRays.h"
#include "svoSampleSequence.h"
#include "svoScene.h"
#include "vtkSVOTracingModule.h"

#include <functional>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
/// The distance of ambient occlusion where users name none, world: a fifth of the diagonal of all
/// that casts.
VTKSVOTRACING_EXPORT double usualOcclusionDistance(const Scene& scene);

class VTKSVOTRACING_EXPORT HemisphereRays
{
public:
  /// Streams that no light has.
  static constexpr unsigned OcclusionStream = ~0u, SkyStream = ~1u;

  /// `distance`: beyond it nothing counts, world. The rays are borrowed, for a frame. `samples`: of
  /// each point, at least 1. `stream`: of pixelRotation().
  HemisphereRays(const SampleRays& rays, double distance, unsigned stream, int samples);

  /// Calls f(pixel, direction, blocked) for all rays of the points that are asked, around their
  /// normals, but for those below their facets. `blocked`: 0..1.
  void each(
    const ShadowQuery& query, const std::function<void(int, const glm::vec3&, float)>& f) const;

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
  const unsigned Stream;
  std::vector<SquarePoint> Samples;
};
}

#endif
