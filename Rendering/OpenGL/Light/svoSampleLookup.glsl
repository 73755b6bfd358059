// What is left of a light, or of what is all around, at a fragment whose own surface the mask does not
// know there. What is sampled is that of the nearest place which the mask knows beside it, in any
// slice. If there is none, or of a light none that is near, it is what svoLeftByRay() says of the
// light, or nothing closes it off.
//
// svoSkyShader.glsl and svoMaskLookup.glsl come before it, and svoSumOf of svoSampleMeans.glsl.
float svoRayLeft(int number, vec3 position, vec3 facet, vec3 normal, vec3 lift, float extent)
{
  ivec2 pixel = svoMaskPixel();
  ivec2 best = ivec2(-1);
  float least = number < svoLampCount ? 8.0 * extent : 1e30;
  for (int i = 0; i < svoBesideCount() && svoSumOf[number] >= 0; ++i)
  {
    ivec2 at = svoBeside(pixel, i);
    vec4 place = texelFetch(svoPlaces, at, 0);
    if (place.w > -1e30 && distance(place.xyz, position) < least)
    {
      least = distance(place.xyz, position);
      best = at;
    }
  }
  return best.x >= 0 ? svoShareOf(number, best)
    : number < svoLampCount ? svoLeftByRay(number, position, facet, normal, lift, extent)
                            : svoOpen(number, normal);
}
