// The share of a light that reaches a fragment of a rasterised surface. `atlas` has `count` square
// maps, one above the other; each holds the linear depth of the nearest caster. A map's matrix takes
// view coordinates to (x, y, linear depth, w), with x / w and y / w in -1..1 across the map.
uniform float svoReceive; // 0: no shadow falls on this surface
uniform float svoIntensity;
uniform int svoPlaneBias; // compare at the texel's own ray, on the plane of the receiver
float svoLit(sampler2D atlas, int count, mat4 maps[6], float bias[6], vec3 position, vec3 normal)
{
  float size = float(textureSize(atlas, 0).x);
  vec4 p = vec4(position, 1.0);
  float lit = 1.0;
  for (int i = 0; i < count; ++i)
  {
    mat4 rows = transpose(maps[i]);
    float w = dot(rows[3], p);
    if (w <= 0.0)
    {
      continue;
    }
    vec2 at = vec2(dot(rows[0], p), dot(rows[1], p)) / w;
    if (any(greaterThan(abs(at), vec2(1.0))))
    {
      continue;
    }
    float depth = dot(rows[2], p);
    vec2 texel = min(floor((at * 0.5 + 0.5) * size), vec2(size - 1.0));
    if (svoPlaneBias != 0)
    {
      // The step on the receiver's plane to the ray through the texel's centre.
      vec2 centre = (texel + 0.5) / size * 2.0 - 1.0;
      vec3 x = rows[0].xyz - centre.x * rows[3].xyz;
      vec3 y = rows[1].xyz - centre.y * rows[3].xyz;
      vec3 xy = cross(x, y);
      float across = dot(xy, normal);
      if (abs(across) > 0.01 * length(xy))
      {
        vec2 off = w * (centre - at);
        vec3 step = (off.x * cross(y, normal) + off.y * cross(normal, x)) / across;
        depth += dot(rows[2].xyz, step);
      }
    }
    float nearest = texelFetch(atlas, ivec2(texel) + ivec2(0, i * int(size)), 0).r;
    if (depth > nearest + bias[i])
    {
      lit = 0.0;
    }
  }
  return 1.0 - svoReceive * svoIntensity * (1.0 - lit);
}
