// Whether shadow volumes tell what reaches a point of a light: where rays begin at the facet itself,
// on its lit side. A place and its planes are as svoShadowMaskShader.glsl has them. svoPixelRay.glsl
// comes before it.

// How deep the facet lies at the pixel's ray, where rays to lights would begin: before it by what floats
// resolve. (With edges VTK draws facets wider than they are; their places are those of thinner ones.)
float svoVolumeDepth(vec3 place, vec3 facet)
{
  float error = 1e-6 * length(place); // svoRayWalk.glsl
  return (dot(facet, place - svoRayBegins(gl_FragCoord.xy)) + error) /
    dot(facet, svoRayWay(gl_FragCoord.xy));
}

// `clearly`: what is nearly no such place is none. Shaders may not agree to the last bit, and who is to
// count has to count all that others leave to it.
bool svoCountsVolumes(
  vec4 place, vec3 facet, vec3 normal, vec4 light, float parallel, bool clearly)
{
  // Tubes are drawn as flat lines, and what is seen of them is moved to where it would be.
  vec3 seen = svoRayBegins(gl_FragCoord.xy) - place.z * svoRayWay(gl_FragCoord.xy);
  float pixel = length(parallel > 0.0 ? svoPixelRays[1] : place.z * svoPixelRays[4]);
  float least = clearly ? 1e-4 : 0.0;
  vec3 towards = normalize(light.xyz - light.w * place.xyz);
  float facing = abs(parallel > 0.0 ? facet.z : dot(facet, place.xyz) / length(place.xyz));
  // (What was traced has place.w below 0.)
  // What bulges less than floats resolve does not.
  bool bulges = place.w > 1e-6 * length(place.xyz);
  return place.w >= 0.0 && distance(seen, place.xyz) < (1.0 - least) * pixel &&
    dot(normal, towards) > least && facing > 0.05 + least &&
    dot(facet, towards) > (bulges ? svoDoubtfulSine : 0.001) + least;
}
