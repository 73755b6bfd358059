// How much of a light reaches a fragment, as a mask has it: svoShadowMask.h, svoSampledMask.h. Where
// svoHasOthers is defined there are fragments of which the mask knows nothing: they ask themselves.
// Where svoSlices is it knows so many slices (svoPlaceBuffer.h), else nothing of what is translucent.
// svoPlaneOf(number): which of its planes; where svoHasMaps is defined none, below 0, is one that
// svoLeftByRay() has, or below -1, that takes nothing.
uniform sampler2DArray svoShares; // four planes a layer
uniform int svoFirstPixel[2];     // of the mask, in the window
uniform float svoMaskPixels[2];   // along an edge of a pixel of the window
#ifdef svoHasOthers
uniform sampler2D svoPlaces; // svoShadowMaskShader.glsl
uniform int svoSliceRows[2]; // of a slice; from one to the next
uniform float svoOpaque;     // 1: nothing is seen through this surface
float svoRayLeft(int number, vec3 position, vec3 facet, vec3 normal, vec3 lift, float extent);
#endif
#ifndef svoPlaneOf
#define svoPlaneOf(number) (number)
#endif

ivec2 svoMaskPixel()
{
  vec2 at = gl_FragCoord.xy - vec2(svoFirstPixel[0], svoFirstPixel[1]);
  return ivec2(at * vec2(svoMaskPixels[0], svoMaskPixels[1]));
}

#ifdef svoHasOthers
// How many pixels may know a surface at one: itself and those beside it, in all slices if something
// is seen through it. A prop may be opaque in parts.
int svoBesideCount()
{
#ifdef svoSlices
  return svoOpaque > 0.0 ? 9 : 9 * svoSlices;
#else
  return svoOpaque > 0.0 ? 9 : 0;
#endif
}

// One of them; the pixel itself comes first.
ivec2 svoBeside(ivec2 pixel, int i)
{
  ivec2 last = ivec2(textureSize(svoPlaces, 0).x, svoSliceRows[0]) - 1;
  ivec2 at = clamp(pixel + ivec2((i + 4) % 9 % 3, (i + 4) % 9 / 3) - 1, ivec2(0), last);
  return at + ivec2(0, i / 9 * svoSliceRows[1]);
}
#endif

float svoShareOf(int number, ivec2 pixel)
{
  int plane = svoPlaneOf(number);
  return texelFetch(svoShares, ivec3(pixel, plane / 4), 0)[plane % 4];
}

float svoLeft(int number, vec3 position, vec3 facet, vec3 normal, vec3 lift, float extent)
{
#ifdef svoHasMaps
  if (svoPlaneOf(number) < 0)
  {
    return svoPlaneOf(number) == -1 ? svoLeftByRay(number, position, facet, normal, lift, extent) : 1.0;
  }
#endif
  ivec2 pixel = svoMaskPixel();
#ifdef svoHasOthers
  // A part of a pixel whose centre shows another surface takes the light of the pixel beside it that
  // shows its own. What lies behind all of these is not seen, but where they are as near as two of its
  // own pixels are to each other: things that touch.
  ivec2 best = ivec2(-1);
  extent /= min(svoMaskPixels[0], svoMaskPixels[1]);
  float least = 2.0 * extent;
  bool hidden = svoOpaque > 0.0;
  float near = 2.0 * extent / max(abs(dot(normalize(position), facet)), 0.05);
  for (int i = 0; i < svoBesideCount() && least > 0.01 * extent; ++i)
  {
    ivec2 at = svoBeside(pixel, i);
    vec4 place = texelFetch(svoPlaces, at, 0);
    vec3 between = place.xyz - position;
    float away = length(between);
    hidden = hidden && place.w > -1e30 && place.z > position.z + near;
    if (place.w > -1e30 && away < least && abs(dot(between, facet)) <= 0.1 * extent)
    {
      least = away;
      best = at;
    }
  }
  if (best.x < 0)
  {
    return hidden ? 1.0 : svoRayLeft(number, position, facet, normal, lift, extent);
  }
  pixel = best;
#endif
  return svoShareOf(number, pixel);
}
