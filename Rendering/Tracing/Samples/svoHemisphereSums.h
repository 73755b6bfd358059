// Samples of what is all around points, summed up.
#ifndef svoHemisphereSums_h
#define svoHemisphereSums_h

#include "svoFrame.h"
#include "svoHemisphereRays.h"
#include "svoLightImages.h"
#include "svoLightShadow.h"
#include "svoReceivers.h"
#include "svoSampleSums.h"
#include "svoShadows.h"
#include "svoSky.h"
#include "svoTilePatch.h"

#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// Nothing has been added to those of some points.
inline void clearSums(SampleSums& sums, std::uint64_t points)
{
  eachBit(points, [&](int i) { sums.set(i, 0.0f, 0.0f); });
}

/// What of the points of a query is closed off around them, 0..1.
inline void sampleOcclusion(
  const ShadowQuery& query, const HemisphereRays& rays, SampleSums& closed)
{
  clearSums(closed, query.asked);
  rays.each(query,
    [&](int i, const glm::vec3&, float blocked)
    {
      closed.sum[i] += sampleShare(blocked);
      closed.count[i] += 1.0f;
    });
}

/// What they see of the sky, of Sky::brightest(): three sums, of red, green and blue. The
/// query's are the first.
inline void sampleSky(
  const ShadowQuery& query, const HemisphereRays& rays, const Sky& sky, SampleSums* seen)
{
  for (int c = 0; c < 3; ++c)
  {
    clearSums(seen[c], query.asked);
  }
  rays.each(query,
    [&](int i, const glm::vec3& along, float blocked)
    {
      const glm::vec3 share = (1.0f - blocked) * sky.share(along, normalOver(query.patch, i));
      for (int c = 0; c < 3; ++c)
      {
        seen[c].sum[i] += sampleShare(share[c]);
        seen[c].count[i] += 1.0f;
      }
    });
}

/// Samples both, as far as they are sampled, for a frame's images. The query's sums are the first
/// of three.
inline void sampleAround(const ShadowQuery& query, const Shadows& shadows,
  const FrameSettings& settings, LightImages& images)
{
  const SampledPlanes& planes = images.sampled();
  if (planes.ofOcclusion != SampledPlanes::None)
  {
    sampleOcclusion(query, *shadows.occlusion(), *query.sums);
    images.put(planes.ofOcclusion, query.patch, query.asked, *query.sums);
  }
  if (planes.ofSky != SampledPlanes::None)
  {
    sampleSky(query, *shadows.sky(), Sky(settings), query.sums);
    for (int c = 0; c < 3; ++c)
    {
      images.put(planes.ofSky + c, query.patch, query.asked, query.sums[c]);
    }
  }
}
}

#endif
