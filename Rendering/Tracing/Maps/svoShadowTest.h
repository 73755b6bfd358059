// The shadow test: what one texel of a shadow map says of one point, with the automatic bias.
// Single points ask it in double; whole patches ask it in single precision, with depths from the
// patch's origin, and in double once more where they cannot be sure (svoTileShadows.h). Either is
// this one function, which has no branches, so that a loop over points becomes vectors. Callers say
// where the point and the texel are; what the rule makes of that is known here alone.
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

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// One point and one texel; along the world's axes. Linear depths count from any depth that is the
/// same for all of them.
template <class Real>
struct ShadowQuestion
{
  using Vector = glm::vec<3, Real>;
  Vector facet, normal; // the point's planes, as in SurfacePoint
  Vector to;            // to the point, from where the ray of the texel's centre has depth 0
  Vector ray;           // of the texel's centre; linear depth grows by 1
  Real t;               // linear depth of the point
  Real edge;            // of the texel at that depth, the shorter one
  Real aspect;          // the longer edge, in shorter ones
  Real occluder;        // linear depth of what lies at the texel; infinity: nothing
  Real bias;            // along the light
  Real error;           // along the normal: of the point, or of what casts
};

/// One of a point's planes, as the texel's ray meets it.
template <class Real>
struct ShadowPlane
{
  Real t;     // linear depth where the ray meets the plane, as far as it is followed
  Real slope; // sine of the ray's angle to the plane
};

/// What the answer hangs on: the point is dark if the first two are above 0.
template <class Real>
struct ShadowAnswer
{
  Real reached;   // by how much the occluder lies before what the planes can be followed to
  Real behind;    // ... and, with all that is allowed for, before them
  Real farBefore; // ... and, if above 0, is not nearby
  Real allowed;
  Real slope;  // of the flatter plane
  Real edgeOn; // by how much a plane's slope is other than EdgeOnSine
  /// 0: lit; 1: dark by an occluder nearby, which other texels have to agree on; 2: dark.
  int shadowed() const
  {
    const int which = farBefore > Real(0) ? 2 : 1;
    return (reached > Real(0)) & (behind > Real(0)) ? which : 0;
  }
};

/// By how much an occluder lies before what a point's planes can be followed to; if it does not,
/// the point is lit whatever they are.
template <class Real>
Real reachedBy(Real t, Real edge, Real occluder, Real bias)
{
  return (t + Real(NearbyReach) * edge) - (occluder + bias);
}

template <class Real>
[[gnu::always_inline]] inline ShadowPlane<Real> followPlane(
  const ShadowQuestion<Real>& q, Real length, const glm::vec<3, Real>& normal)
{
  const Real along = glm::dot(normal, q.ray);
  const Real slope = std::abs(along) / length;
  const Real met = glm::dot(normal, q.to) / along;
  const Real most = Real(NearbyReach) * q.edge, high = q.t + most;
  // Inside a texel a plane in grazing light reaches far towards the light. Where it is edge-on it
  // says nothing.
  const Real wide = q.aspect * q.edge, farthest = Real(GrazingReach) * wide;
  const Real steep = wide / slope;
  const Real reach = wide < farthest * slope ? steep : farthest;
  const Real low = q.t - (most < reach ? reach : most);
  const Real capped = high < met ? high : met;
  const Real bounded = met < low ? low : capped;
  return { slope > Real(EdgeOnSine) ? bounded : low, slope };
}

template <class Real>
[[gnu::always_inline]] inline ShadowAnswer<Real> shadowTest(const ShadowQuestion<Real>& q)
{
  const Real length = std::sqrt(glm::dot(q.ray, q.ray));
  const ShadowPlane<Real> facet = followPlane(q, length, q.facet);
  const ShadowPlane<Real> normal = followPlane(q, length, q.normal);
  const Real most = Real(NearbyReach) * q.edge, low = q.t - most, high = q.t + most;
  const Real nearer = facet.t < high ? facet.t : high;
  const Real receiver = normal.t < nearer ? normal.t : nearer;
  const Real steeper = Real(LeastSteepness) < facet.slope ? facet.slope : Real(LeastSteepness);
  const Real steepest = steeper < normal.slope ? normal.slope : steeper;
  // Half a texel and the leaf's error, both along the normal.
  const Real allowed = q.bias + (Real(TexelBend) * q.edge + q.error) / steepest;
  const Real first = std::abs(facet.slope - Real(EdgeOnSine));
  const Real second = std::abs(normal.slope - Real(EdgeOnSine));
  return { reachedBy(q.t, q.edge, q.occluder, q.bias), receiver - (q.occluder + allowed),
    low - q.occluder, allowed, facet.slope < normal.slope ? facet.slope : normal.slope,
    first < second ? first : second };
}
}

#endif
