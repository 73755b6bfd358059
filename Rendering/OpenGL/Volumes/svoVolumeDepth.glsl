// The depth of each pixel's place, as svoShadowVolume.glsl's volumes have theirs; 0 where no light is to
// come, and no fragment where a ray has to tell it. svoUnfold.glsl and
// svoVolumeReceiver.glsl come before it.
uniform sampler2D svoPlaces;
uniform sampler2D svoPlanes;
uniform vec4 svoLight;
uniform float svoReach[2]; // VolumeDraws
uniform float svoParallel;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 place = texelFetch(svoPlaces, pixel, 0);
  vec4 planes = 2.0 * texelFetch(svoPlanes, pixel, 0) - 1.0;
  vec3 facet = svoUnfold(planes.xy);
  vec3 normal = svoUnfold(planes.zw);
  bool counts = svoCountsVolumes(place, facet, normal, svoLight, svoParallel, false);
  bool lit = place.w > -1e30 && dot(normal, svoLight.xyz - svoLight.w * place.xyz) > 0.0;
  if (lit && !counts)
  {
    discard;
  }
  float depth = svoVolumeDepth(place.xyz, facet);
  gl_FragDepth = counts ? clamp((depth - svoReach[0]) / svoReach[1], 0.0, 1.0) : 0.0;
}
