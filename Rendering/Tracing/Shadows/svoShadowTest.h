// The shadow test: what one texel of a shadow map says of one point, with the automatic bias. See
// ShadowBuffer::shadows() for why. Whole tiles of points and single points call the same function,
// so that they get the same bits; it has no branches, so that a loop over points becomes vectors.
#ifndef svoShadowTest_h
#define svoShadowTest_h

#include "svoShadowRules.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// One point and one texel; world coordinates.
struct ShadowQuestion
{
  glm::dvec3 facet, normal; // the point's planes, as in SurfacePoint
  glm::dvec3 to;            // to the point, from where the texel's ray has linear depth 0
  glm::dvec3 ray;           // through the texel's centre; linear depth grows by 1
  double t;                 // linear depth of the point
  double edge;              // of the texel at that depth, the shorter one
  double aspect;            // the longer edge, in shorter ones
  double occluder;          // linear depth of what lies at the texel; infinity: nothing
  double bias;              // along the light
  double error;             // along the normal: see ShadowBuffer::shadows()
};

/// One of a point's planes, as the texel's ray meets it.
struct ShadowPlane
{
  double t;     // linear depth where the ray meets the plane, as far as it is followed
  double slope; // sine of the ray's angle to the plane
};

/// False if the texel leaves the point in the light whatever the point's planes are.
inline bool mayShadow(double t, double edge, double occluder, double bias)
{
  return occluder + bias < t + NearbyReach * edge;
}

/// `length`: of the ray.
inline ShadowPlane followPlane(const ShadowQuestion& q, const glm::dvec3& normal, double length)
{
  const double along = glm::dot(normal, q.ray);
  const double slope = std::abs(along) / length;
  const double met = glm::dot(normal, q.to) / along;
  const double most = NearbyReach * q.edge, high = q.t + most;
  // Inside a texel a plane in grazing light reaches far towards the light. Where it is edge-on it
  // says nothing.
  const double wide = q.aspect * q.edge, farthest = GrazingReach * wide;
  const double reach = wide < farthest * slope ? wide / slope : farthest;
  const double low = q.t - (most < reach ? reach : most);
  const double capped = high < met ? high : met;
  const double bounded = met < low ? low : capped;
  return { slope > EdgeOnSine ? bounded : low, slope };
}

/// 0: lit; 1: dark by an occluder nearby, which other texels have to agree on; 2: dark.
inline double shadowTest(const ShadowQuestion& q)
{
  const double length = std::sqrt(glm::dot(q.ray, q.ray));
  const ShadowPlane facet = followPlane(q, q.facet, length);
  const ShadowPlane normal = followPlane(q, q.normal, length);
  const double most = NearbyReach * q.edge, low = q.t - most, high = q.t + most;
  const double nearer = facet.t < high ? facet.t : high;
  const double receiver = normal.t < nearer ? normal.t : nearer;
  const double steeper = LeastSteepness < facet.slope ? facet.slope : LeastSteepness;
  const double steepest = steeper < normal.slope ? normal.slope : steeper;
  // Half a texel and the leaf's error, both along the normal.
  const double allowed = q.bias + (TexelBend * q.edge + q.error) / steepest;
  const double front = q.occluder + allowed < receiver ? 1.0 : 0.0;
  const double which = q.occluder < low ? 2.0 : 1.0;
  return mayShadow(q.t, q.edge, q.occluder, q.bias) ? front * which : 0.0;
}
}

#endif
