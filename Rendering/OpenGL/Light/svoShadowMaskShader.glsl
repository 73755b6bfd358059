// The shares of four lights for a pixel, asked of svoLeft() (svoLightCode.h) where the surface lies
// that is seen there. svoUnfold() is svoOctreeWalk.glsl's, svoAbove svoRayWalk.glsl's. Where
// svoHasVolumes is defined svoVolumeReceiver.glsl comes before it.
//
// View coordinates; and the lift's length, or below 0 -svoAbove of what was traced; -svoFar: nothing is
// asked.
uniform sampler2D svoPlaces;
uniform sampler2D svoPlanes; // the facet's normal and that for shading, folded
uniform int svoFirstLight;
#ifdef svoHasVolumes
uniform float svoParallel; // 1: rays of the picture are
#endif

vec4 svoAnswerAt(ivec2 pixel)
{
  vec4 shares = vec4(1.0);
  vec4 place = texelFetch(svoPlaces, pixel, 0);
  if (place.w <= -svoFar)
  {
    return shares;
  }
  vec4 planes = 2.0 * texelFetch(svoPlanes, pixel, 0) - 1.0;
  vec3 facet = svoUnfold(planes.xy);
  vec3 normal = svoUnfold(planes.zw);
  svoAbove = max(-place.w, 0.0);
#ifdef svoHasVolumes
  // One alone, of what these do not tell (svoVolumeCounter.h).
  const int count = 1;
  svoBesideVolumes =
    svoCountsVolumes(place, facet, normal, svoLights[svoFirstLight], svoParallel, true);
#else
  int count = min(4, svoLightCount - svoFirstLight);
#endif
  for (int i = 0; i < count; ++i)
  {
    shares[i] = svoLeft(svoFirstLight + i, place.xyz, facet, normal, max(place.w, 0.0) * normal, 0.0);
  }
#ifdef svoHasVolumes
  return shares.xxxx;
#else
  return shares;
#endif
}
