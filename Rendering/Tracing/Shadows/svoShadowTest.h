// The shadow test: what one texel of a shadow map says of one point, with the automatic bias. Whole
// tiles of points and single points call the same function, so that they get the same bits; it has
// no branches, so that a loop over points becomes vectors. Callers say where the point and the
// texel are; what the rule makes of that is known here alone.
//
// The point is not compared itself: its tangent planes are, at the ray of the texel's own centre
// (Dou et al., "Adaptive Depth Bias for Shadow Maps", JCGT 2014, section 3), so that the slope of
// the receiver and the size of the texel cost nothing. Both its planes, the facet's and the one
// that is shaded with, have to lie behind the occluder: where a facet faces the light its own plane
// is exact, and near the terminator, where facets disagree with the curved surface that they stand
// for about which way the light goes by, the other one is right. What remains is the bend of the
// surface inside a texel and the leaf's own error, both known.
#ifndef svoShadowTest_h
#define svoShadowTest_h

#include "svoShadowRules.h"
#include "svoTexelPlace.h"
#include "svoView.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// One point and one texel; world coordinates.
struct ShadowQuestion
{
  glm::dvec3 position;
  glm::dvec3 facet, normal; // the point's planes, as in SurfacePoint
  double t;                 // linear depth of the point
  double x, y;              // the texel's centre
  double span;              // the texel is taken for so many times as large as it is
  double occluder;          // linear depth of what lies at the texel; infinity: nothing
  double bias;              // along the light
  double error;             // along the normal: of the point, or of what casts
};

/// The texel of a question in the world.
struct ShadowTexel
{
  glm::dvec3 to;  // to the point, from where the texel's ray has linear depth 0
  glm::dvec3 ray; // through the texel's centre; linear depth grows by 1
  double length;  // of that
  double edge;    // at the point's depth, the shorter one
  double aspect;  // the longer edge, in shorter ones
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

inline ShadowPlane followPlane(
  const ShadowQuestion& q, const ShadowTexel& texel, const glm::dvec3& normal)
{
  const double along = glm::dot(normal, texel.ray);
  const double slope = std::abs(along) / texel.length;
  const double met = glm::dot(normal, texel.to) / along;
  const double most = NearbyReach * texel.edge, high = q.t + most;
  // Inside a texel a plane in grazing light reaches far towards the light. Where it is edge-on it
  // says nothing.
  const double wide = texel.aspect * texel.edge, farthest = GrazingReach * wide;
  const double reach = wide < farthest * slope ? wide / slope : farthest;
  const double low = q.t - (most < reach ? reach : most);
  const double capped = high < met ? high : met;
  const double bounded = met < low ? low : capped;
  return { slope > EdgeOnSine ? bounded : low, slope };
}

/// `edges`: of the map's texels. 0: lit; 1: dark by an occluder nearby, which other texels have to
/// agree on; 2: dark.
inline double shadowTest(const View& map, const TexelEdge& edges, const ShadowQuestion& q)
{
  const glm::dvec3 ray = map.rayDirection(q.x, q.y);
  const ShadowTexel texel{ q.position - map.rayOrigin(q.x, q.y), ray, std::sqrt(glm::dot(ray, ray)),
    q.span * edges(q.t), edges.aspect };
  const ShadowPlane facet = followPlane(q, texel, q.facet);
  const ShadowPlane normal = followPlane(q, texel, q.normal);
  const double most = NearbyReach * texel.edge, low = q.t - most, high = q.t + most;
  const double nearer = facet.t < high ? facet.t : high;
  const double receiver = normal.t < nearer ? normal.t : nearer;
  const double steeper = LeastSteepness < facet.slope ? facet.slope : LeastSteepness;
  const double steepest = steeper < normal.slope ? normal.slope : steeper;
  // Half a texel and the leaf's error, both along the normal.
  const double allowed = q.bias + (TexelBend * texel.edge + q.error) / steepest;
  const double front = q.occluder + allowed < receiver ? 1.0 : 0.0;
  const double which = q.occluder < low ? 2.0 : 1.0;
  return mayShadow(q.t, texel.edge, q.occluder, q.bias) ? front * which : 0.0;
}
}

#endif
