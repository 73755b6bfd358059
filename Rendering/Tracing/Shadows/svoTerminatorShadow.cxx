#include "svoTerminatorShadow.h"

#include <cassert>

#include <glm/geometric.hpp>

namespace svo
{
void testTerminatorPoints(const ShadowBuffer* buffer, const ShadowRays* rays, const Light& light,
  const ShadowQuery& query, double error, const double* extents,
  const std::vector<TerminatorPoint>& points, float* missed)
{
  assert(points.size() <= ShadowRays::Most);
  const SurfacePoint* asked[ShadowRays::Most] = {}; // by rays to the light, after all else
  float* answers[ShadowRays::Most];
  float ifLit[ShadowRays::Most];
  int count = 0;
  for (const TerminatorPoint& at : points)
  {
    float& answer = missed[at.pixel];
    if (at.kind == TerminatorPoint::Kind::Hidden)
    {
      answer = 1.0f;
      continue;
    }
    assert(at.kind != TerminatorPoint::Kind::Plain && rays);
    // A map says that a point is dark for less than it takes rays to say that ways are free.
    const double* extent = extents ? extents + at.pixel : nullptr;
    const ShadowBuffer::MapAnswer inMap =
      buffer ? buffer->ask(at.point, error, extent) : ShadowBuffer::MapAnswer();
    const bool doubted = at.kind == TerminatorPoint::Kind::Doubted;
    if (!doubted)
    {
      answer = 1.0f; // unless all is free
    }
    if (inMap.darkness >= answer)
    {
      continue;
    }
    const glm::dvec3 on = query.patch.position(at.pixel);
    if (doubted || glm::distance(on, at.point.position) > inMap.texel)
    {
      ++query.rays;
      const glm::dvec3 start = ShadowRays::start(light, at.point.position, at.point.facet, error);
      if (rays->between(on, start, error))
      {
        continue;
      }
    }
    if (!doubted && inMap.known)
    {
      answer = inMap.darkness;
      continue;
    }
    query.rays += !doubted;
    asked[count] = &at.point;
    answers[count] = &answer;
    ifLit[count++] = inMap.darkness;
  }
  const std::uint64_t dark = rays ? rays->shadows(light, asked, count, error) : 0;
  for (int i = 0; i < count; ++i)
  {
    *answers[i] = dark >> i & 1 ? *answers[i] : ifLit[i];
  }
}
}
