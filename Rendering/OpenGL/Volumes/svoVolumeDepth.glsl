// The depth of each pixel's place, as svoShadowVolume.glsl's volumes have theirs. svoUnfold.glsl and
// svoVolumeReceiver.glsl come before it.
uniform sampler2D svoPlaces;
uniform sampler2D svoPlanes;
uniform vec4 svoLight;
uniform vec2 svoReach;
uniform float svoParallel;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 place = texelFetch(svoPlaces, pixel, 0);
  vec4 planes = 2.0 * texelFetch(svoPlanes, pixel, 0) - 1.0;
  vec3 facet = svoUnfold(planes.xy);
  float depth = -place.z;
  float gap = svoVolumeGap(place.xyz, facet, svoParallel);
  depth -= svoParallel > 0.0 ? gap : depth * gap;
  // All of a volume lies behind 0, as often into it as out of it.
  gl_FragDepth = svoCountsVolumes(place, facet, svoUnfold(planes.zw), svoLight, svoParallel, false)
    ? clamp((depth - svoReach.x) / svoReach.y, 0.0, 1.0) : 0.0;
}
