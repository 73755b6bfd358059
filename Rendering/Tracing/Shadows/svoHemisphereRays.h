// What points see all around them: rays over their hemispheres, each direction as often as its
// cosine, or as light comes from it. How much of it surfaces nearby close off is ambient occlusion
// (Zhukov et al., "An Ambient Light Illumination Model", 1998; Landis, "Production-Ready Global
// Illumination", 2002), what comes from where nothing does is a sky's light.
#ifndef svoHemisphereRays_h
#define svoHemisphereRays_h

#include "svoCasterBox.h"
#include "svoLightShadow.h"
#include "svoRayCasters.h"
#include "svoSampleSequence.h"
#include "svoScene.h"
#include "svoSkyPicture.h"
#include "svoTilePatch.h"
#include "vtkSVOTracingModule.h"

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// The distance of ambient occlusion where users name none, world: a fifth of the diagonal of all
/// that casts.
VTKSVOTRACING_EXPORT double usualOcclusionDistance(const Scene& scene);

/// The same, found once a scene.
class UsualOcclusionDistance
{
public:
  double of(const Scene& scene)
  {
    if (scene.version == 0 || scene.version != this->Version)
    {
      this->Distance = usualOcclusionDistance(scene);
      this->Version = scene.version;
    }
    return this->Distance;
  }

private:
  std::uint64_t Version = 0;
  double Distance = 0.0;
};

/// The normal of a point that its hemisphere is around: on the viewer's side of its facet.
inline glm::vec3 normalOver(const TilePatch& patch, int i)
{
  const glm::vec3 normal = patch.normal(i), facet = patch.facet(i);
  return glm::dot(normal, facet) > 0.0f ? normal : facet;
}

class VTKSVOTRACING_EXPORT HemisphereRays
{
public:
  /// Streams that no light has.
  static constexpr unsigned OcclusionStream = ~0u, SkyStream = ~1u;

  /// `distance`: beyond it nothing counts, world. Casters are borrowed, for a frame. `samples`: of
  /// each point, at least 1. `picture`: of the light, borrowed; or null.
  HemisphereRays(const RayCasters& casters, double distance, const PixelRotations& rotations,
    int samples, const SkyPicture* picture = nullptr);

  /// Calls f(pixel, direction, blocked) for all rays of the points that are asked, around their
  /// normals, but for those below their facets. `blocked`: 0..1. With a picture: for all of its
  /// directions; those below the facet, where no ray begins, are not blocked.
  void each(
    const ShadowQuery& query, const std::function<void(int, const glm::vec3&, float)>& f) const;

  /// All that rays can meet which start in a box.
  BoxWay way(const Box& starts) const
  {
    return { 0.5 * (starts.low + starts.high), 0.5 * (starts.high - starts.low) + this->Distance,
      glm::dvec3(0.0), 0.0, 0.0 };
  }

private:
  const RayCasters& Casters;
  const double Distance;
  const PixelRotations Rotations;
  const SkyPicture* const Picture;
  std::vector<SquarePoint> Samples;
};
}

#endif
