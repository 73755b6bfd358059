// How opaque a caster is by its colours, where it was met: svoHit and svoWeights of svoOctreeWalk.glsl,
// which comes before this. `at`: where its numbers begin in svoAlphas (svoCasterAlphas.h).
uniform samplerBuffer svoAlphas;

float svoTakenByHit(int at)
{
  int stride = int(texelFetch(svoAlphas, at + 1).r);
  int first = 4096 * int(texelFetch(svoAlphas, at + 2).r) + int(texelFetch(svoAlphas, at + 3).r);
  int texels = int(texelFetch(svoAlphas, at + 4).r);
  int value = at + 8 + 2 * texels + stride * (int(svoHit) - first);
  float alpha = texelFetch(svoAlphas, value).r;
  if (stride > 1)
  {
    svoWeights /= svoWeights.x + svoWeights.y + svoWeights.z;
    alpha = dot(svoWeights,
      vec3(alpha, texelFetch(svoAlphas, value + 1).r, texelFetch(svoAlphas, value + 2).r));
  }
  if (stride > 3)
  {
    float row = dot(svoWeights,
      vec3(texelFetch(svoAlphas, value + 3).r, texelFetch(svoAlphas, value + 4).r,
        texelFetch(svoAlphas, value + 5).r));
    int texel = min(int(clamp(alpha, 0.0, 1.0) * float(texels)), texels - 1);
    alpha = texelFetch(svoAlphas, at + 8 + texel + (row < 0.5 ? 0 : texels)).r;
  }
  return texelFetch(svoAlphas, at).r * clamp(alpha, 0.0, 1.0);
}
