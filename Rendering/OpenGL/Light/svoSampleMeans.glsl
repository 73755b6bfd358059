// What is left at a pixel of what is sampled: the mean of its samples, or of those around it as far as
// that does not show, as svoLightFilter.h has it. Of anything else what svoLeftByRay() says.
//
// svoSkyShader.glsl comes before it, and the constant svoSumOf: by number, 4 times the layer of its sum
// and its component, or below 0.
uniform sampler2DArray svoSums;
uniform sampler2D svoPlacesAround; // svoPlaces and svoPlanes of svoShadowMaskShader.glsl
uniform sampler2D svoPlanesAround;
uniform vec4 svoFilter; // a pixel's edge, a unit away; or in parallel views; samples a pixel; 1: it is on

const float svoHardly = 1.0 / 1024.0; // what is known without samples counts

int svoKnownLayer = -1; // whose means are these
vec3 svoKnownMeans;

// `ofShare`: of LightFilter::Evenness.
vec3 svoMeansOf(ivec2 pixel, int layer, float ofShare, vec4 own, vec3 place, vec3 facet, vec3 normal)
{
  vec3 chosen = own.rgb / own.w;
  if (svoFilter.w == 0.0)
  {
    return chosen;
  }
  float edge = svoFilter.y - svoFilter.x * place.z;
  vec4 sums = own;
  vec3 squares = own.rgb * chosen;
  vec3 low = vec3(-1e30);
  vec3 high = vec3(1e30);
  vec3 open = vec3(1.0);
  for (int reach = 1; reach <= 8 && dot(open, open) > 0.0; reach *= 2)
  {
    for (int i = 0; i < (2 * reach + 1) * (2 * reach + 1); ++i)
    {
      ivec2 step = ivec2(i % (2 * reach + 1), i / (2 * reach + 1)) - reach;
      ivec2 at = pixel + step;
      if (all(lessThanEqual(abs(step), ivec2(reach / 2))) || any(lessThan(at, ivec2(0))) ||
        any(greaterThanEqual(at, textureSize(svoPlacesAround, 0))))
      {
        continue;
      }
      vec4 beside = texelFetch(svoPlacesAround, at, 0);
      vec4 some = texelFetch(svoSums, ivec3(at, layer), 0);
      // Half a pixel, and a bend.
      float off = edge * (0.5 + 0.2 * float(abs(step.x) + abs(step.y)));
      if (some.w > 0.0 && beside.w > -svoFar && abs(dot(beside.xyz - place, facet)) <= off &&
        dot(svoUnfold(2.0 * texelFetch(svoPlanesAround, at, 0).zw - 1.0), normal) >= 0.9)
      {
        sums += some;
        squares += some.rgb * some.rgb / some.w;
      }
    }
    // What chance explains (LightFilter::spreadOf()).
    vec3 mean = sums.rgb / sums.w;
    vec3 about = (sums.rgb + 0.5) / (sums.w + 1.0);
    vec3 even = max(min(ofShare * min(about, 1.0 - about), vec3(svoFilter.z)), vec3(1.0));
    vec3 spread = max(about * (1.0 - about), vec3(0.0)) / sqrt(sqrt(sqrt(even * even * even)));
    vec3 may = 3.0 * sqrt(spread / max(sums.w, 1.0));
    low = max(low, mean - may);
    high = min(high, mean + may);
    float others = sums.w / max(own.w, 1.0) - 1.0;
    open *= vec3(lessThanEqual(low, high)) *
      vec3(lessThanEqual(squares - mean * sums.rgb, 4.0 * max(others, 1.0) * spread));
    chosen = mix(chosen, mean, open);
  }
  return chosen;
}

float svoShareAt(ivec2 pixel, int number, vec3 position, vec3 facet, vec3 normal, vec3 lift)
{
  int sum = svoSumOf[number];
  if (sum < 0)
  {
    return svoLeftByRay(number, position, facet, normal, lift, 0.0);
  }
  if (svoKnownLayer != sum / 4)
  {
    svoKnownLayer = sum / 4;
    vec4 own = texelFetch(svoSums, ivec3(pixel, svoKnownLayer), 0);
    int first = number - sum % 4;
    if (own.w == 0.0 && first < svoLampCount)
    {
      own = svoHardly * vec4(svoLeftByRay(first, position, facet, normal, lift, 0.0), 0.0, 0.0, 1.0);
    }
    else if (own.w == 0.0)
    {
      own = svoHardly *
        vec4(svoOpen(first, normal), svoOpen(first + 1, normal), svoOpen(first + 2, normal), 1.0);
    }
    float ofShare = first < svoLampCount ? 1e30 : 2.0 * svoFilter.z;
    svoKnownMeans = svoMeansOf(pixel, svoKnownLayer, ofShare, own, position, facet, normal);
  }
  return svoKnownMeans[sum % 4];
}
#define svoLeft(number, position, facet, normal, lift, extent) svoShareAt(pixel, number, position, facet, normal, lift)
