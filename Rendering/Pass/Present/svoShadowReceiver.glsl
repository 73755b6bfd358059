// What is shown of a light on a fragment of a rasterised surface, where svoLeft() (svoLightCode.h) says
// how much of it casters leave.
uniform float svoReceive; // 0: no shadow falls on this surface
uniform float svoIntensity;
uniform float svoGather;   // 1: the fragment says where it lies
#ifdef svoSlices
uniform sampler2D svoBefore; // the slice before the one that is gathered (svoPlaceBuffer.h),
uniform int svoBehind;       // ... whose first row is this; 0: it is not among them
#endif
uniform float svoMirrored; // 1: derivatives in the window turn facets away from the viewer

// Where a fragment lies whose facet covers a part of its pixel, and maybe not the centre. `inside` has
// been interpolated there: Mesa's llvmpipe takes the centre's depth for that, so the point is moved
// along its line of sight onto the facet, where it is anyway.
vec3 svoInFacet(vec3 centre, vec3 inside, vec3 facet)
{
  float onto = dot(facet, centre) / dot(facet, inside);
  return abs(onto - 1.0) < 0.5 ? onto * inside : centre;
}

// How far the smooth surface that the normals stand for lies over a point of a facet, as
// svoTerminator.h has it from all three corners: here from one, and from the normal at the point,
// which together make a parabola. `corner`: the facet's, with its unit normal.
vec3 svoSmoothLift(vec3 position, vec3 facet, vec3 normal, vec3 corner, vec3 cornerNormal)
{
  vec3 outwards = dot(cornerNormal, normal) < 0.0 ? -cornerNormal : cornerNormal;
  float height = dot(normal + outwards, corner - position);
  return dot(facet, normal) > 0.0 ? max(height, 0.0) * normal : vec3(0.0);
}

// The share of a light that is shown where so much of it is left.
float svoShown(float left)
{
  return 1.0 - svoReceive * svoIntensity * (1.0 - left);
}

// Where a fragment lies, as svoShadowMaskShader.glsl reads it: the place, with the lift's length, or of
// what was traced how far above it rays begin; the facet's normal and that for shading.
vec4 svoPlaceOf(vec3 position, vec3 lift, float above)
{
  return vec4(position, svoReceive > 0.0 ? (above > 0.0 ? -above : length(lift)) : -1e30);
}

vec2 svoFold(vec3 way)
{
  vec2 folded = way.xy / (abs(way.x) + abs(way.y) + abs(way.z));
  vec2 turned = (1.0 - abs(folded.yx)) * vec2(folded.x < 0.0 ? -1.0 : 1.0, folded.y < 0.0 ? -1.0 : 1.0);
  return way.z < 0.0 ? turned : folded;
}

vec4 svoPlanesOf(vec3 facet, vec3 normal)
{
  return 0.5 + 0.5 * vec4(svoFold(facet), svoFold(normal));
}

// False if what is gathered is to lie behind a surface that this fragment, at a place, is not behind.
// The surface itself is drawn to another row, where floats and parts of pixels round differently.
// `extent`: how wide a piece of it the fragment shows; `steep`: ... and how deep.
bool svoIsBehind(vec3 position, float extent, float steep)
{
#ifdef svoSlices
  ivec2 at = ivec2(gl_FragCoord.xy) - ivec2(0, svoBehind);
  float rounding = max(0.05 * max(extent, steep), 1e-6 * length(position));
  return svoBehind == 0 || position.z < texelFetch(svoBefore, at, 0).z - rounding;
#else
  return true;
#endif
}
