// How much of a light reaches a fragment, as the shadow mask has it (svoShadowMask.h). Where
// svoHasOthers is defined there are fragments of which the mask knows nothing: they ask themselves.
uniform sampler2DArray svoShares; // four lights a layer
uniform int svoFirstPixel[2];     // of the mask, in the window
#ifdef svoHasOthers
uniform sampler2D svoPlaces; // svoShadowMaskShader.glsl
uniform float svoOpaque;     // 1: nothing is seen through this surface
#endif

float svoLeft(int number, vec3 position, vec3 facet, vec3 normal, vec3 lift, float extent)
{
  ivec2 pixel = ivec2(gl_FragCoord.xy) - ivec2(svoFirstPixel[0], svoFirstPixel[1]);
#ifdef svoHasOthers
  // A part of a pixel whose centre shows another surface takes the light of the pixel beside it that
  // shows its own. What lies behind all of these is not seen, but where they are as near as two of its
  // own pixels are to each other: things that touch.
  ivec2 last = textureSize(svoShares, 0).xy - 1;
  ivec2 best = ivec2(-1);
  float least = 2.0 * extent;
  bool hidden = svoOpaque > 0.0;
  float near = 2.0 * extent / max(abs(dot(normalize(position), facet)), 0.05);
  for (int i = 0; i < 9 && svoOpaque > 0.0 && least > 0.01 * extent; ++i)
  {
    // The pixel itself comes first.
    ivec2 at = clamp(pixel + ivec2((i + 4) % 9 % 3, (i + 4) % 9 / 3) - 1, ivec2(0), last);
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
  return texelFetch(svoShares, ivec3(pixel, number / 4), 0)[number % 4];
}
