// The numbers by which points are tested against shadow maps: svoShadowTest.h has the test, and
// whoever asks a ShadowMap elsewhere, as a shader does, takes the same ones.
#ifndef svoShadowRules_h
#define svoShadowRules_h

namespace svo
{
/// An occluder is nearby within so many texels' depth of the point; so far a point's planes are
/// followed along the light in any case.
constexpr double NearbyReach = 8.0;

/// How far a plane in grazing light is followed towards the light, in texels.
constexpr double GrazingReach = 64.0;

/// Sine of the light's angle to a plane up to which the plane is edge-on and says nothing.
constexpr double EdgeOnSine = 1e-3;

/// What is allowed for lies along the normal. Along the light it is longer, as if the sine of the
/// light's angle to the surface were this at least.
constexpr double LeastSteepness = 0.1;

/// By how much a surface may leave its plane inside a texel, in texels.
constexpr double TexelBend = 0.5;

/// How many of the other three texels around a point have to find it dark, where the occluder that
/// its own texel holds is nearby.
constexpr int TexelsToAgree = 2;

/// The filter's widest box, texels.
constexpr double WidestBox = 4.0;

/// Where a map ends, in clip space. Rounding may put a point on the border of two maps beyond both;
/// it belongs to the last texel of either.
constexpr double MapBorder = 1.0 + 1e-12;

/// The same for who computes in single precision.
constexpr double MapBorderOfFloats = 1.0 + 1e-5;

struct ShadowRule
{
  const char* name;
  double value;
};

/// The numbers for who takes them by name.
constexpr ShadowRule ShadowRules[] = { { "NearbyReach", NearbyReach },
  { "GrazingReach", GrazingReach }, { "EdgeOnSine", EdgeOnSine },
  { "LeastSteepness", LeastSteepness }, { "TexelBend", TexelBend },
  { "TexelsToAgree", TexelsToAgree }, { "WidestBox", WidestBox },
  { "MapBorder", MapBorderOfFloats } };
}

#endif
