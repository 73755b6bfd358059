// It may stand twice in a shader: the eye's and the light's.
#ifndef svoUnfolds
#define svoUnfolds
// Unit vectors as an octahedron's surface (Cigolle et al. 2014, "A Survey of Efficient Representations
// for Independent Unit Vectors").
vec3 svoUnfold(vec2 folded)
{
  vec3 way = vec3(folded, 1.0 - abs(folded.x) - abs(folded.y));
  float below = max(-way.z, 0.0);
  way.xy += vec2(way.x < 0.0 ? below : -below, way.y < 0.0 ? below : -below);
  return normalize(way);
}
#endif
