// Whether shadow volumes tell what reaches a point of a light: where rays begin at the facet itself,
// on its lit side. A place and its planes are as svoShadowMaskShader.glsl has them.
//
// How far before the point, shares of its depth or where rays are parallel the depth, a ray begins.
float svoVolumeGap(vec3 place, vec3 facet, float parallel)
{
  float error = 1e-6 * length(place); // svoRayWalk.glsl
  return error / abs(parallel > 0.0 ? facet.z : dot(facet, place));
}

// `clearly`: what is nearly no such place is none. Shaders may not agree to the last bit, and who is to
// count has to count all that others leave to it.
bool svoCountsVolumes(
  vec4 place, vec3 facet, vec3 normal, vec4 light, float parallel, bool clearly)
{
  float least = clearly ? 1e-4 : 0.0;
  vec3 towards = normalize(light.xyz - light.w * place.xyz);
  float facing = abs(parallel > 0.0 ? facet.z : dot(facet, place.xyz) / length(place.xyz));
  // (What was traced has place.w below 0.)
  // What bulges less than floats resolve does not.
  bool bulges = place.w > 1e-6 * length(place.xyz);
  return place.w >= 0.0 && dot(normal, towards) > least && facing > 0.05 + least &&
    dot(facet, towards) > (bulges ? svoDoubtfulSine : 0.001) + least;
}
