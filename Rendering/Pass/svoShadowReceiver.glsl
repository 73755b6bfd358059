// The share of a light that reaches a fragment of a rasterised surface, by the test of
// svoShadowBuffer.cxx. `atlas` has `count` square maps, one above the other; each holds the linear
// depth of the nearest caster. A map's matrix takes view coordinates to (x, y, linear depth, w), with
// x / w and y / w in -1..1 across the map. `facet` is the fragment's own plane, towards the viewer,
// `normal` what it is shaded with.
uniform float svoReceive; // 0: no shadow falls on this surface
uniform float svoIntensity;
uniform int svoPlaneBias; // compare at the texel's own ray, on the planes of the receiver
uniform float svoManualBias; // world units, added

// What one texel says of the point: 0 lit, 1 dark by an occluder within a few texels' depth, 2 dark.
int svoAsk(sampler2D atlas, int map, mat4 rows, float error, vec4 point, vec2 texel, vec3 facet,
  vec3 normal)
{
  float size = float(textureSize(atlas, 0).x);
  if (any(lessThan(texel, vec2(0.0))) || any(greaterThanEqual(texel, vec2(size))))
  {
    return 0;
  }
  float occluder = texelFetch(atlas, ivec2(texel) + ivec2(0, map * int(size)), 0).r + svoManualBias;
  float w = dot(rows[3], point);
  float depth = dot(rows[2], point);
  if (svoPlaneBias == 0)
  {
    return occluder < depth ? 2 : 0;
  }
  // Edge of a texel in the world, at the depth of the point.
  vec3 axis = rows[2].xyz;
  float across = length(rows[0].xyz - dot(rows[0].xyz, axis) * axis);
  float up = length(rows[1].xyz - dot(rows[1].xyz, axis) * axis);
  float pixel = 2.0 * w / (size * max(across, up));
  float most = 8.0 * pixel; // how far the tangent planes are followed along the ray
  if (!(occluder < depth + most))
  {
    return 0;
  }
  int dark = occluder - svoManualBias < depth - most ? 2 : 1;

  // The ray through the texel's centre is where two planes meet.
  vec2 centre = (texel + 0.5) / size * 2.0 - 1.0;
  vec3 x = rows[0].xyz - centre.x * rows[3].xyz;
  vec3 y = rows[1].xyz - centre.y * rows[3].xyz;
  vec3 xy = cross(x, y);
  vec3 direction = xy / dot(axis, xy); // linear depth grows by 1
  if (dot(facet, direction) > 0.0)
  {
    return occluder < depth + 0.5 * pixel ? dark : 0;
  }
  vec2 off = w * centre - vec2(dot(rows[0], point), dot(rows[1], point));
  float receiver = depth + most;
  float steepest = 0.1;
  for (int k = 0; k < 2; ++k)
  {
    vec3 n = k == 0 ? facet : normal;
    float slope = abs(dot(n, direction)) / length(direction);
    // Inside a texel a plane in grazing light reaches far towards the light, at most 64 texels here.
    float low = depth - max(most, pixel / max(slope, 1.0 / 64.0));
    float plane = low;
    if (slope > 0.001)
    {
      // The step on the plane to the ray.
      vec3 step = (off.x * cross(y, n) + off.y * cross(n, x)) / dot(xy, n);
      plane = clamp(depth + dot(axis, step), low, depth + most);
    }
    receiver = min(receiver, plane);
    steepest = max(steepest, slope);
  }
  return occluder + (0.5 * pixel + error) / steepest < receiver ? dark : 0;
}

float svoLit(sampler2D atlas, int count, mat4 maps[6], float errors[6], vec3 position, vec3 facet,
  vec3 normal)
{
  float size = float(textureSize(atlas, 0).x);
  vec4 point = vec4(position, 1.0);
  float lit = 1.0;
  for (int i = 0; i < count; ++i)
  {
    mat4 rows = transpose(maps[i]);
    float w = dot(rows[3], point);
    if (w <= 0.0)
    {
      continue;
    }
    vec2 at = vec2(dot(rows[0], point), dot(rows[1], point)) / w;
    if (any(greaterThan(abs(at), vec2(1.0))))
    {
      continue;
    }
    vec2 place = (at * 0.5 + 0.5) * size;
    vec2 texel = min(floor(place), vec2(size - 1.0));
    int answer = svoAsk(atlas, i, rows, errors[i], point, texel, facet, normal);
    if (answer == 1)
    {
      // An occluder nearby has to be one for most of the four texels around the point.
      vec2 other = vec2(place.x - texel.x < 0.5 ? -1.0 : 1.0, place.y - texel.y < 0.5 ? -1.0 : 1.0);
      int dark = 0;
      for (int k = 1; k < 4; ++k)
      {
        vec2 neighbour = texel + other * vec2(float(k & 1), float(k >> 1));
        dark += svoAsk(atlas, i, rows, errors[i], point, neighbour, facet, normal) != 0 ? 1 : 0;
      }
      answer = dark >= 2 ? 2 : 0;
    }
    if (answer == 2)
    {
      lit = 0.0;
    }
  }
  return 1.0 - svoReceive * svoIntensity * (1.0 - lit);
}
